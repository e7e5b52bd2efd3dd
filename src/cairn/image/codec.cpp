// SPDX-License-Identifier: Apache-2.0
#include "cairn/image/codec.h"

#include <fmt/format.h>
#include <turbojpeg.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <optional>
#include <string_view>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/core/text.h"
#include "cairn/image/png_codec.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;
using std::string_view_literals::operator""sv;

[[noreturn]] void fail(const fs::path& path, std::string expected, std::string found) {
  throw InputError({path.string(), 0, std::move(expected), std::move(found),
                    "Record or convert the image again, or leave the frame out."});
}

void expect_sane_size(const fs::path& path, std::int64_t width, std::int64_t height) {
  if (!is_image_size(width, height))
    fail(path, kImageSizeLimit, fmt::format("a header that says {}x{}", width, height));
}

bool is_png(std::string_view bytes) {
  return bytes.starts_with("\x89PNG\r\n\x1a\n"sv);
}
bool is_jpeg(std::string_view bytes) {
  return bytes.starts_with("\xff\xd8\xff"sv);
}
bool is_pnm_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f';
}
bool is_pnm(std::string_view bytes) {
  return bytes.size() > 2 && (bytes.starts_with("P5"sv) || bytes.starts_with("P6"sv)) &&
         (is_pnm_blank(bytes[2]) || bytes[2] == '#');
}

/// A truncated JPEG only warns; the end marker is missing after its last scan (a thumbnail in its header has
/// one of its own).
bool has_jpeg_end(std::string_view bytes) {
  const std::size_t last_scan = bytes.rfind("\xff\xda"sv);
  return last_scan != std::string_view::npos && bytes.find("\xff\xd9"sv, last_scan) != std::string_view::npos;
}

DecodedImage decode_jpeg(const fs::path& path, std::string_view bytes, bool gray) {
  const std::unique_ptr<void, int (*)(tjhandle)> decoder(tjInitDecompress(), tjDestroy);
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  DecodedImage image;
  int subsampling = 0, colorspace = 0;
  if (tjDecompressHeader3(decoder.get(), data, bytes.size(), &image.width, &image.height, &subsampling,
                          &colorspace) != 0) {
    fail(path, "a JPEG image", tjGetErrorStr2(decoder.get()));
  }
  if (image.width == 0 || image.height == 0) fail(path, "a JPEG image", "a header that ends early");
  expect_sane_size(path, image.width, image.height);
  image.channels = gray ? 1 : 3;
  image.bytes_per_sample = 1;
  image.samples.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                       static_cast<std::size_t>(image.channels));
  const int status = tjDecompress2(decoder.get(), data, bytes.size(), image.samples.data(), image.width, 0,
                                   image.height, gray ? TJPF_GRAY : TJPF_RGB, 0);
  const bool broken = status != 0 && (tjGetErrorCode(decoder.get()) == TJERR_FATAL || !has_jpeg_end(bytes));
  if (broken) fail(path, "a whole JPEG image", tjGetErrorStr2(decoder.get()));
  return image;
}

struct PnmHeader {
  std::int64_t width = 0, height = 0;
  std::int64_t maximum = 0;       ///< of a sample
  std::string_view sample_bytes;  ///< what follows
};

/// White space and '#' comments, then digits.
std::optional<std::int64_t> next_pnm_number(std::string_view bytes, std::size_t& position) {
  while (position < bytes.size() && (is_pnm_blank(bytes[position]) || bytes[position] == '#')) {
    position = bytes[position] == '#' ? std::min(bytes.find('\n', position), bytes.size()) : position + 1;
  }
  const std::size_t begin = position;
  while (position < bytes.size() && bytes[position] >= '0' && bytes[position] <= '9') ++position;
  std::int64_t value = 0;
  if (!parse_integer(bytes.substr(begin, position - begin), value)) return std::nullopt;
  return value;
}

