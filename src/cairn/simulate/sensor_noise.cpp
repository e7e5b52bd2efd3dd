// SPDX-License-Identifier: Apache-2.0
#include "cairn/simulate/sensor_noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "cairn/core/random.h"

namespace cairn {
namespace {

constexpr std::uint64_t kDepthStreams = 1ULL << 62;  // keeps the depth's random streams from the image's

/// One stream for each row of each frame.
Random row_random(std::uint64_t seed, std::uint64_t frame, int row, std::uint64_t family) {
  return Random(seed, family + (frame << 16) + static_cast<std::uint64_t>(row));
}

/// Mean 0, deviation 1, within +-3.5: the sum of four uniform 16-bit numbers. Much quicker than
/// Random::normal, of which an image would need a million.
float quick_normal(Random& random) {
  const std::uint64_t bits = random.next();
  const std::uint64_t sum = (bits & 0xffff) + (bits >> 16 & 0xffff) + (bits >> 32 & 0xffff) + (bits >> 48);
  constexpr float kSqrt3 = 1.7320508F;
  return (static_cast<float>(sum) + 2.0F) * (kSqrt3 / 65536.0F) - 2.0F * kSqrt3;
}

std::uint8_t rounded(float level) {
  return static_cast<std::uint8_t>(std::clamp(level, 0.0F, 255.0F) + 0.5F);
}

std::uint16_t stored(double depth, double scale) {
  const double units = std::round(depth * scale);
  return units > 65535 ? std::uint16_t{0} : static_cast<std::uint16_t>(units);
}

/// Looks at one pixel's surroundings in the true depth.
class DepthNeighbourhood {
 public:
  DepthNeighbourhood(const DepthImage& depth, const Camera& camera) : depth_(depth), camera_(camera) {}

  /// Tells whether a neighbour lies so much nearer or farther that no surface would be seen at such a slant.
  [[nodiscard]] bool at_edge(int u, int v) const {
    constexpr double kMaxSlope = 15;  // tangent of 86 degrees
    const double z = depth_(u, v);
    const auto jumps = [&](int x, int y) {
      return depth_.contains(x, y) && std::abs(depth_(x, y) - z) * camera_.fx > kMaxSlope * z;
    };
    return jumps(u - 1, v) || jumps(u + 1, v) || jumps(u, v - 1) || jumps(u, v + 1);
  }

  /// Cosine of the angle between the ray and the surface's normal. On a plane the inverse depth w is affine
  /// in the pixel and m = (fx w_x, fy w_y, w - (x - cx) w_x - (y - cy) w_y) is normal to it; with the ray d,
  /// m.d = w.
  [[nodiscard]] double incidence_cosine(int u, int v) const {
    const double w = 1.0 / depth_(u, v);
    const double w_x = flatter(difference(u, v, 1, 0, w), -difference(u, v, -1, 0, w));
    const double w_y = flatter(difference(u, v, 0, 1, w), -difference(u, v, 0, -1, w));
    const double x = u - camera_.cx, y = v - camera_.cy;
    const Eigen::Vector3d normal(camera_.fx * w_x, camera_.fy * w_y, w - x * w_x - y * w_y);
    const Eigen::Vector3d ray(x / camera_.fx, y / camera_.fy, 1);
    return w / (normal.norm() * ray.norm());
  }

 private:
  [[nodiscard]] double difference(int u, int v, int du, int dv, double w) const {
    if (!depth_.contains(u + du, v + dv)) return std::copysign(1e9, du + dv);
    const double z = depth_(u + du, v + dv);
    return z > 0 ? 1.0 / z - w : std::copysign(1e9, du + dv);
  }
  static double flatter(double a, double b) { return std::abs(a) < std::abs(b) ? a : b; }

