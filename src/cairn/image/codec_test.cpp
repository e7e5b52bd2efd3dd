// SPDX-License-Identifier: Apache-2.0
#include "cairn/image/codec.h"

#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/core/random.h"
#include "cairn/testing/core/temporary_folder.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;
using std::string_literals::operator""s;

class CodecTest : public testing::Test {
 protected:
  [[nodiscard]] fs::path file(const std::string& bytes) const { return temporary_.write("image", bytes); }

  const testkit::TemporaryFolder temporary_;
  const fs::path& folder_ = temporary_.path();
};

GrayImage gray_noise(int width, int height) {
  Random random(1);
  GrayImage image(width, height);
  for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = static_cast<std::uint8_t>(random.next());
  return image;
}

/// A pattern without sharp edges, so that JPEG keeps it.
RgbImage smooth_colors(int width, int height) {
  RgbImage image(width, height);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u)
      image(u, v) = {static_cast<std::uint8_t>(2 * u), static_cast<std::uint8_t>(3 * v), 80};
  }
  return image;
}

std::string jpeg_of(const RgbImage& image, int subsampling) {
  const tjhandle encoder = tjInitCompress();
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  EXPECT_EQ(tjCompress2(encoder, &image.data()->r, image.width(), 0, image.height(), TJPF_RGB, &bytes, &size,
                        subsampling, 95, 0),
            0);
  std::string result(reinterpret_cast<const char*>(bytes), size);
  tjFree(bytes);
  tjDestroy(encoder);
  return result;
}

int difference(const Rgb8& a, const Rgb8& b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

int luma(const Rgb8& c) {
  return static_cast<int>(0.299 * c.r + 0.587 * c.g + 0.114 * c.b + 0.5);
}

TEST_F(CodecTest, png_round_trip_of_gray) {
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(7, 5), std::pair(640, 3)}) {
    const GrayImage image = gray_noise(width, height);
    write_png(folder_ / "gray.png", image);
    EXPECT_EQ(read_gray(folder_ / "gray.png"), image);
    EXPECT_EQ(read_rgb(folder_ / "gray.png")(0, 0).g, image(0, 0));
  }
}

TEST_F(CodecTest, png_round_trip_of_color) {
  const RgbImage image = smooth_colors(33, 21);
  write_png(folder_ / "color.png", image);
  EXPECT_EQ(read_rgb(folder_ / "color.png"), image);
  EXPECT_EQ(read_gray(folder_ / "color.png")(30, 20), luma(image(30, 20)));
}

TEST_F(CodecTest, png_round_trip_of_depth) {
  RawDepthImage image(256, 256);
  for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = static_cast<std::uint16_t>(i);
  write_png(folder_ / "depth.png", image);
  EXPECT_EQ(read_depth(folder_ / "depth.png"), image);
}

TEST_F(CodecTest, png_of_nothing_is_an_error_of_the_caller) {
  EXPECT_THROW(write_png(folder_ / "none.png", GrayImage()), PreconditionError);
  EXPECT_FALSE(fs::exists(folder_ / "none.png"));
}

TEST_F(CodecTest, the_bytes_tell_the_format_not_the_name) {
  const RgbImage image = smooth_colors(16, 16);
  write_file(folder_ / "really_jpeg.png", jpeg_of(image, TJSAMP_444));
  EXPECT_EQ(read_rgb(folder_ / "really_jpeg.png").width(), 16);
}

TEST_F(CodecTest, a_link_is_followed) {
  write_png(folder_ / "image.png", gray_noise(4, 4));
  fs::create_symlink("image.png", folder_ / "link.png");
  EXPECT_EQ(read_gray(folder_ / "link.png"), gray_noise(4, 4));
}

