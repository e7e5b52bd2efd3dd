// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cairn/core/checksum.h"
#include "cairn/core/file.h"
#include "cairn/map/indicators.h"

namespace cairn {

/// Returns the columns of uvlist.txt, a table of the landmarks, one row each, for people and scripts: "id",
/// "x" and so on. docs/map_format.md says what they hold.
[[nodiscard]] const std::vector<std::string>& uvlist_columns();

/// Returns the first line of uvlist.txt.
[[nodiscard]] std::string uvlist_header();

/// Returns the row of landmark `number` in uvlist.txt. `covariance` is of the point, square metres.
[[nodiscard]] std::string format_uvlist_row(std::uint32_t number, const Eigen::Vector3d& point_in_world,
                                            const Eigen::Matrix3d& covariance,
                                            const LandmarkIndicators& indicators);

/// Reads uvlist.txt row by row, in memory that does not grow with it. Throws InputError if it is missing,
/// damaged or another file; a wrong checksum is noticed after the last row.
class UvlistStream {
 public:
  /// Opens the file; `checksum` is the CRC-32 of its bytes.
  UvlistStream(const std::filesystem::path& path, std::optional<std::uint32_t> checksum);
  /// Returns a value for each column, which may be infinite, or null after the last row. Valid until the next
  /// call.
  [[nodiscard]] const std::vector<double>* next();

 private:
  [[nodiscard]] std::optional<std::string_view> next_line();
  void parse(std::string_view line);
  [[noreturn]] void fail(std::string expected, std::string found) const;

  std::filesystem::path path_;
  std::optional<std::uint32_t> checksum_;
  FileReader file_;
  Crc32 read_;
  std::string text_;       // what was read; before begin_: handed out
  std::size_t begin_ = 0;  // of the next line
  int line_ = 0;
  std::vector<double> row_;
};

}  // namespace cairn
