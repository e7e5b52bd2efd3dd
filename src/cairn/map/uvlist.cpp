// SPDX-License-Identifier: Apache-2.0
#include "cairn/map/uvlist.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/geometry/unit_rotation.h"
#include "cairn/map/frame_file.h"

namespace cairn {
namespace {

struct Summary {
  double mean = 0, min = 0, max = 0, std = 0;
};

/// Mean, range and standard deviation (over n) of values, of which there is one at least.
Summary summarize(const std::vector<double>& values) {
  const auto count = static_cast<double>(values.size());
  Summary summary;
  for (const double value : values) summary.mean += value / count;
  const auto [min, max] = std::minmax_element(values.begin(), values.end());
  double squares = 0;
  for (const double value : values) squares += (value - summary.mean) * (value - summary.mean);
  return {summary.mean, *min, *max, std::sqrt(squares / count)};
}

/// How a landmark lies before the cameras that see it, one value for each.
struct Views {
  std::vector<double> distance, lateral, depth, angle_deg;
  double squared_px = 0;  ///< sum of the squared distances of pixel and projection
};

void add_view(const Rig& rig, const Eigen::Vector3d& point_in_camera, const Observation& seen, Views& views) {
  const double lateral = std::hypot(point_in_camera.x(), point_in_camera.y());
  views.distance.push_back(point_in_camera.norm());
  views.lateral.push_back(lateral);
  views.depth.push_back(point_in_camera.z());
  views.angle_deg.push_back(std::atan2(lateral, point_in_camera.z()) * 180.0 / std::numbers::pi);
  const Eigen::Vector3d projected = rig.project(point_in_camera);
  const double du = projected.x() - seen.u, dv = projected.y() - seen.v;
  views.squared_px += du * du + dv * dv;
}

Views views_of(const Map& map, const Landmark& landmark) {
  Views views;
  for (const Sighting& sighting : landmark.sightings) {
    const Keyframe& keyframe = map[sighting.keyframe];
    const Rigid3 world_from_camera{unit_rotation(keyframe.world_from_camera.rotation),
                                   keyframe.world_from_camera.translation};
    const auto& seen = keyframe.observed.observations[static_cast<std::size_t>(sighting.feature)];
    add_view(map.rig(), world_from_camera.inverse() * landmark.point_in_world, as_stored(seen), views);
  }
  return views;
}

std::string format_row(const Map& map, std::size_t number, const Landmark& landmark,
                       const Eigen::Matrix3d& covariance) {
  const Views views = views_of(map, landmark);
  const auto count = static_cast<double>(landmark.sightings.size());
  const Eigen::Vector3d& point = landmark.point_in_world;
  const Eigen::Vector3d std = covariance.diagonal().cwiseSqrt();
  std::string row =
      fmt::format("{} {} {} {} {} {:.6g} {:.6g} {:.6g} {:.6g}", number, point.x(), point.y(), point.z(),
                  landmark.sightings.size(), std.x(), std.y(), std.z(), std::sqrt(views.squared_px / count));
  for (const auto* values : {&views.distance, &views.lateral, &views.depth, &views.angle_deg}) {
    const Summary summary = summarize(*values);
    row += fmt::format(" {:.6g} {:.6g} {:.6g} {:.6g}", summary.mean, summary.min, summary.max, summary.std);
  }
  return row + "\n";
}

std::string format_header() {
  std::string header = "# id x y z frames std_x std_y std_z rms_px";
  for (const char* quantity : {"distance", "lateral", "depth", "angle_deg"})
    for (const char* statistic : {"mean", "min", "max", "std"})
      header += fmt::format(" {}_{}", statistic, quantity);
  return header + "\n";
}

}  // namespace

std::string format_uvlist(const Map& map, std::span<const LandmarkId> landmarks,
                          std::span<const Eigen::Matrix3d> covariances) {
  require(landmarks.size() == covariances.size(), "each landmark has a covariance");
  std::string text = format_header();
  for (std::size_t i = 0; i < landmarks.size(); ++i)
    text += format_row(map, i, map[landmarks[i]], covariances[i]);
  return text;
}

}  // namespace cairn
