// SPDX-License-Identifier: Apache-2.0
#include "cairn/dense/pcd.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/core/text.h"
#include "cairn/dense/lzf.h"
#include "cairn/dense/point_records.h"

namespace cairn {
namespace {

using Words = std::vector<std::string_view>;

/// The header, read line by line up to DATA.
class PcdHeader {
 public:
  PcdHeader(const std::filesystem::path& path, std::string_view contents) : path_(path), contents_(contents) {
    while (format_.empty()) {
      if (begin_ >= contents_.size()) {
        fail("a PCD header that ends with DATA", "the end of the file",
             "Check that this is a whole PCD file.");
      }
      ++line_;
      const Words words = words_of(next_line(contents_, begin_));
      if (!words.empty() && !words[0].starts_with('#')) declare(words);
    }
    if (fields_.empty()) fail("FIELDS before DATA", "none", "Write the file again; its header is broken.");
    if (!has_count_)
      fail("POINTS or WIDTH and HEIGHT before DATA", "neither", "Add the line POINTS with their number.");
  }

  [[nodiscard]] bool ascii() const { return format_ == "ascii"; }
  [[nodiscard]] bool compressed() const { return format_ == "binary_compressed"; }
  [[nodiscard]] const std::vector<PointField>& fields() const { return fields_; }
  [[nodiscard]] PointData data() const { return {contents_.substr(begin_), count_, line_ + 1}; }

 private:
  [[noreturn]] void fail(std::string expected, std::string found, std::string remedy) const {
    throw InputError({path_.string(), line_, std::move(expected), std::move(found), std::move(remedy)});
  }
  [[nodiscard]] std::int64_t integer(std::string_view word, std::string_view what, std::int64_t low,
                                     std::int64_t high) const;
  void declare(const Words& words);
  void declare_fields(const Words& words);
  void set_size(PointField& field, std::string_view word) const;
  void set_kind(PointField& field, std::string_view word) const;
  void set_format(std::string_view format);

