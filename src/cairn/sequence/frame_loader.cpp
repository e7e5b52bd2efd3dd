// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "cairn/core/error.h"
#include "cairn/image/codec.h"
#include "cairn/image/registration.h"
#include "cairn/sequence/sequence.h"

namespace cairn {
namespace {

template <class Pixel>
void expect_size(const Image<Pixel>& image, const Camera& camera, const std::filesystem::path& path) {
  if (image.width() == camera.width && image.height() == camera.height) return;
  throw InputError(
      {path.string(), 0,
       fmt::format("an image of {}x{} pixels, as the calibration says", camera.width, camera.height),
       fmt::format("{}x{}", image.width(), image.height()),
       "Give the calibration that belongs to these images."});
}

}  // namespace

struct FrameLoader::Impl {
  const Sequence* sequence;
  std::optional<DepthRegistration> registration;

  [[nodiscard]] const FrameFiles& files(FrameId id) const {
    require(id.valid() && static_cast<std::size_t>(id.value) < sequence->frames.size(),
            "a frame of the sequence");
    return sequence->frames[static_cast<std::size_t>(id.value)];
  }
};

FrameLoader::FrameLoader(const Sequence& sequence)
    : impl_(std::make_unique<Impl>(Impl{&sequence, std::nullopt})) {
  const auto& depth = sequence.calibration.depth;
  if (depth && depth->camera)
    impl_->registration.emplace(*depth->camera, sequence.calibration.camera, depth->camera_from_depth);
}

FrameLoader::~FrameLoader() = default;

RgbImage FrameLoader::load_color(FrameId id) const {
  const auto& path = impl_->files(id).color;
  RgbImage image = read_rgb(path);
  expect_size(image, impl_->sequence->calibration.camera, path);
  return image;
}

DepthImage FrameLoader::load_depth(FrameId id) const {
  const auto& path = impl_->files(id).depth;
  if (path.empty()) return {};
  const Calibration& calibration = impl_->sequence->calibration;
  const RawDepthImage raw = read_depth(path);
  expect_size(raw, calibration.depth->camera.value_or(calibration.camera), path);
  DepthImage depth = depth_in_metres(raw, calibration.depth->scale, calibration.depth->invalid);
  return impl_->registration ? (*impl_->registration)(depth) : depth;
}

Frame FrameLoader::load(FrameId id) const {
  const FrameFiles& files = impl_->files(id);
  Frame frame{id, files.stamp_ns, read_gray(files.color), {}};
  expect_size(frame.gray, impl_->sequence->calibration.camera, files.color);
  frame.depth = load_depth(id);
  return frame;
}

}  // namespace cairn