TEST_F(CodecTest, jpeg_in_color_and_gray) {
  const RgbImage image = smooth_colors(100, 60);
  for (const int subsampling : {TJSAMP_444, TJSAMP_420}) {
    const fs::path path = file(jpeg_of(image, subsampling));
    const RgbImage color = read_rgb(path);
    const GrayImage gray = read_gray(path);
    ASSERT_EQ(color.width(), 100);
    ASSERT_EQ(gray.height(), 60);
    for (int v = 0; v < 60; ++v) {
      for (int u = 0; u < 100; ++u) {
        ASSERT_LE(difference(color(u, v), image(u, v)), 8) << u << " " << v;
        ASSERT_NEAR(gray(u, v), luma(image(u, v)), 3) << u << " " << v;
      }
    }
  }
}

TEST_F(CodecTest, gray_jpeg_is_spread_over_the_channels) {
  const fs::path path = file(jpeg_of(smooth_colors(32, 32), TJSAMP_GRAY));
  const Rgb8 pixel = read_rgb(path)(20, 10);
  EXPECT_EQ(pixel.r, pixel.b);
  EXPECT_EQ(pixel.r, read_gray(path)(20, 10));
}

TEST_F(CodecTest, jpeg_that_ends_early_is_refused_even_with_a_whole_thumbnail_in_its_header) {
  const std::string whole = jpeg_of(smooth_colors(100, 60), TJSAMP_444);
  const std::string thumbnail = jpeg_of(smooth_colors(8, 8), TJSAMP_444);
  const std::size_t size = thumbnail.size() + 2;
  const std::string comment =
      "\xff\xfe"s + static_cast<char>(size >> 8) + static_cast<char>(size & 255) + thumbnail;
  const std::string with_thumbnail = whole.substr(0, 2) + comment + whole.substr(2);
  EXPECT_EQ(read_rgb(file(with_thumbnail)), read_rgb(file(whole)));
  EXPECT_THROW((void)read_rgb(file(with_thumbnail.substr(0, with_thumbnail.size() - 300))), InputError);
}

TEST_F(CodecTest, pgm_with_comments) {
  const GrayImage image = read_gray(file("P5 # by hand\n#\n3\t2\r\n# max:\n255\n\x01\x02\x03\x04\x05\xff"));
  ASSERT_EQ(image.width(), 3);
  ASSERT_EQ(image.height(), 2);
  EXPECT_EQ(image(0, 0), 1);
  EXPECT_EQ(image(2, 1), 255);
}

TEST_F(CodecTest, pgm_samples_may_look_like_blanks_and_comments) {
  const GrayImage image = read_gray(file("P5\n3 1\n255\n\n #"));
  EXPECT_EQ(image(0, 0), '\n');
  EXPECT_EQ(image(1, 0), ' ');
  EXPECT_EQ(image(2, 0), '#');
}

TEST_F(CodecTest, pgm_with_a_lower_maximum_is_stretched) {
  const GrayImage image = read_gray(file("P5 4 1 100\n\x00\x32\x64\xff"s));
  EXPECT_EQ(image(0, 0), 0);
  EXPECT_EQ(image(1, 0), 128);
  EXPECT_EQ(image(2, 0), 255);
  EXPECT_EQ(image(3, 0), 255);
}

TEST_F(CodecTest, pgm_of_16_bit_is_big_endian_and_keeps_its_units) {
  for (const char* maximum : {"65535", "10000", "256"}) {
    const RawDepthImage depth = read_depth(file("P5 2 1 "s + maximum + "\n\x03\xe8\x00\x07"s));
    EXPECT_EQ(depth(0, 0), 1000);
    EXPECT_EQ(depth(1, 0), 7);
  }
}

TEST_F(CodecTest, ppm) {
  const RgbImage image = read_rgb(file("P6 2 1 255 abcdef"));
  EXPECT_EQ(image(0, 0), (Rgb8{'a', 'b', 'c'}));
  EXPECT_EQ(image(1, 0), (Rgb8{'d', 'e', 'f'}));
}

struct Refused {
  const char* what;
  std::string bytes;
  const char* expected;
  const char* found;
};

