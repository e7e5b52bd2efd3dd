// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cairn/core/file.h"
#include "cairn/dense/cloud.h"

namespace cairn {

/// Describes one named value of a point in a file, as PLY's properties and PCD's fields declare it.
struct PointField {
  std::string name;
  char kind = 'F';        ///< 'F' floating point, 'I' signed, 'U' unsigned
  std::size_t size = 4;   ///< bytes: 1, 2, 4 or 8
  std::size_t count = 1;  ///< number of values, above 1 only in PCD
};

/// Refers to the points of a file.
struct PointData {
  std::string_view bytes;  ///< all that follows the header
  std::size_t count = 0;   ///< number of points that the header announces
  int first_line = 1;      ///< number of the first line of text
};

/// Reads points as rows of fields, for PLY and PCD. Finds x, y, z and the colour (red, green, blue as bytes,
/// or PCL's packed rgb); skips all others. Leaves out points without finite coordinates ("no measurement" in
/// organised clouds).
class PointRecords {
 public:
  /// Finds the fields. Throws InputError if a coordinate is missing or the type of the colour is not
  /// supported.
  PointRecords(const std::filesystem::path& path, std::vector<PointField> fields);

  [[nodiscard]] std::size_t bytes_per_point() const { return stride_; }
  /// Reads binary records. Throws InputError if the data is shorter than announced, before anything is
  /// allocated for it.
  [[nodiscard]] Cloud read_binary(const PointData& data) const;
  /// Reads text, one point a line. Throws InputError if the data is shorter than announced or, with its line,
  /// if a value is not a number.
  [[nodiscard]] Cloud read_ascii(const PointData& data) const;

 private:
  struct Slot {
    std::optional<std::size_t> field;  // none: the file lacks it
    std::size_t offset = 0;            // bytes from the start of the record
    std::size_t column = 0;            // number of its first value in a line
  };
  [[nodiscard]] Slot find(const std::vector<std::string_view>& names) const;
  [[nodiscard]] double value(const char* record, const Slot& slot) const;
  void set_color(CloudPoint& point, const char* record) const;
  [[nodiscard]] CloudPoint parse(const std::vector<std::string_view>& values, int line) const;
  [[nodiscard]] std::uint32_t parse_packed(std::string_view text, int line) const;
  [[noreturn]] void fail(int line, std::string expected, std::string found, std::string remedy) const;
  void check_color() const;

  std::filesystem::path path_;
  std::vector<PointField> fields_;
  std::size_t stride_ = 0;
  std::size_t columns_ = 0;
  Slot x_, y_, z_, red_, green_, blue_, packed_;
};

static_assert(std::endian::native == std::endian::little, "points are written as they lie in memory");

/// Writes the points as records of `bytes_per_point`, each filled by pack(point, record).
template <class Pack>
void write_records(AtomicFile& file, const Cloud& cloud, std::size_t bytes_per_point, const Pack& pack) {
  constexpr std::size_t kPointsAtOnce = 4096;
  std::vector<char> buffer(kPointsAtOnce * bytes_per_point);
  std::size_t filled = 0;
  for (const CloudPoint& point : cloud.points) {
    pack(point, buffer.data() + filled);
    filled += bytes_per_point;
    if (filled < buffer.size()) continue;
    file.write({buffer.data(), filled});
    filled = 0;
  }
  file.write({buffer.data(), filled});
}

/// Returns the next line of `text` from `begin` on, without its end of line, and moves `begin` behind it.
[[nodiscard]] std::string_view next_line(std::string_view text, std::size_t& begin);
/// Returns the words of a line.
[[nodiscard]] std::vector<std::string_view> words_of(std::string_view line);

}  // namespace cairn
