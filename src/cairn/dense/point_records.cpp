// SPDX-License-Identifier: Apache-2.0
#include "cairn/dense/point_records.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <utility>

#include "cairn/core/error.h"
#include "cairn/core/text.h"

namespace cairn {
namespace {

constexpr std::string_view kBlanks = " \t\r\v\f";
constexpr std::string_view kShort = "The file is cut off; write or copy it again.";

template <class T>
double load(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<double>(value);
}

void set_packed(CloudPoint& point, std::uint32_t packed) {
  point.r = static_cast<std::uint8_t>(packed >> 16 & 0xffU);
  point.g = static_cast<std::uint8_t>(packed >> 8 & 0xffU);
  point.b = static_cast<std::uint8_t>(packed & 0xffU);
}

bool is_finite(const CloudPoint& point) {
  return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
}

/// As parse_number, but with nan and inf, which mark points without a measurement.
bool parse_coordinate(std::string_view text, float& value) {
  double number = 0;
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  value = static_cast<float>(number);
  return error == std::errc() && end == text.data() + text.size();
}

bool parse_byte(std::string_view text, std::uint8_t& value) {
  std::int64_t number = 0;
  if (!parse_integer(text, number) || number < 0 || number > 255) return false;
  value = static_cast<std::uint8_t>(number);
  return true;
}

std::string describe(const PointField& field) {
  const std::string_view kind = field.kind == 'F'   ? "floating point"
                                : field.kind == 'U' ? "unsigned"
                                                    : "signed";
  return fmt::format("{} as {} of {} bytes", field.name, kind, field.size);
}

}  // namespace

std::string_view next_line(std::string_view text, std::size_t& begin) {
  const std::size_t end = std::min(text.find('\n', begin), text.size());
  std::string_view line = text.substr(begin, end - begin);
  if (line.ends_with('\r')) line.remove_suffix(1);
  begin = std::min(end + 1, text.size());
  return line;
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t begin = line.find_first_not_of(kBlanks); begin != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(kBlanks, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kBlanks, end);
  }
  return words;
}

PointRecords::PointRecords(const std::filesystem::path& path, std::vector<PointField> fields)
    : path_(path), fields_(std::move(fields)) {
  for (const PointField& field : fields_) {
    stride_ += field.size * field.count;
    columns_ += field.count;
  }
  x_ = find({"x"});
  y_ = find({"y"});
  z_ = find({"z"});
  for (const auto& [slot, name] : {std::pair{x_, "x"}, {y_, "y"}, {z_, "z"}}) {
    if (!slot.field)
      fail(0, "points with x, y and z", fmt::format("none with {}", name), "Choose a point cloud.");
  }
  red_ = find({"red", "r", "diffuse_red"});
  green_ = find({"green", "g", "diffuse_green"});
  blue_ = find({"blue", "b", "diffuse_blue"});
  packed_ = find({"rgb", "rgba"});
  check_color();
}

void PointRecords::check_color() const {
  for (const Slot& slot : {red_, green_, blue_}) {
    if (!slot.field) continue;
    const PointField& field = fields_[*slot.field];
    if (field.kind != 'U' || field.size != 1)
      fail(0, "colours as unsigned bytes", describe(field), "Convert the file, or remove its colours.");
  }
  if (!packed_.field) return;
  const PointField& field = fields_[*packed_.field];
  if (field.size != 4) fail(0, "a packed colour of 4 bytes", describe(field), "Convert the file.");
}

void PointRecords::fail(int line, std::string expected, std::string found, std::string remedy) const {
  throw InputError({path_.string(), line, std::move(expected), std::move(found), std::move(remedy)});
}

PointRecords::Slot PointRecords::find(const std::vector<std::string_view>& names) const {
  Slot slot;
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    if (std::find(names.begin(), names.end(), fields_[i].name) != names.end()) {
      slot.field = i;
      return slot;
    }
    slot.offset += fields_[i].size * fields_[i].count;
    slot.column += fields_[i].count;
  }
  return slot;
}

double PointRecords::value(const char* record, const Slot& slot) const {
  const PointField& field = fields_[*slot.field];
  const char* bytes = record + slot.offset;
  if (field.kind == 'F') return field.size == 8 ? load<double>(bytes) : load<float>(bytes);
  const bool has_sign = field.kind == 'I';
  switch (field.size) {
    case 1:
      return has_sign ? load<std::int8_t>(bytes) : load<std::uint8_t>(bytes);
    case 2:
      return has_sign ? load<std::int16_t>(bytes) : load<std::uint16_t>(bytes);
    case 4:
      return has_sign ? load<std::int32_t>(bytes) : load<std::uint32_t>(bytes);
    default:
      return has_sign ? load<std::int64_t>(bytes) : load<std::uint64_t>(bytes);
  }
}