/// One white space stands between the maximum and the samples.
PnmHeader parse_pnm_header(const fs::path& path, std::string_view bytes) {
  std::size_t position = 2;
  const auto width = next_pnm_number(bytes, position);
  const auto height = next_pnm_number(bytes, position);
  const auto maximum = next_pnm_number(bytes, position);
  if (!width || !height || !maximum || *maximum < 1 || *maximum > 65535 || position >= bytes.size() ||
      !is_pnm_blank(bytes[position])) {
    fail(path, "a PNM header: width, height and maximum", "another");
  }
  expect_sane_size(path, *width, *height);
  return {*width, *height, *maximum, bytes.substr(position + 1)};
}

/// PNM is big-endian.
void swap_to_native(std::vector<std::uint8_t>& samples) {
  for (std::size_t i = 0; i < samples.size(); i += 2) {
    const auto value = static_cast<std::uint16_t>(samples[i] << 8 | samples[i + 1]);
    std::memcpy(&samples[i], &value, 2);
  }
}

/// 8-bit samples from [0, maximum] to [0, 255].
void stretch(std::vector<std::uint8_t>& samples, int maximum) {
  for (std::uint8_t& sample : samples)
    sample = static_cast<std::uint8_t>((255 * std::min<int>(sample, maximum) + maximum / 2) / maximum);
}

DecodedImage decode_pnm(const fs::path& path, std::string_view bytes) {
  const PnmHeader header = parse_pnm_header(path, bytes);
  DecodedImage image{static_cast<int>(header.width),
                     static_cast<int>(header.height),
                     bytes[1] == '6' ? 3 : 1,
                     header.maximum > 255 ? 2 : 1,
                     {}};
  const auto size =
      static_cast<std::size_t>(header.width * header.height * image.channels * image.bytes_per_sample);
  if (header.sample_bytes.size() < size) {
    fail(path, fmt::format("{} bytes of pixels", size), fmt::format("{}", header.sample_bytes.size()));
  }
  image.samples.assign(header.sample_bytes.begin(),
                       header.sample_bytes.begin() + static_cast<std::ptrdiff_t>(size));
  if (image.bytes_per_sample == 2) {
    swap_to_native(image.samples);
  } else if (header.maximum != 255) {
    stretch(image.samples, static_cast<int>(header.maximum));
  }
  return image;
}

[[noreturn]] void fail_unknown(const fs::path& path, std::string_view bytes) {
  fail(path, "a PNG, JPEG, PGM or PPM image", bytes.empty() ? "an empty file" : "another kind of file");
}

DecodedImage decode(const fs::path& path, bool gray) {
  const std::string bytes = read_file(path);
  if (is_jpeg(bytes)) return decode_jpeg(path, bytes, gray);
  if (is_pnm(bytes)) return decode_pnm(path, bytes);
  if (!is_png(bytes)) fail_unknown(path, bytes);
  DecodedImage image;
  const std::string wrong = decode_png(bytes, image);
  if (!wrong.empty()) fail(path, "a whole PNG image", wrong);
  return image;
}

std::string describe(const DecodedImage& image) {
  return fmt::format("{} channel{} of {} bit", image.channels, image.channels == 1 ? "" : "s",
                     8 * image.bytes_per_sample);
}

/// Rec. 601 luma, rounded.
std::uint8_t luma(const std::uint8_t* rgb) {
  return static_cast<std::uint8_t>((299 * rgb[0] + 587 * rgb[1] + 114 * rgb[2] + 500) / 1000);
}

template <class Pixel>
void write_encoded(const fs::path& path, const Image<Pixel>& image, int channels, int bytes_per_sample) {
  require(!image.empty(), "an image to write has pixels");
  DecodedImage raw{image.width(), image.height(), channels, bytes_per_sample, {}};
  const auto* begin = reinterpret_cast<const std::uint8_t*>(image.data());
  raw.samples.assign(begin, begin + image.size() * sizeof(Pixel));
  write_file(path, encode_png(raw));
}

