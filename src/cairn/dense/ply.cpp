// SPDX-License-Identifier: Apache-2.0
#include "cairn/dense/ply.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstring>
#include <optional>
#include <utility>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/core/text.h"
#include "cairn/dense/ply_lists.h"
#include "cairn/dense/point_records.h"

namespace cairn {
namespace {

using Words = std::vector<std::string_view>;

std::optional<PointField> field_of(std::string_view type, std::string_view name) {
  constexpr std::pair<std::string_view, std::pair<char, std::size_t>> kTypes[] = {
      {"char", {'I', 1}},  {"int8", {'I', 1}},    {"uchar", {'U', 1}},  {"uint8", {'U', 1}},
      {"short", {'I', 2}}, {"int16", {'I', 2}},   {"ushort", {'U', 2}}, {"uint16", {'U', 2}},
      {"int", {'I', 4}},   {"int32", {'I', 4}},   {"uint", {'U', 4}},   {"uint32", {'U', 4}},
      {"float", {'F', 4}}, {"float32", {'F', 4}}, {"double", {'F', 8}}, {"float64", {'F', 8}}};
  for (const auto& [known, layout] : kTypes)
    if (known == type) return PointField{std::string(name), layout.first, layout.second, 1};
  return std::nullopt;
}

/// The header, read line by line. Vertices come first, as nearly all programs write them.
class PlyHeader {
 public:
  PlyHeader(const std::filesystem::path& path, std::string_view contents) : path_(path), contents_(contents) {
    if (next() != "ply") fail("a PLY file, which begins with 'ply'", "other contents", "Check the file.");
    while (!ended_) {
      if (begin_ >= contents_.size()) fail("end_header", "the end of the file", "The file is cut off.");
      const Words words = words_of(next());
      if (!words.empty()) declare(words);
    }
    if (format_.empty()) fail("a format line in the header", "none", "Write the file again.");
    if (elements_ == 0) fail("an element named vertex", "none", "The file holds no points.");
  }

  [[nodiscard]] bool ascii() const { return format_ == "ascii"; }
  [[nodiscard]] const std::vector<PlyProperty>& properties() const { return properties_; }
  [[nodiscard]] PointData data() const { return {contents_.substr(begin_), count_, line_ + 1}; }

 private:
  std::string_view next() {
    ++line_;
    return next_line(contents_, begin_);
  }
  [[noreturn]] void fail(std::string expected, std::string found, std::string remedy) const {
    throw InputError({path_.string(), line_, std::move(expected), std::move(found), std::move(remedy)});
  }
  void declare(const Words& words);
  void set_format(std::string_view format);
  void begin_element(std::string_view name, std::string_view count);
  void add_property(const Words& words);
  [[nodiscard]] PointField field_in(std::string_view type, std::string_view name) const;

  const std::filesystem::path& path_;
  std::string_view contents_;
  std::size_t begin_ = 0;
  int line_ = 0;
  bool ended_ = false;
  std::string format_;
  int elements_ = 0;
  std::size_t count_ = 0;
  std::vector<PlyProperty> properties_;
};

void PlyHeader::declare(const Words& words) {
  if (words[0] == "comment" || words[0] == "obj_info") return;
  if (words[0] == "end_header") {
    ended_ = true;
  } else if (words[0] == "format" && words.size() == 3) {
    set_format(words[1]);
  } else if (words[0] == "element" && words.size() == 3) {
    begin_element(words[1], words[2]);
  } else if (words[0] == "property" && words.size() >= 3) {
    add_property(words);
  } else {
    fail("format, element, property, comment or end_header", fmt::format("'{}'", fmt::join(words, " ")),
         "Write the file again; its header is broken.");
  }
}

void PlyHeader::set_format(std::string_view format) {
  if (format != "ascii" && format != "binary_little_endian") {
    fail("format ascii or binary_little_endian", fmt::format("'{}'", format),
         "Convert the file to binary_little_endian.");
  }
  format_ = format;
}

void PlyHeader::begin_element(std::string_view name, std::string_view count) {
  if (++elements_ > 1) return;  // follows the vertices
  if (name != "vertex")
    fail("vertices as the first element", fmt::format("'{}'", name), "Write the vertices first.");
  std::int64_t number = 0;
  if (!parse_integer(count, number) || number < 0)
    fail("the number of vertices", fmt::format("'{}'", count), "Correct the header.");
  count_ = static_cast<std::size_t>(number);
}

void PlyHeader::add_property(const Words& words) {
  if (elements_ > 1) return;
  if (elements_ == 0) fail("an element before its properties", "a property", "Correct the header.");
  if (words[1] != "list") return properties_.push_back({field_in(words[1], words[2]), std::nullopt});
  if (words.size() != 5)
    fail("property list, two types and a name", fmt::format("'{}'", fmt::join(words, " ")),
         "Correct the header.");
  const PointField length = field_in(words[2], words[4]);
  if (length.kind == 'F')
    fail("an integer type for the length of a list", fmt::format("'{}'", words[2]), "Correct the header.");
  properties_.push_back({field_in(words[3], words[4]), length});
}

PointField PlyHeader::field_in(std::string_view type, std::string_view name) const {
  const auto field = field_of(type, name);
  if (!field) fail("a PLY type such as float or uchar", fmt::format("'{}'", type), "Correct the header.");
  return *field;
}

/// The properties that are no lists.
std::vector<PointField> fields_of(const std::vector<PlyProperty>& properties) {
  std::vector<PointField> fields;
  for (const PlyProperty& property : properties)
    if (!property.length) fields.push_back(property.value);
  return fields;
}

}  // namespace

Cloud read_ply(const std::filesystem::path& path) {
  const std::string contents = read_file(path);
  const PlyHeader header(path, contents);
  const std::vector<PointField> fields = fields_of(header.properties());
  const PointRecords records(path, fields);
  PointData data = header.data();
  std::string kept;
  if (fields.size() < header.properties().size()) {
    kept = header.ascii() ? text_without_lists(path, header.properties(), data)
                          : binary_without_lists(path, header.properties(), data);
    data.bytes = kept;
  }
  return header.ascii() ? records.read_ascii(data) : records.read_binary(data);
}

void write_ply(const std::filesystem::path& path, const Cloud& cloud) {
  AtomicFile file(path);
  file.write(fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment written by cairn, metres\nelement vertex {}\n"
      "property float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n",
      cloud.points.size()));
  constexpr std::size_t kBytes = 15;
  write_records(file, cloud, kBytes, [](const CloudPoint& point, char* record) {
    std::memcpy(record, &point.x, 4);
    std::memcpy(record + 4, &point.y, 4);
    std::memcpy(record + 8, &point.z, 4);
    std::memcpy(record + 12, &point.r, 1);
    std::memcpy(record + 13, &point.g, 1);
    std::memcpy(record + 14, &point.b, 1);
  });
  file.commit();
}

}  // namespace cairn
