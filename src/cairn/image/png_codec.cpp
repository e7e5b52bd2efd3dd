// SPDX-License-Identifier: Apache-2.0
#include "cairn/image/png_codec.h"

#include <png.h>

#include <bit>
#include <cstring>
#include <stdexcept>
#include <string>

namespace cairn {
namespace {

// libpng reports errors by a callback that must not return. Throwing through libpng's C frames is sound here:
// the packages of the distributions are built with unwind tables, and nothing in those frames needs a
// destructor.
struct PngError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

[[noreturn]] void on_error(png_structp, png_const_charp message) {
  throw PngError(message);
}
void on_warning(png_structp, png_const_charp) {}

struct ByteSource {
  std::string_view bytes;
  std::size_t position = 0;
};

void read_bytes(png_structp png, png_bytep out, std::size_t count) {
  auto& source = *static_cast<ByteSource*>(png_get_io_ptr(png));
  if (count > source.bytes.size() - source.position) throw PngError("the file ends too early");
  std::memcpy(out, source.bytes.data() + source.position, count);
  source.position += count;
}

void append_bytes(png_structp png, png_bytep data, std::size_t count) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), count);
}

std::vector<png_bytep> row_pointers(DecodedImage& image, std::size_t stride) {
  std::vector<png_bytep> rows(static_cast<std::size_t>(image.height));
  for (std::size_t v = 0; v < rows.size(); ++v) rows[v] = image.samples.data() + v * stride;
  return rows;
}

class Reader {
 public:
  Reader()
      : png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, on_error, on_warning)),
        info_(png_create_info_struct(png_)) {}
  ~Reader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  void read(std::string_view bytes, DecodedImage& image) {
    ByteSource source{bytes};
    png_set_read_fn(png_, &source, read_bytes);
    png_read_info(png_, info_);
    expect_plausible_size(bytes.size());
    normalise_pixels();
    image.width = static_cast<int>(png_get_image_width(png_, info_));
    image.height = static_cast<int>(png_get_image_height(png_, info_));
    image.channels = png_get_channels(png_, info_);
    image.bytes_per_sample = png_get_bit_depth(png_, info_) / 8;
    const std::size_t stride = png_get_rowbytes(png_, info_);
    image.samples.resize(stride * static_cast<std::size_t>(image.height));
    png_read_image(png_, row_pointers(image, stride).data());
    png_read_end(png_, nullptr);
  }

 private:
  void expect_plausible_size(std::size_t bytes) const {
    const png_uint_32 width = png_get_image_width(png_, info_), height = png_get_image_height(png_, info_);
    const bool sane = is_image_size(width, height);
    if (!sane) throw PngError("a header that says " + std::to_string(width) + "x" + std::to_string(height));
    constexpr std::size_t kMaxDeflateRatio = 1032;  // zlib's technical details, "Maximum Compression Factor"
    if (png_get_rowbytes(png_, info_) * height / kMaxDeflateRatio > bytes)
      throw PngError("the file ends too early");
  }

  void normalise_pixels() {
    const int type = png_get_color_type(png_, info_);
    if (type == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(png_);
    if (type == PNG_COLOR_TYPE_GRAY && png_get_bit_depth(png_, info_) < 8)
      png_set_expand_gray_1_2_4_to_8(png_);
    png_set_strip_alpha(png_);
    if constexpr (std::endian::native == std::endian::little) png_set_swap(png_);
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
  }

  png_structp png_;
  png_infop info_;
};

class Writer {
 public:
  Writer()
      : png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, on_error, on_warning)),
        info_(png_create_info_struct(png_)) {}
  ~Writer() { png_destroy_write_struct(&png_, &info_); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  std::string write(const DecodedImage& image) {
    std::string bytes;
    png_set_write_fn(png_, &bytes, append_bytes, nullptr);
    write_header(image);
    if constexpr (std::endian::native == std::endian::little) png_set_swap(png_);
    const std::size_t stride = image.samples.size() / static_cast<std::size_t>(image.height);
    for (int v = 0; v < image.height; ++v)
      png_write_row(png_, image.samples.data() + static_cast<std::size_t>(v) * stride);
    png_write_end(png_, nullptr);
    return bytes;
  }

 private:
  void write_header(const DecodedImage& image) {
    png_set_IHDR(png_, info_, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height),
                 8 * image.bytes_per_sample, image.channels == 3 ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_GRAY,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    constexpr int kFast = 2;  // 3 times the speed of zlib's default for files a tenth larger
    png_set_compression_level(png_, kFast);
    png_set_filter(png_, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB | PNG_FILTER_UP);
    png_write_info(png_, info_);
  }

  png_structp png_;
  png_infop info_;
};

}  // namespace

std::string decode_png(std::string_view bytes, DecodedImage& image) {
  try {
    Reader().read(bytes, image);
  } catch (const PngError& error) {
    return error.what();
  }
  return "";
}

std::string encode_png(const DecodedImage& image) {
  return Writer().write(image);
}

}  // namespace cairn
