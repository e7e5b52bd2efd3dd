// SPDX-License-Identifier: Apache-2.0
// What the calibrations of other programs share: names of distortion models, sizes, rotations.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "cairn/core/error.h"
#include "cairn/core/text.h"
#include "cairn/sequence/calibration_formats.h"

namespace cairn {
namespace {

constexpr std::size_t kBrown = 5;        // k1 k2 p1 p2 k3, which cairn has
constexpr std::size_t kLongest = 14;     // OpenCV: k4 k5 k6 s1 s2 s3 s4 tx ty follow
constexpr std::size_t kEquidistant = 4;  // k1 k2 k3 k4

[[noreturn]] void fail(const SourceLocation& place, std::string expected, std::string found,
                       std::string remedy) {
  throw InputError({place.file, place.line, std::move(expected), std::move(found), std::move(remedy)});
}

template <std::size_t N>
bool is_one_of(std::string_view word, const std::array<std::string_view, N>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// As other programs name Brown's model with OpenCV's order of coefficients.
bool names_brown(std::string_view model) {
  constexpr std::array<std::string_view, 8> kNames{
      "",       "plumb_bob",     "rational_polynomial", "radtan", "radial-tangential",
      "opencv", "brown_conrady", "thin_prism"};
  return is_one_of(model, kNames);
}

bool names_equidistant(std::string_view model) {
  constexpr std::array<std::string_view, 5> kNames{"equidistant", "equi", "fisheye", "kannala_brandt4",
                                                   "kb4"};
  return is_one_of(model, kNames);
}

bool are_zero(std::vector<double>::const_iterator begin, std::vector<double>::const_iterator end) {
  return std::all_of(begin, end, [](double value) { return value == 0; });
}

[[noreturn]] void fail_model(const SourceLocation& place, std::string found) {
  fail(place,
       "a distortion that cairn has: radtan (plumb_bob, k1 k2 p1 p2 k3), equidistant (fisheye, k1 k2 k3 k4) "
       "or "
       "none",
       std::move(found),
       "Calibrate again with one of these (Kalibr: --models pinhole-radtan or pinhole-equi; OpenCV: without "
       "CALIB_RATIONAL_MODEL), or undistort the images and state a pinhole camera in camera.yaml.");
}

void set_brown(std::string_view model, const std::vector<double>& values, const SourceLocation& place,
               Camera& camera) {
  const bool is_count = values.size() == 4 || (values.size() >= kBrown && values.size() <= kLongest);
  if (!is_count && !are_zero(values.begin(), values.end()))
    fail(place, "4 or 5 coefficients k1 k2 p1 p2 k3", fmt::format("{}", values.size()), "Correct the file.");
  const auto end = values.begin() + static_cast<std::ptrdiff_t>(std::min(values.size(), kBrown));
  if (!are_zero(end, values.end()))
    fail_model(place, fmt::format("{} with {} coefficients: {}", model.empty() ? "one" : model, values.size(),
                                  fmt::join(values, ", ")));
  if (are_zero(values.begin(), end)) return;
  camera.model = CameraModel::radtan;
  std::copy(values.begin(), end, camera.distortion.begin());
}

void set_equidistant(const std::vector<double>& values, const SourceLocation& place, Camera& camera) {
  if (values.size() < kEquidistant ||
      !are_zero(values.begin() + static_cast<std::ptrdiff_t>(kEquidistant), values.end()))
    fail(place, "4 coefficients k1 k2 k3 k4 of an equidistant lens", fmt::format("{}", values.size()),
         "Correct the file.");
  camera.model = CameraModel::kb4;
  std::copy_n(values.begin(), kEquidistant, camera.distortion.begin());
}

}  // namespace

void set_distortion(std::string_view model, const std::vector<double>& values, const SourceLocation& place,
                    Camera& camera) {
  if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); }))
    fail(place, "finite coefficients of the distortion", fmt::format("{}", fmt::join(values, ", ")),
         "Correct the file.");
  const std::string name = lower_case(model);
  camera.model = CameraModel::pinhole;
  camera.distortion = {};
  if (names_equidistant(name)) return set_equidistant(values, place, camera);
  if (names_brown(name)) return set_brown(name, values, place, camera);
  if (!are_zero(values.begin(), values.end())) fail_model(place, fmt::format("'{}'", model));
}

void set_image_size(double width, double height, const SourceLocation& place, Camera& camera) {
  constexpr double kMaxSide = 32768;
  for (const double side : {width, height}) {
    if (side >= 1 && side <= kMaxSide && side == std::floor(side)) continue;
    fail(place, "a width and a height from 1 to 32768 pixels", fmt::format("{:g}", side),
         "State the size of the images.");
  }
  camera.width = static_cast<int>(width);
  camera.height = static_cast<int>(height);
}

void check_intrinsics(const SourceLocation& place, const Camera& camera) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  const bool is_focal = camera.fx > 0 && camera.fy > 0 && camera.fx <= kLargest && camera.fy <= kLargest;
  if (!is_focal)
    fail(place, "focal lengths above 0", fmt::format("{:g}, {:g}", camera.fx, camera.fy),
         "Calibrate the camera again: 0 is what drivers publish of one that is not calibrated.");
  if (!std::isfinite(camera.cx) || !std::isfinite(camera.cy))
    fail(place, "a finite principal point", fmt::format("{:g}, {:g}", camera.cx, camera.cy),
         "Correct the file.");
}

Rigid3 transform_of(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation,
                    const SourceLocation& place) {
  constexpr double kMaxDeviation = 0.01;  // rounding passes, another layout does not
  const double deviation = deviation_from_rotation(rotation);
  if (!(deviation <= kMaxDeviation) || !translation.allFinite())
    fail(place, "a rotation and a finite translation, a matrix by rows",
         fmt::format("a matrix that is none (R^T R differs from 1 by {:.2g})", deviation),
         "Correct the matrix.");
  return {nearest_rotation(rotation), translation};
}

}  // namespace cairn
