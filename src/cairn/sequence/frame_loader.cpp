// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <functional>
#include <utility>

#include "cairn/core/error.h"
#include "cairn/geometry/stereo_correction.h"
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

using SourceOf = std::function<std::optional<Eigen::Vector2d>(const Eigen::Vector2d&)>;

/// Returns where a raw camera sees the pixel of the rectified one.
SourceOf raw_pixel(const Camera& raw, const Camera& rectified, const Eigen::Quaterniond& rectified_from_raw) {
  return [raw, rectified, rotation = rectified_from_raw.conjugate().toRotationMatrix().eval()](
             const Eigen::Vector2d& pixel) -> std::optional<Eigen::Vector2d> {
    const auto ray = rectified.unproject(pixel);
    return ray ? raw.project(rotation * ray->homogeneous()) : std::nullopt;
  };
}

/// Returns `source_of` at the right pixel that shows what the left image has on the target's row.
SourceOf on_the_left_row(const Calibration& calibration, SourceOf source_of) {
  const Camera& camera = calibration.camera;
  const Rig rig{camera.fx, camera.fy, camera.cx, camera.cy, calibration.baseline.value_or(1)};
  return [rig, correction = *calibration.right_correction,
          source_of = std::move(source_of)](const Eigen::Vector2d& pixel) {
    return source_of({pixel.x(), correction.right_row(rig, pixel.x(), pixel.y())});
  };
}

Rectifier left_rectifier(const Calibration& calibration) {
  if (!calibration.raw_stereo) return {calibration.camera, {}};
  const auto& [pair, rectification] = *calibration.raw_stereo;
  return {pair.left,
          ImageRemap(pair.left, calibration.camera, rectification.rectified_from_left.conjugate())};
}

Rectifier right_rectifier(const Calibration& calibration) {
  const Camera& camera = calibration.camera;
  const bool correct = calibration.right_correction && !calibration.right_correction->rows.isZero(0);
  if (!calibration.raw_stereo && !correct) return {camera, {}};
  Camera raw = camera;
  SourceOf source_of = [](const Eigen::Vector2d& pixel) { return std::optional(pixel); };
  if (calibration.raw_stereo) {
    const auto& [pair, rectification] = *calibration.raw_stereo;
    raw = pair.right;
    source_of = raw_pixel(raw, camera, rectification.rectified_from_right);
  }
  if (correct) source_of = on_the_left_row(calibration, std::move(source_of));
  return {raw, ImageRemap({raw.width, raw.height}, {camera.width, camera.height}, source_of)};
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
  impl_->left = left_rectifier(calibration);
  impl_->right = right_rectifier(calibration);
  if (calibration.depth && calibration.depth->camera) {
    impl_->registration.emplace(*calibration.depth->camera, calibration.camera,
                                calibration.depth->camera_from_depth);
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
