// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/two_view_report.h"

#include <cmath>
#include <cstdint>
#include <numbers>

#include "cairn/report/text_builder.h"
#include "cairn/report/two_view_figures.h"

namespace cairn {

double rms_px(const TwoViewReport& report) {
  double sum = 0;
  for (const TwoViewPoint& point : report.result.points) sum += point.triangulated.squared_error;
  return report.focal_px * std::sqrt(sum / (2.0 * static_cast<double>(report.result.points.size())));
}

std::string format_points_csv(const TwoViewReport& report) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  TextBuilder csv;
  csv.add("u1,v1,u2,v2,x,y,z,angle_deg\n");
  for (const TwoViewPoint& point : report.result.points) {
    const auto pair = static_cast<std::size_t>(point.pair);
    const Eigen::Vector2d &p = report.pixels_in_a[pair], &q = report.pixels_in_b[pair];
    const Eigen::Vector3d x = report.unit() * point.triangulated.point_in_a;
    csv.add("{},{},{},{},{},{},{},{}\n", p.x(), p.y(), q.x(), q.y(), x.x(), x.y(), x.z(),
            kDegrees * point.triangulated.angle);
  }
  return csv.take();
}

Cloud cloud_of(const TwoViewReport& report) {
  Cloud cloud;
  for (const TwoViewPoint& point : report.result.points) {
    const Eigen::Vector2d& pixel = report.pixels_in_a[static_cast<std::size_t>(point.pair)];
    const std::uint8_t grey =
        report.a.image(static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y())));
    const Eigen::Vector3f x = (report.unit() * point.triangulated.point_in_a).cast<float>();
    cloud.points.push_back({x.x(), x.y(), x.z(), grey, grey, grey});
  }
  return cloud;
}

double relative_distance(const Eigen::Matrix3d& essential, const EssentialDecomposition& parts) {
  return (skew(parts.translation) * parts.rotations[0] - essential).norm() / essential.norm();
}

}  // namespace cairn