template <class Read>
void expect_refused(const fs::path& path, const Refused& refused, Read read) {
  try {
    (void)read(path);
    ADD_FAILURE() << refused.what << " was read";
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(), path.string() + ": expected " + refused.expected + ", found " + refused.found +
                                ".\n  Record or convert the image again, or leave the frame out.")
        << refused.what;
  }
}

TEST_F(CodecTest, broken_files_are_refused) {
  write_png(folder_ / "whole.png", gray_noise(9, 9));
  const std::string png = read_file(folder_ / "whole.png");
  const std::string jpeg = jpeg_of(smooth_colors(100, 60), TJSAMP_444);
  std::string huge_png = png, bad_check = png, huge_jpeg = jpeg;
  huge_png.replace(16, 8, "\x00\x0f\x00\x00\x00\x0f\x00\x00"s);
  bad_check[png.size() - 14] ^= 1;  // in the pixels' checksum
  huge_jpeg.replace(jpeg.find("\xff\xc0") + 5, 4, "\x90\x00\x90\x00"s);
  const char* const any = "a PNG, JPEG, PGM or PPM image";
  const char* const limit = "an image of at most 32768 pixels a side and 268 million in all";
  const char* const header = "a PNM header: width, height and maximum";
  const Refused cases[] = {
      {"empty", "", any, "an empty file"},
      {"text", "hello", any, "another kind of file"},
      {"ASCII PGM", "P2 1 1 255 3", any, "another kind of file"},
      {"P5 and more", "P51 1 255 3", any, "another kind of file"},
      {"signature only", png.substr(0, 8), "a whole PNG image", "the file ends too early"},
      {"half a PNG", png.substr(0, 60), "a whole PNG image", "the file ends too early"},
      {"PNG without its end", png.substr(0, png.size() - 4), "a whole PNG image", "the file ends too early"},
      {"PNG with a flipped bit", bad_check, "a whole PNG image", "IDAT: CRC error"},
      {"PNG with a header spoilt", huge_png, "a whole PNG image", "IHDR: CRC error"},
      {"half a JPEG", jpeg.substr(0, jpeg.size() / 2), "a whole JPEG image", "Premature end of JPEG file"},
      {"JPEG's first bytes", jpeg.substr(0, 3), "a JPEG image", "a header that ends early"},
      {"huge JPEG", huge_jpeg, limit, "a header that says 36864x36864"},
      {"PGM, only magic", "P5\n", header, "another"},
      {"PGM without maximum", "P5 2 2\n", header, "another"},
      {"PGM that ends after its maximum", "P5 2 2 255", header, "another"},
      {"PGM, maximum 0", "P5 1 1 0\n0", header, "another"},
      {"PGM, maximum 65536", "P5 1 1 65536\n0000", header, "another"},
      {"PGM, negative", "P5 -1 1 255\n0", header, "another"},
      {"PGM, number too long", "P5 99999999999999999999 1 255\n0", header, "another"},
      {"PGM, no columns", "P5 0 1 255\n0", limit, "a header that says 0x1"},
      {"PGM, huge", "P5 40000 1 255\n0", limit, "a header that says 40000x1"},
      {"PPM, too many pixels", "P6 32768 32768 255\n0", limit, "a header that says 32768x32768"},
      {"short PGM", "P5 2 2 255\n123", "4 bytes of pixels", "3"},
      {"short PGM of 16 bit", "P5 2 2 256\n1234567", "8 bytes of pixels", "7"},
      {"short PPM", "P6 2 2 255\n1234567890", "12 bytes of pixels", "10"},
  };
  for (const Refused& refused : cases) {
    expect_refused(file(refused.bytes), refused, read_gray);
    expect_refused(file(refused.bytes), refused, read_rgb);
    expect_refused(file(refused.bytes), refused, read_depth);
  }
}

