// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "cairn/core/error.h"
#include "cairn/image/codec.h"
#include "cairn/image/registration.h"
#include "cairn/image/remap.h"
#include "cairn/sequence/sequence.h"

namespace cairn {
namespace {

void expect_size(const ImageSize& size, const Camera& camera, const std::filesystem::path& path) {
  if (size == ImageSize{camera.width, camera.height}) return;
  throw InputError(
      {path.string(), 0,
       fmt::format("an image of {}x{} pixels, as the calibration says", camera.width, camera.height),
       fmt::format("{}x{}", size.width, size.height),
       "Give the calibration of these images, by --camera FILE or as camera.yaml in their folder."});
}

/// An image of one camera of a stereo pair, or of the only one, as the calibration's camera sees it.
struct Rectifier {
  Camera raw;  ///< of the images on disk
  std::optional<ImageRemap> rectify;

  template <class ImageType>
  [[nodiscard]] ImageType see(ImageType image, const std::filesystem::path& path) const {
    expect_size({image.width(), image.height()}, raw, path);
    return rectify ? (*rectify)(image) : std::move(image);
  }
};

Rectifier rectifier_of(const Camera& raw, const Camera& rectified,
                       const Eigen::Quaterniond& rectified_from_raw) {
  return {raw, ImageRemap(raw, rectified, rectified_from_raw.conjugate())};
}

}  // namespace

struct FrameLoader::Impl {
  const Sequence* sequence;
  std::optional<DepthRegistration> registration;
  Rectifier left, right;

  [[nodiscard]] const FrameFiles& files(FrameId id) const {
    require(id.valid() && id.index() < sequence->frames.size(), "a frame of the sequence");
    return sequence->frames[id.index()];
  }
};

FrameLoader::FrameLoader(const Sequence& sequence) : impl_(std::make_unique<Impl>()) {
  const Calibration& calibration = sequence.calibration;
  impl_->sequence = &sequence;
  impl_->left.raw = impl_->right.raw = calibration.camera;
  if (calibration.depth && calibration.depth->camera) {
    impl_->registration.emplace(*calibration.depth->camera, calibration.camera,
                                calibration.depth->camera_from_depth);
  }
  if (calibration.raw_stereo) {
    const auto& [pair, rectification] = *calibration.raw_stereo;
    impl_->left = rectifier_of(pair.left, calibration.camera, rectification.rectified_from_left);
    impl_->right = rectifier_of(pair.right, calibration.camera, rectification.rectified_from_right);
  }
}

FrameLoader::~FrameLoader() = default;

RgbImage FrameLoader::load_color(FrameId id) const {
  const auto& path = impl_->files(id).color;
  return impl_->left.see(read_rgb(path), path);
}

GrayImage FrameLoader::load_right(FrameId id) const {
  const auto& path = impl_->files(id).right;
  return path.empty() ? GrayImage() : impl_->right.see(read_gray(path), path);
}

DepthImage FrameLoader::load_depth(FrameId id) const {
  const auto& path = impl_->files(id).depth;
  if (path.empty()) return {};
  const Calibration& calibration = impl_->sequence->calibration;
  const RawDepthImage raw = read_depth(path);
  expect_size({raw.width(), raw.height()}, calibration.depth->camera.value_or(calibration.camera), path);
  DepthImage depth = depth_in_metres(raw, calibration.depth->scale, calibration.depth->invalid);
  return impl_->registration ? (*impl_->registration)(depth) : depth;
}

void FrameLoader::probe(FrameId id) const {
  const FrameFiles& files = impl_->files(id);
  const Calibration& calibration = impl_->sequence->calibration;
  expect_size(probe_image(files.color), impl_->left.raw, files.color);
  if (!files.right.empty()) expect_size(probe_image(files.right), impl_->right.raw, files.right);
  if (files.depth.empty()) return;
  expect_size(probe_image(files.depth), calibration.depth->camera.value_or(calibration.camera), files.depth);
}

Frame FrameLoader::load(FrameId id) const {
  const FrameFiles& files = impl_->files(id);
  Frame frame{id, files.stamp_ns, impl_->left.see(read_gray(files.color), files.color), {}, {}};
  frame.depth = load_depth(id);
  frame.right = load_right(id);
  return frame;
}

}  // namespace cairn
