// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cairn/core/error.h"
#include "cairn/core/text.h"
#include "cairn/sequence/skipped_frames.h"
#include "cairn/sequence/time_unit.h"

namespace cairn {

namespace fs = std::filesystem;

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (!entry.path().filename().string().starts_with('.')) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return comes_naturally_before(a.filename().string(), b.filename().string());
  });
  return files;
}

bool is_image_name(const fs::path& file) {
  constexpr std::array<std::string_view, 5> kExtensions{".png", ".jpg", ".jpeg", ".pgm", ".ppm"};
  const std::string extension = lower_case(file.extension().string());
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

ImageSize size_of_images(std::span<const fs::path> images) {
  Progress silent;
  SkippedFrames unreadable(silent);
  std::vector<ImageSize> sizes;
  for (const fs::path& path : images) {
    try {
      const ImageSize size = probe_image(path);
      unreadable.take();
      if (std::find(sizes.begin(), sizes.end(), size) != sizes.end()) return size;
      sizes.push_back(size);
    } catch (const InputError&) {
      unreadable.skip(std::current_exception());
    }
  }
  unreadable.finish();
  return sizes.empty() ? ImageSize{} : sizes.front();
}

std::optional<std::int64_t> parse_frame_number(std::string_view text) {
  std::int64_t number = 0;
  if (text.starts_with('-') || !parse_integer(text, number)) return std::nullopt;
  return number;
}

std::int64_t stamp_of_number(std::int64_t number, double rate_hz) {
  constexpr double kMaxStamp = 9e18;
  const double stamp_ns = static_cast<double>(number) * 1e9 / rate_hz;
  if (!(std::abs(stamp_ns) <= kMaxStamp)) {
    throw InputError(
        {fmt::format("frame number {}", number), 0,
         fmt::format("a frame number below {:.3g} at {} frames per second", 9e9 * rate_hz, rate_hz),
         fmt::format("{}", number), "Number the files from 0, or list them with time stamps (TUM)."});
  }
  return std::llround(stamp_ns);
}

bool has_clock(const Sequence& sequence) {
  return sequence.format == "TUM" || sequence.format == "EuRoC" || sequence.format == "stamped";
}

bool has_frame_numbers(const fs::path& path) {
  const TextFile file(path);
  std::vector<std::string_view> first;
  for (const TextLine& line : file.lines()) first.push_back(line.fields.front());
  const bool are_whole = std::all_of(first.begin(), first.end(), [](std::string_view text) {
    std::int64_t number = 0;
    return parse_integer(text, number);
  });
  return are_whole && infer_time_unit(first) == TimeUnit::second;
}

}  // namespace cairn