  const DepthImage& depth_;
  const Camera& camera_;
};

/// Pixels of a row that the projector, `baseline` to the right of the camera, cannot light. The projector
/// sees column x at x - fx b / z; from right to left that must fall, or something nearer is in the way.
void mark_shadows(const float* depth, int width, double focal_baseline, std::vector<char>& shadowed) {
  double leftmost = width + focal_baseline;
  for (int u = width - 1; u >= 0; --u) {
    const auto column = static_cast<std::size_t>(u);
    shadowed[column] = 0;
    if (!(depth[u] > 0)) continue;
    const double lit_from = u - focal_baseline / depth[u];
    shadowed[column] = lit_from > leftmost ? 1 : 0;
    leftmost = std::min(leftmost, lit_from);
  }
}

/// One measurement: noise, then whole steps of disparity. Together they have the deviation of the model.
double measured_depth(double depth, const DepthSensor& sensor, double normal) {
  const double focal_baseline = sensor.focal_length * sensor.baseline;
  const double step = depth * depth * sensor.disparity_step / focal_baseline;  // metres
  const double deviation = sensor.noise_factor * kinect_depth_deviation(depth);
  const double rest = std::sqrt(std::max(0.0, deviation * deviation - step * step / 12));
  const double disparity = focal_baseline / std::max(0.1, depth + rest * normal);
  const double steps = std::max(1.0, std::round(disparity / sensor.disparity_step));
  return focal_baseline / (steps * sensor.disparity_step);
}

}  // namespace

void DepthSensor::validate() const {
  require(min_depth > 0 && max_depth > min_depth, "a depth sensor's range is above 0 and not empty");
  require(baseline > 0 && focal_length > 0 && disparity_step > 0, "a depth sensor measures disparity");
  require(noise_factor >= 0, "noise_factor is at least 0");
  require(full_view_deg < no_view_deg && no_view_deg <= 90, "full_view_deg < no_view_deg <= 90");
}

RgbImage expose_rgb(const Image<Color>& light, const ImageSensor& sensor) {
  RgbImage image(light.width(), light.height());
  for (int v = 0; v < light.height(); ++v) {
    Random random = row_random(sensor.seed, sensor.frame, v, 0);
    for (int u = 0; u < light.width(); ++u) {
      Color level = light(u, v).cwiseProduct(sensor.gain);
      if (sensor.deviation > 0) {
        for (int c = 0; c < 3; ++c) level[c] += sensor.deviation * quick_normal(random);
      }
      image(u, v) = {rounded(level[0]), rounded(level[1]), rounded(level[2])};
    }
  }
  return image;
}

GrayImage expose_gray(const Image<Color>& light, const ImageSensor& sensor) {
  const Color luma = Color(0.299F, 0.587F, 0.114F).cwiseProduct(sensor.gain);
  GrayImage image(light.width(), light.height());
  for (int v = 0; v < light.height(); ++v) {
    Random random = row_random(sensor.seed, sensor.frame, v, 0);
    for (int u = 0; u < light.width(); ++u) {
      const float noise = sensor.deviation > 0 ? sensor.deviation * quick_normal(random) : 0.0F;
      image(u, v) = rounded(light(u, v).dot(luma) + noise);
    }
  }
  return image;
}

double kinect_depth_deviation(double depth) {
  const double beyond = depth - 0.4;
  return 0.0012 + 0.0019 * beyond * beyond;
}

RawDepthImage sense_depth(const DepthImage& depth_true, const Camera& camera, double scale,
                          const DepthSensor& sensor) {
  sensor.validate();
  constexpr double kRadians = std::numbers::pi / 180;
  const double full_cosine = std::cos(sensor.full_view_deg * kRadians);
  const double no_cosine = std::cos(sensor.no_view_deg * kRadians);
  const DepthNeighbourhood neighbourhood(depth_true, camera);
  RawDepthImage raw(depth_true.width(), depth_true.height());
  std::vector<char> shadowed(static_cast<std::size_t>(raw.width()));
  for (int v = 0; v < raw.height(); ++v) {
    Random random = row_random(sensor.seed, sensor.frame, v, kDepthStreams);
    mark_shadows(depth_true.row(v), raw.width(), camera.fx * sensor.baseline, shadowed);
    for (int u = 0; u < raw.width(); ++u) {
      const double z = depth_true(u, v), normal = quick_normal(random), luck = random.uniform();
      if (!(z > 0) || shadowed[static_cast<std::size_t>(u)] != 0 || neighbourhood.at_edge(u, v)) continue;
      const double clear = (neighbourhood.incidence_cosine(u, v) - no_cosine) / (full_cosine - no_cosine);
      if (luck >= clear) continue;
      const double measured = measured_depth(z, sensor, normal);
      if (measured < sensor.min_depth || measured > sensor.max_depth) continue;
      raw(u, v) = stored(measured, scale);
    }
  }
  return raw;
}

RawDepthImage store_depth(const DepthImage& depth_true, double scale) {
  RawDepthImage raw(depth_true.width(), depth_true.height());
  std::transform(depth_true.data(), depth_true.data() + depth_true.size(), raw.data(),
                 [scale](float depth) { return stored(depth, scale); });
  return raw;
}

}  // namespace cairn