  const std::filesystem::path& path_;
  std::string_view contents_;
  std::size_t begin_ = 0;
  int line_ = 0;
  std::string format_;
  std::vector<PointField> fields_;
  std::size_t count_ = 0;
  std::int64_t width_ = 0;
  bool has_count_ = false;
};

std::int64_t PcdHeader::integer(std::string_view word, std::string_view what, std::int64_t low,
                                std::int64_t high) const {
  std::int64_t value = 0;
  if (parse_integer(word, value) && value >= low && value <= high) return value;
  fail(fmt::format("a whole number from {} to {} for {}", low, high, what), fmt::format("'{}'", word),
       "Correct the header.");
}

void PcdHeader::declare(const Words& words) {
  constexpr std::int64_t kMany = 1'000'000'000'000;
  const std::string_view word = words[0];
  if (word == "VERSION" || word == "VIEWPOINT") return;
  if (words.size() < 2) fail("a value", fmt::format("'{}' alone", word), "Correct the header.");
  if (word == "FIELDS" || word == "COLUMNS") {
    fields_.clear();
    for (std::size_t i = 1; i < words.size(); ++i) fields_.push_back({std::string(words[i])});
  } else if (word == "SIZE" || word == "TYPE" || word == "COUNT") {
    declare_fields(words);
  } else if (word == "WIDTH") {
    width_ = integer(words[1], "WIDTH", 0, 1'000'000'000);
  } else if (word == "HEIGHT") {
    if (has_count_) return;
    count_ = static_cast<std::size_t>(width_ * integer(words[1], "HEIGHT", 0, 1'000'000'000));
    has_count_ = true;
  } else if (word == "POINTS") {
    count_ = static_cast<std::size_t>(integer(words[1], "POINTS", 0, kMany));
    has_count_ = true;
  } else if (word == "DATA") {
    set_format(words[1]);
  } else {
    fail("a word of the PCD header", fmt::format("'{}'", word), "Check that this is a PCD file.");
  }
}

void PcdHeader::declare_fields(const Words& words) {
  if (words.size() != fields_.size() + 1) {
    fail(fmt::format("{} with {} values, one for each of FIELDS", words[0], fields_.size()),
         fmt::format("{}", words.size() - 1), "Correct the header.");
  }
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    if (words[0] == "SIZE") {
      set_size(fields_[i], words[i + 1]);
    } else if (words[0] == "TYPE") {
      set_kind(fields_[i], words[i + 1]);
    } else {
      fields_[i].count = static_cast<std::size_t>(integer(words[i + 1], "COUNT", 1, 1'000'000));
    }
  }
}

void PcdHeader::set_size(PointField& field, std::string_view word) const {
  if (word != "1" && word != "2" && word != "4" && word != "8")
    fail("a SIZE of 1, 2, 4 or 8", fmt::format("'{}'", word), "Correct the header.");
  field.size = static_cast<std::size_t>(word[0] - '0');
}

void PcdHeader::set_kind(PointField& field, std::string_view word) const {
  if (word != "F" && word != "I" && word != "U")
    fail("a TYPE of F, I or U", fmt::format("'{}'", word), "Correct the header.");
  field.kind = word[0];
  if (field.kind == 'F' && field.size < 4)
    fail("floating point of 4 or 8 bytes", fmt::format("{} of {} bytes", field.name, field.size),
         "Correct the header.");
}

void PcdHeader::set_format(std::string_view format) {
  if (format != "ascii" && format != "binary" && format != "binary_compressed") {
    fail("DATA ascii, binary or binary_compressed", fmt::format("'{}'", format),
         "Convert the file, for example with pcl_convert_pcd_ascii_binary IN.pcd OUT.pcd 1.");
  }
  format_ = format;
}

[[noreturn]] void fail_compressed(const std::filesystem::path& path, std::string expected,
                                  std::string found) {
  throw InputError({path.string(), 0, std::move(expected), std::move(found),
                    "The file is cut off or damaged; write or copy it again."});
}

std::uint32_t load_size(std::string_view bytes, std::size_t at) {
  std::uint32_t size = 0;
  std::memcpy(&size, bytes.data() + at, sizeof size);
  return size;
}

/// Two sizes, compressed and whole, precede the bytes.
std::string decompress(const std::filesystem::path& path, const PointData& data) {
  constexpr std::size_t kSizes = 8;
  if (data.bytes.size() < kSizes)
    fail_compressed(path, "two sizes before compressed points", fmt::format("{} bytes", data.bytes.size()));
  const std::size_t packed = load_size(data.bytes, 0), whole = load_size(data.bytes, 4);
  if (packed > data.bytes.size() - kSizes)
    fail_compressed(path, fmt::format("{} bytes of compressed points", packed),
                    fmt::format("{}", data.bytes.size() - kSizes));
  auto points = decompress_lzf(data.bytes.substr(kSizes, packed), whole);
  if (!points) fail_compressed(path, fmt::format("points that decompress to {} bytes", whole), "others");
  return *std::move(points);
}

/// Compressed clouds hold all values of the first field, then those of the second, and so on.
std::string rows_of_columns(const std::vector<PointField>& fields, std::size_t count,
                            const std::string& columns) {
  std::size_t stride = 0;
  for (const PointField& field : fields) stride += field.size * field.count;
  if (count > columns.size() / stride) return {};  // read_binary says that the points are too few
  std::string rows(count * stride, '\0');
  std::size_t column = 0, offset = 0;
  for (const PointField& field : fields) {
    const std::size_t bytes = field.size * field.count;
    for (std::size_t i = 0; i < count; ++i)
      std::memcpy(rows.data() + i * stride + offset, columns.data() + column + i * bytes, bytes);
    column += count * bytes;
    offset += bytes;
  }
  return rows;
}

}  // namespace

Cloud read_pcd(const std::filesystem::path& path) {
  const std::string contents = read_file(path);
  const PcdHeader header(path, contents);
  const PointRecords records(path, header.fields());
  if (header.ascii()) return records.read_ascii(header.data());
  if (!header.compressed()) return records.read_binary(header.data());
  PointData data = header.data();
  const std::string rows = rows_of_columns(header.fields(), data.count, decompress(path, data));
  data.bytes = rows;
  return records.read_binary(data);
}

void write_pcd(const std::filesystem::path& path, const Cloud& cloud) {
  AtomicFile file(path);
  const std::size_t count = cloud.points.size();
  file.write(
      fmt::format("# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 4\n"
                  "TYPE F F F F\nCOUNT 1 1 1 1\nWIDTH {}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {}\n"
                  "DATA binary\n",
                  count, count));
  constexpr std::size_t kBytes = 16;
  write_records(file, cloud, kBytes, [](const CloudPoint& point, char* record) {
    const std::uint32_t packed =
        static_cast<std::uint32_t>(point.r) << 16 | static_cast<std::uint32_t>(point.g) << 8 | point.b;
    std::memcpy(record, &point.x, 4);
    std::memcpy(record + 4, &point.y, 4);
    std::memcpy(record + 8, &point.z, 4);
    std::memcpy(record + 12, &packed, 4);
  });
  file.commit();
}

}  // namespace cairn
