// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "cairn/geometry/camera.h"
#include "cairn/image/image.h"
#include "cairn/simulate/texture.h"

namespace cairn {

/// Describes the sensor that converts light to grey levels: gain per channel, then normal noise, then
/// rounding.
struct ImageSensor {
  Color gain = Color::Ones();
  float deviation = 0;     ///< standard deviation of the noise, grey levels
  std::uint64_t seed = 0;  ///< determines all noise, together with `frame`
  std::uint64_t frame = 0;
};

/// Exposes a colour image.
[[nodiscard]] RgbImage expose_rgb(const Image<Color>& light, const ImageSensor& sensor);
/// Exposes a grey image: Rec. 601 luma of the light times the gain, with noise added to the luma.
[[nodiscard]] GrayImage expose_gray(const Image<Color>& light, const ImageSensor& sensor);

/// Describes a depth sensor with structured light, a Kinect v1 by default. Its disparity has whole steps; its
/// projector stands beside its camera, so that near things cast shadows without depth to their left; it fails
/// at depth edges and at grazing incidence.
struct DepthSensor {
  double min_depth = 0.5;         ///< metres; a smaller depth is not found
  double max_depth = 5.0;         ///< metres; a larger depth is not found
  double baseline = 0.075;        ///< metres, projector to camera
  double focal_length = 580.0;    ///< pixels, of the infrared camera: scale of the disparity
  double disparity_step = 0.125;  ///< pixels
  double noise_factor = 1;        ///< of kinect_depth_deviation
  double full_view_deg = 75.0;    ///< angle between ray and normal up to which depth is always found
  double no_view_deg = 84.0;      ///< angle from which depth is never found
  std::uint64_t seed = 0;
  std::uint64_t frame = 0;

  /// Throws PreconditionError if a value is out of range.
  void validate() const;
};

/// Computes the standard deviation of a Kinect v1's depth, metres, quantisation included: 1.2 mm + 1.9 mm (z
/// - 0.4 m)^2 with z in metres (Nguyen, Izadi, Lovell: "Modeling Kinect Sensor Noise", 3DIMPVT 2012, eq. 2
/// without its angular term).
[[nodiscard]] double kinect_depth_deviation(double depth);

/// Simulates what the sensor stores of the true depth: `scale` units per metre, 0 if it finds none.
[[nodiscard]] RawDepthImage sense_depth(const DepthImage& depth_true, const Camera& camera, double scale,
                                        const DepthSensor& sensor);
/// Rounds the true depth to the storage's unit: a sensor without faults.
[[nodiscard]] RawDepthImage store_depth(const DepthImage& depth_true, double scale);

}  // namespace cairn
