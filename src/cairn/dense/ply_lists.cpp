// SPDX-License-Identifier: Apache-2.0
#include "cairn/dense/ply_lists.h"

#include <fmt/format.h>

#include <cstring>

#include "cairn/core/error.h"
#include "cairn/core/text.h"

namespace cairn {
namespace {

constexpr const char* kShort = "The file is cut off; write or copy it again.";

template <class T>
std::int64_t load(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<std::int64_t>(value);
}

/// The number of a list's values; its type is an integer of at most four bytes.
std::int64_t length_at(const char* bytes, const PointField& type) {
  const bool has_sign = type.kind == 'I';
  switch (type.size) {
    case 1:
      return has_sign ? load<std::int8_t>(bytes) : load<std::uint8_t>(bytes);
    case 2:
      return has_sign ? load<std::int16_t>(bytes) : load<std::uint16_t>(bytes);
    default:
      return has_sign ? load<std::int32_t>(bytes) : load<std::uint32_t>(bytes);
  }
}

/// Walks over binary records.
class BinaryWalk {
 public:
  BinaryWalk(const std::filesystem::path& path, const PointData& data) : path_(path), data_(data) {}

  /// Copies the next vertex, its lists left out.
  void copy_vertex(const std::vector<PlyProperty>& properties, std::string& kept) {
    for (const PlyProperty& property : properties) {
      if (!property.length) {
        kept += take(property.value.size);
        continue;
      }
      const std::int64_t length = length_at(take(property.length->size).data(), *property.length);
      if (length < 0)
        fail(fmt::format("a length from 0 up for the list {}", property.value.name),
             fmt::format("{}", length), "The file is broken; write it again.");
      take(static_cast<std::size_t>(length) * property.value.size);
    }
    ++vertices_;
  }

 private:
  std::string_view take(std::size_t bytes) {
    if (bytes > data_.bytes.size() - begin_)
      fail(fmt::format("{} points", data_.count), fmt::format("{}", vertices_), kShort);
    begin_ += bytes;
    return data_.bytes.substr(begin_ - bytes, bytes);
  }
  [[noreturn]] void fail(std::string expected, std::string found, std::string remedy) const {
    throw InputError({path_.string(), 0, std::move(expected), std::move(found), std::move(remedy)});
  }

  const std::filesystem::path& path_;
  const PointData& data_;
  std::size_t begin_ = 0, vertices_ = 0;
};

/// Returns the words of a line that are no list's; nullopt if they are not as many as its lists say.
std::optional<std::string> words_without_lists(const std::vector<std::string_view>& words,
                                               const std::vector<PlyProperty>& properties) {
  std::string kept;
  std::size_t next = 0;
  for (const PlyProperty& property : properties) {
    if (next >= words.size()) return std::nullopt;
    const std::string_view word = words[next++];
    if (!property.length) {
      kept += fmt::format("{} ", word);
      continue;
    }
    std::int64_t length = 0;
    const bool fits =
        parse_integer(word, length) && length >= 0 && static_cast<std::size_t>(length) <= words.size() - next;
    if (!fits) return std::nullopt;
    next += static_cast<std::size_t>(length);
  }
  return next == words.size() ? std::optional(kept) : std::nullopt;
}

}  // namespace

std::string binary_without_lists(const std::filesystem::path& path,
                                 const std::vector<PlyProperty>& properties, const PointData& data) {
  std::string kept;
  BinaryWalk walk(path, data);
  for (std::size_t i = 0; i < data.count; ++i) walk.copy_vertex(properties, kept);
  return kept;
}

std::string text_without_lists(const std::filesystem::path& path, const std::vector<PlyProperty>& properties,
                               const PointData& data) {
  std::string kept;
  std::size_t begin = 0, vertices = 0;
  for (int line = data.first_line; vertices < data.count && begin < data.bytes.size(); ++line) {
    const auto words = words_of(next_line(data.bytes, begin));
    if (!words.empty()) {
      const auto others = words_without_lists(words, properties);
      if (!others)
        throw InputError({path.string(), line, "as many values as the line's lists announce",
                          fmt::format("{} in all", words.size()), "Correct or delete the line."});
      kept += *others;
      ++vertices;
    }
    kept += '\n';
  }
  return kept;
}

}  // namespace cairn