void PointRecords::set_color(CloudPoint& point, const char* record) const {
  if (packed_.field) {
    std::uint32_t packed = 0;
    std::memcpy(&packed, record + packed_.offset, sizeof packed);
    set_packed(point, packed);
  } else {
    const auto byte = [&](const Slot& slot) { return static_cast<std::uint8_t>(record[slot.offset]); };
    point.r = byte(red_);
    point.g = byte(green_);
    point.b = byte(blue_);
  }
}

Cloud PointRecords::read_binary(const PointData& data) const {
  if (data.count > data.bytes.size() / stride_) {
    fail(0, fmt::format("{} points of {} bytes", data.count, stride_),
         fmt::format("{} bytes of points", data.bytes.size()), std::string(kShort));
  }
  Cloud cloud;
  cloud.colored = packed_.field || (red_.field && green_.field && blue_.field);
  cloud.points.reserve(data.count);
  for (std::size_t i = 0; i < data.count; ++i) {
    const char* record = data.bytes.data() + i * stride_;
    CloudPoint point;
    point.x = static_cast<float>(value(record, x_));
    point.y = static_cast<float>(value(record, y_));
    point.z = static_cast<float>(value(record, z_));
    if (cloud.colored) set_color(point, record);
    if (is_finite(point)) cloud.points.push_back(point);
  }
  return cloud;
}

std::uint32_t PointRecords::parse_packed(std::string_view text, int line) const {
  const PointField& field = fields_[*packed_.field];
  std::int64_t integer = 0;
  float number = 0;
  if (field.kind != 'F' && parse_integer(text, integer)) return static_cast<std::uint32_t>(integer);
  if (field.kind == 'F' && parse_coordinate(text, number)) return std::bit_cast<std::uint32_t>(number);
  fail(line, "a packed colour", fmt::format("'{}'", text), "Correct or delete the line.");
}

CloudPoint PointRecords::parse(const std::vector<std::string_view>& values, int line) const {
  CloudPoint point;
  const auto coordinate = [&](const Slot& slot, std::string_view name, float& out) {
    if (parse_coordinate(values[slot.column], out)) return;
    fail(line, fmt::format("a number for {}", name), fmt::format("'{}'", values[slot.column]),
         "Correct or delete the line.");
  };
  const auto channel = [&](const Slot& slot, std::string_view name, std::uint8_t& out) {
    if (!slot.field || parse_byte(values[slot.column], out)) return;
    fail(line, fmt::format("a whole number from 0 to 255 for {}", name),
         fmt::format("'{}'", values[slot.column]), "Correct or delete the line.");
  };
  coordinate(x_, "x", point.x);
  coordinate(y_, "y", point.y);
  coordinate(z_, "z", point.z);
  channel(red_, "red", point.r);
  channel(green_, "green", point.g);
  channel(blue_, "blue", point.b);
  if (packed_.field) set_packed(point, parse_packed(values[packed_.column], line));
  return point;
}

Cloud PointRecords::read_ascii(const PointData& data) const {
  const std::size_t fewest_bytes = 2 * columns_;  // a digit and a separator each
  if (data.count > data.bytes.size() / fewest_bytes + 1) {
    fail(0, fmt::format("{} points of {} values", data.count, columns_),
         fmt::format("{} bytes of points", data.bytes.size()), std::string(kShort));
  }
  Cloud cloud;
  cloud.colored = packed_.field || (red_.field && green_.field && blue_.field);
  cloud.points.reserve(data.count);
  int line = data.first_line - 1;
  std::size_t begin = 0, read = 0;
  while (read < data.count && begin < data.bytes.size()) {
    ++line;
    const auto values = words_of(next_line(data.bytes, begin));
    if (values.empty()) continue;
    if (values.size() != columns_) {
      fail(line, fmt::format("{} values", columns_), fmt::format("{}", values.size()),
           "Correct or delete the line.");
    }
    ++read;
    const CloudPoint point = parse(values, line);
    if (is_finite(point)) cloud.points.push_back(point);
  }
  if (read < data.count)
    fail(0, fmt::format("{} points", data.count), fmt::format("{}", read), std::string(kShort));
  return cloud;
}

}  // namespace cairn
