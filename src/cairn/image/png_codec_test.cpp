// SPDX-License-Identifier: Apache-2.0
#include "cairn/image/png_codec.h"

#include <gtest/gtest.h>
#include <png.h>

#include <functional>

namespace cairn {
namespace {

void append(png_structp png, png_bytep data, std::size_t count) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), count);
}

/// A PNG of kinds that encode_png does not write; `prepare` adds chunks before the header is written.
std::string encode(int width, int depth, int type, std::vector<std::vector<png_byte>> rows, int interlace,
                   const std::function<void(png_structp, png_infop)>& prepare = {}) {
  std::string bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(png, &bytes, append, nullptr);
  png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(rows.size()), depth, type,
               interlace, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (prepare) prepare(png, info);
  png_write_info(png, info);
  std::vector<png_bytep> pointers;
  for (auto& row : rows) pointers.push_back(row.data());
  png_write_image(png, pointers.data());
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

using Samples = std::vector<std::uint8_t>;

void expect_decodes(const std::string& bytes, int channels, int bytes_per_sample, const Samples& samples) {
  DecodedImage image;
  EXPECT_EQ(decode_png(bytes, image), "");
  EXPECT_EQ(image.channels, channels);
  EXPECT_EQ(image.bytes_per_sample, bytes_per_sample);
  EXPECT_EQ(image.samples, samples);
}

TEST(DecodePng, few_bit_gray_becomes_8_bit) {
  expect_decodes(encode(4, 1, PNG_COLOR_TYPE_GRAY, {{0b0101'0000}}, PNG_INTERLACE_NONE), 1, 1,
                 {0, 255, 0, 255});
  expect_decodes(encode(3, 2, PNG_COLOR_TYPE_GRAY, {{0b0001'1100}}, PNG_INTERLACE_NONE), 1, 1, {0, 85, 255});
  expect_decodes(encode(2, 4, PNG_COLOR_TYPE_GRAY, {{0x1f}}, PNG_INTERLACE_NONE), 1, 1, {17, 255});
}

TEST(DecodePng, transparency_is_dropped) {
  expect_decodes(encode(2, 8, PNG_COLOR_TYPE_GRAY_ALPHA, {{5, 0, 6, 255}}, PNG_INTERLACE_NONE), 1, 1, {5, 6});
  expect_decodes(encode(1, 8, PNG_COLOR_TYPE_RGB_ALPHA, {{1, 2, 3, 0}}, PNG_INTERLACE_NONE), 3, 1, {1, 2, 3});
  const auto add_transparent_gray = [](png_structp png, png_infop info) {
    png_color_16 transparent{};
    png_set_tRNS(png, info, nullptr, 0, &transparent);
  };
  expect_decodes(encode(4, 1, PNG_COLOR_TYPE_GRAY, {{0b0101'0000}}, PNG_INTERLACE_NONE, add_transparent_gray),
                 1, 1, {0, 255, 0, 255});
}

TEST(DecodePng, palette_becomes_color) {
  const auto add_palette = [](png_structp png, png_infop info) {
    const png_color colors[] = {{1, 2, 3}, {4, 5, 6}};
    png_set_PLTE(png, info, colors, 2);
    const png_byte alpha[] = {0, 255};
    png_set_tRNS(png, info, alpha, 2, nullptr);
  };
  expect_decodes(encode(2, 8, PNG_COLOR_TYPE_PALETTE, {{1, 0}}, PNG_INTERLACE_NONE, add_palette), 3, 1,
                 {4, 5, 6, 1, 2, 3});
}

TEST(DecodePng, interlaced_is_put_together) {
  std::vector<std::vector<png_byte>> rows(9, std::vector<png_byte>(9));
  Samples samples;
  for (std::size_t i = 0; i < 81; ++i) {
    rows[i / 9][i % 9] = static_cast<png_byte>(3 * i);
    samples.push_back(static_cast<std::uint8_t>(3 * i));
  }
  expect_decodes(encode(9, 8, PNG_COLOR_TYPE_GRAY, rows, PNG_INTERLACE_ADAM7), 1, 1, samples);
}

TEST(DecodePng, a_header_is_not_believed_beyond_what_the_file_can_hold) {
  DecodedImage image;
  const auto of_width = [](int width) {
    return encode(width, 16, PNG_COLOR_TYPE_GRAY,
                  {std::vector<png_byte>(2 * static_cast<std::size_t>(width))}, PNG_INTERLACE_NONE);
  };
  EXPECT_EQ(decode_png(of_width(40000), image), "a header that says 40000x1");
  EXPECT_EQ(decode_png(of_width(32768), image), "");
  const std::string header_only = of_width(32768).substr(0, 40);
  EXPECT_EQ(decode_png(header_only, image), "the file ends too early");
}

TEST(EncodePng, is_read_back) {
  const DecodedImage image{2, 2, 3, 1, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}};
  expect_decodes(encode_png(image), 3, 1, image.samples);
}

}  // namespace
}  // namespace cairn