/// Of the first chunk, big-endian.
ImageSize probe_png(const fs::path& path, std::string_view bytes) {
  constexpr std::size_t kHeader = 24;
  constexpr std::size_t kEnd = 12;  // the last chunk: length 0, IEND, checksum
  const bool is_whole = bytes.size() >= kHeader + kEnd && bytes.rfind("IEND"sv) != std::string_view::npos;
  if (!is_whole) fail(path, "a whole PNG image", "one that ends early");
  const auto number = [&](std::size_t begin) {
    std::int64_t value = 0;
    for (std::size_t i = begin; i < begin + 4; ++i) value = value << 8 | static_cast<std::uint8_t>(bytes[i]);
    return value;
  };
  expect_sane_size(path, number(16), number(20));
  return {static_cast<int>(number(16)), static_cast<int>(number(20))};
}

ImageSize probe_jpeg(const fs::path& path, std::string_view bytes) {
  const std::unique_ptr<void, int (*)(tjhandle)> decoder(tjInitDecompress(), tjDestroy);
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  ImageSize size;
  int subsampling = 0, colorspace = 0;
  if (tjDecompressHeader3(decoder.get(), data, bytes.size(), &size.width, &size.height, &subsampling,
                          &colorspace) != 0)
    fail(path, "a JPEG image", tjGetErrorStr2(decoder.get()));
  if (!has_jpeg_end(bytes)) fail(path, "a whole JPEG image", "one that ends early");
  expect_sane_size(path, size.width, size.height);
  return size;
}

ImageSize probe_pnm(const fs::path& path, std::string_view bytes) {
  const PnmHeader header = parse_pnm_header(path, bytes);
  const std::int64_t samples = header.width * header.height * (bytes[1] == '6' ? 3 : 1);
  const std::int64_t size = samples * (header.maximum > 255 ? 2 : 1);
  if (static_cast<std::int64_t>(header.sample_bytes.size()) < size)
    fail(path, fmt::format("{} bytes of pixels", size), fmt::format("{}", header.sample_bytes.size()));
  return {static_cast<int>(header.width), static_cast<int>(header.height)};
}

}  // namespace

ImageSize probe_image(const fs::path& path) {
  const std::string bytes = read_file(path);
  if (is_jpeg(bytes)) return probe_jpeg(path, bytes);
  if (is_pnm(bytes)) return probe_pnm(path, bytes);
  if (!is_png(bytes)) fail_unknown(path, bytes);
  return probe_png(path, bytes);
}

GrayImage read_gray(const fs::path& path) {
  const DecodedImage raw = decode(path, true);
  if (raw.bytes_per_sample != 1) fail(path, "an image of 8 bit per channel", describe(raw));
  GrayImage image(raw.width, raw.height);
  if (raw.channels == 1) {
    std::copy(raw.samples.begin(), raw.samples.end(), image.data());
  } else {
    for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = luma(&raw.samples[3 * i]);
  }
  return image;
}

RgbImage read_rgb(const fs::path& path) {
  const DecodedImage raw = decode(path, false);
  if (raw.bytes_per_sample != 1) fail(path, "an image of 8 bit per channel", describe(raw));
  RgbImage image(raw.width, raw.height);
  for (std::size_t i = 0; i < image.size(); ++i) {
    const std::uint8_t* p = &raw.samples[i * static_cast<std::size_t>(raw.channels)];
    image.data()[i] = raw.channels == 3 ? Rgb8{p[0], p[1], p[2]} : Rgb8{p[0], p[0], p[0]};
  }
  return image;
}

RawDepthImage read_depth(const fs::path& path) {
  const DecodedImage raw = decode(path, false);
  if (raw.channels != 1 || raw.bytes_per_sample != 2)
    fail(path, "a depth image: 1 channel of 16 bit", describe(raw));
  RawDepthImage image(raw.width, raw.height);
  std::memcpy(image.data(), raw.samples.data(), raw.samples.size());
  return image;
}

void write_png(const fs::path& path, const GrayImage& image) {
  write_encoded(path, image, 1, 1);
}
void write_png(const fs::path& path, const RgbImage& image) {
  write_encoded(path, image, 3, 1);
}
void write_png(const fs::path& path, const RawDepthImage& image) {
  write_encoded(path, image, 1, 2);
}

}  // namespace cairn
