// SPDX-License-Identifier: Apache-2.0
#include "cairn/map_files/uvlist.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "cairn/core/error.h"
#include "cairn/core/text.h"
#include "cairn/map_files/binary_file.h"

namespace cairn {

const std::vector<std::string>& uvlist_columns() {
  static const std::vector<std::string> kColumns = [] {
    std::vector<std::string> columns = {"id", "x", "y", "z", "frames", "std_x", "std_y", "std_z", "rms_px"};
    for (const char* quantity : {"distance", "lateral", "depth", "angle_deg"})
      for (const char* statistic : {"mean", "min", "max", "std"})
        columns.push_back(fmt::format("{}_{}", statistic, quantity));
    return columns;
  }();
  return kColumns;
}

std::string uvlist_header() {
  return fmt::format("# {}\n", fmt::join(uvlist_columns(), " "));
}

std::string format_uvlist_row(std::uint32_t number, const Eigen::Vector3d& point_in_world,
                              const Eigen::Matrix3d& covariance, const LandmarkIndicators& indicators) {
  const Eigen::Vector3d std = covariance.diagonal().cwiseSqrt();
  std::string row = fmt::format("{} {} {} {} {} {:.6g} {:.6g} {:.6g} {:.6g}", number, point_in_world.x(),
                                point_in_world.y(), point_in_world.z(), indicators.frames, std.x(), std.y(),
                                std.z(), indicators.rms_px);
  for (const ValueRange& range :
       {indicators.distance, indicators.lateral, indicators.depth, indicators.angle_deg})
    row += fmt::format(" {:.6g} {:.6g} {:.6g} {:.6g}", range.mean, range.min, range.max, range.std);
  return row + "\n";
}

UvlistStream::UvlistStream(const std::filesystem::path& path, std::optional<std::uint32_t> checksum)
    : path_(path), checksum_(checksum), file_(path), row_(uvlist_columns().size()) {
  const auto header = next_line();
  if (!header || fmt::format("{}\n", *header) != uvlist_header())
    fail(uvlist_header().substr(0, uvlist_header().size() - 1), "another first line");
}

void UvlistStream::fail(std::string expected, std::string found) const {
  throw InputError({path_.string(), line_, std::move(expected), std::move(found), std::string(kMapRemedy)});
}

/// Returns the next line without its end, or nullopt at the end of the file, whose contents then fit their
/// CRC-32.
std::optional<std::string_view> UvlistStream::next_line() {
  constexpr std::size_t kPiece = 1 << 16, kLongest = 1 << 12;
  ++line_;
  std::size_t end = text_.find('\n', begin_);
  while (end == std::string::npos) {
    if (text_.size() - begin_ > kLongest) fail("a row of numbers", "a longer line");
    text_.erase(0, begin_);
    begin_ = 0;
    const std::size_t known = text_.size();
    text_.resize(known + kPiece);
    text_.resize(known + file_.read(text_.data() + known, kPiece));
    if (text_.size() == known) break;
    read_.add(std::string_view(text_).substr(known));
    end = text_.find('\n', known);
  }
  if (end == std::string::npos) {
    line_ = 0;
    if (!text_.empty() || read_.value() != checksum_)
      fail("contents that fit their CRC-32 in map.json", "others: the file is damaged or was changed");
    return {};
  }
  const std::string_view line = std::string_view(text_).substr(begin_, end - begin_);
  begin_ = end + 1;
  return line;
}

void UvlistStream::parse(std::string_view line) {
  std::size_t count = 0;
  while (!line.empty()) {
    const std::string_view word = line.substr(0, line.find(' '));
    line.remove_prefix(std::min(line.size(), word.size() + 1));
    if (count == row_.size()) fail(fmt::format("{} numbers", row_.size()), "more");
    if (word == "inf")
      row_[count] = std::numeric_limits<double>::infinity();
    else if (!parse_number(word, row_[count]))
      fail(fmt::format("a number for '{}'", uvlist_columns()[count]), fmt::format("'{}'", word));
    ++count;
  }
  if (count < row_.size()) fail(fmt::format("{} numbers", row_.size()), fmt::format("{}", count));
}

const std::vector<double>* UvlistStream::next() {
  const auto line = next_line();
  if (!line) return nullptr;
  parse(*line);
  return &row_;
}

}  // namespace cairn