TEST_F(CodecTest, other_pixel_types_are_refused) {
  write_png(folder_ / "gray.png", gray_noise(2, 2));
  write_png(folder_ / "color.png", smooth_colors(2, 2));
  write_png(folder_ / "depth.png", RawDepthImage(2, 2, 7));
  const char* const depth = "a depth image: 1 channel of 16 bit";
  const char* const eight = "an image of 8 bit per channel";
  const Refused gray_as_depth{"gray", "", depth, "1 channel of 8 bit"};
  const Refused color_as_depth{"color", "", depth, "3 channels of 8 bit"};
  const Refused ppm16{"PPM", "P6 1 1 65535\n123456", eight, "3 channels of 16 bit"};
  const Refused deep{"depth", "", eight, "1 channel of 16 bit"};
  expect_refused(folder_ / "gray.png", gray_as_depth, read_depth);
  expect_refused(file("P5 1 1 255\n1"), gray_as_depth, read_depth);
  expect_refused(folder_ / "color.png", color_as_depth, read_depth);
  expect_refused(file(jpeg_of(smooth_colors(8, 8), TJSAMP_444)), color_as_depth, read_depth);
  expect_refused(folder_ / "depth.png", deep, read_gray);
  expect_refused(folder_ / "depth.png", deep, read_rgb);
  expect_refused(file(ppm16.bytes), ppm16, read_gray);
}

TEST_F(CodecTest, missing_files_and_folders_are_refused_by_name) {
  const auto message = [](const fs::path& path) -> std::string {
    try {
      (void)read_gray(path);
      return "was read";
    } catch (const InputError& error) {
      return error.what();
    }
  };
  const fs::path missing = folder_ / "missing.png";
  EXPECT_EQ(message(missing), missing.string() +
                                  ": expected a readable file, found No such file or directory.\n"
                                  "  Check the path and its permissions.");
  EXPECT_EQ(message(folder_),
            folder_.string() + ": expected a file, found a folder.\n  Name the file inside it.");
}

TEST_F(CodecTest, the_size_is_known_without_decoding) {
  write_png(folder_ / "depth.png", RawDepthImage(300, 20, 700));
  EXPECT_EQ(probe_image(folder_ / "depth.png"), (ImageSize{300, 20}));
  EXPECT_EQ(probe_image(file(jpeg_of(smooth_colors(40, 24), TJSAMP_420))), (ImageSize{40, 24}));
  EXPECT_EQ(probe_image(file("P5 3 2 255\n123456")), (ImageSize{3, 2}));
  EXPECT_EQ(probe_image(file("P6 2 1 255\n123456")), (ImageSize{2, 1}));
}

TEST_F(CodecTest, a_cut_file_is_noticed_without_decoding) {
  write_png(folder_ / "depth.png", RawDepthImage(20, 20, 700));
  for (const std::string& whole :
       {read_file(folder_ / "depth.png"), jpeg_of(smooth_colors(24, 24), TJSAMP_420),
        "P5 3 2 65535\n123456123456"s}) {
    EXPECT_NO_THROW((void)probe_image(file(whole)));
    for (const std::size_t size :
         {std::size_t{0}, std::size_t{1}, std::size_t{9}, whole.size() / 2, whole.size() - 8})
      EXPECT_THROW((void)probe_image(file(whole.substr(0, size))), InputError) << size;
  }
  EXPECT_THROW((void)probe_image(file("no image")), InputError);
  EXPECT_THROW((void)probe_image(folder_ / "missing.png"), InputError);
}

TEST_F(CodecTest, truncated_anywhere_is_an_input_error) {
  write_png(folder_ / "depth.png", RawDepthImage(20, 20, 700));
  for (const std::string& whole :
       {read_file(folder_ / "depth.png"), jpeg_of(smooth_colors(24, 24), TJSAMP_420)}) {
    for (std::size_t size = 0; size + 2 < whole.size(); ++size)
      EXPECT_THROW((void)read_rgb(file(whole.substr(0, size))), InputError) << size;
  }
}

}  // namespace
}  // namespace cairn
