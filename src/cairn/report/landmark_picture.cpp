// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/landmark_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>

#include "cairn/core/distribution.h"
#include "cairn/map_files/landmark_stream.h"
#include "cairn/map_files/map_file.h"
#include "cairn/map_files/map_text_files.h"
#include "cairn/report/colors.h"
#include "cairn/report/landmark_layer.h"
#include "cairn/report/lettering.h"
#include "cairn/report/plan_legend.h"
#include "cairn/report/plan_view.h"
#include "cairn/report/raster.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

constexpr Rgb8 kPaperTop{250, 251, 252}, kPaperBottom{222, 227, 233};  // as of the picture of a cloud
constexpr Rgb8 kPath{30, 41, 59}, kHalo{255, 255, 255}, kPale{148, 163, 184};
constexpr Rgb8 kStart{22, 163, 74}, kEnd{220, 38, 38}, kGood{22, 163, 74}, kWeak{234, 88, 12};
constexpr double kMargin = 30, kHeader = 84, kFooter = 84;  // pixels around the drawing

/// What is drawn of a map: the component with most keyframes.
struct MainComponent {
  fs::path folder;
  MapInfo info;
  std::int32_t component = 0;
  bool is_whole = true;
  std::vector<WorldFromCamera> poses;
  std::vector<std::size_t> begins;  ///< where in `poses` a recording begins
};

std::int32_t largest_component(const MapInfo& info) {
  std::map<std::int32_t, std::int32_t> sizes;
  for (const KeyframeEntry& entry : info.keyframes) ++sizes[entry.component];
  std::int32_t best = sizes.begin()->first;
  for (const auto& [component, size] : sizes)
    if (size > sizes[best]) best = component;
  return best;
}

MainComponent read_main_component(const fs::path& map_folder) {
  const fs::path folder = require_map_folder(map_folder);
  MainComponent map{folder, read_map_info(folder / kMapInfoFile), 0, true, {}, {}};
  map.component = largest_component(map.info);
  const std::vector<WorldFromCamera> poses = read_map_poses(folder, map.info);
  std::optional<std::int64_t> before;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const KeyframeEntry& entry = map.info.keyframes[i];
    if (entry.component != map.component) {
      map.is_whole = false;
      continue;
    }
    if (!before || entry.stamp_ns <= *before) map.begins.push_back(map.poses.size());
    before = entry.stamp_ns;
    map.poses.push_back(poses[i]);
  }
  return map;
}

/// Hands out the landmarks of the component; their observations are read only if there are other components.
template <class Take>
void for_each_landmark(const MainComponent& map, const Take& take) {
  LandmarkStream landmarks(map.folder, map.info);
  std::optional<ObservationStream> observations;
  if (!map.is_whole) observations.emplace(map.folder, map.info);
  while (const auto landmark = landmarks.next()) {
    bool is_in_component = true;
    for (std::uint32_t i = 0; observations && i < landmark->observations; ++i) {
      const auto keyframe = static_cast<std::size_t>(observations->next()->observation.keyframe.value);
      if (i == 0) is_in_component = map.info.keyframes[keyframe].component == map.component;
    }
    if (is_in_component) take(*landmark);
  }
}

/// Where landmarks lie along one axis of the plane, metres.
struct Places {
  Distribution across, up;

  void add(const Eigen::Vector2d& place) {
    across.add(place.x());
    up.add(place.y());
  }
  /// All but the outermost hundredths in either direction, so that outliers do not shrink the scene.
  void extend(PlanRange& range) const {
    constexpr double kOutside = 0.01;
    if (across.count() == 0) return;
    for (const double share : {kOutside, 1 - kOutside})
      range.include({across.quantile(share), up.quantile(share)});
  }
};

/// Returns the range of the path, the good poses and the landmarks; those beyond the scale of standard
/// deviations count only if nearly all are.
PlanRange range_of(const MainComponent& map, const std::vector<FoundPose>& found, const PlanView& view) {
  constexpr double kFewCertain = 0.05;
  PlanRange range;  // the origin is on the path
  for (const WorldFromCamera& pose : map.poses) range.include(view.metres(pose.translation));
  for (const FoundPose& pose : found)
    if (pose.good) range.include(view.metres(pose.world_from_camera.translation));
  Places certain, all;
  for_each_landmark(map, [&](const StoredLandmark& landmark) {
    const Eigen::Vector2d place = view.metres(landmark.point_in_world);
    all.add(place);
    if (!(largest_std(landmark) > kHighStd)) certain.add(place);
  });
  const bool are_few =
      static_cast<double>(certain.across.count()) < kFewCertain * static_cast<double>(all.across.count());
  (are_few ? all : certain).extend(range);
  return range;
}

PlanView view_of(const MainComponent& map, const std::vector<FoundPose>& found) {
  PlanView view;
  view.axes = choose_plan_axes(map.info.origin.has_value(), map.poses);
  view.origin = map.poses.front().translation;
  fit_plan(range_of(map, found, view), {}, view);
  view.corner = {kMargin, kHeader};
  return view;
}

RgbImage blank_picture(const PlanView& view) {
  const Eigen::Vector2d size = view.size + Eigen::Vector2d(2 * kMargin, kHeader + kFooter);
  RgbImage picture(static_cast<int>(size.x()), static_cast<int>(size.y()));
  for (int v = 0; v < picture.height(); ++v)
    fill_rectangle(picture, {0, v}, {picture.width(), 1}, mix(kPaperTop, kPaperBottom, v / (size.y() - 1)));
  return picture;
}

LandmarkLayer gather_landmarks(const MainComponent& map, const PlanView& view, const RgbImage& picture) {
  LandmarkLayer layer(picture.width(), picture.height(), map.info.landmarks);
  for_each_landmark(map, [&](const StoredLandmark& landmark) {
    layer.add(view(landmark.point_in_world), largest_std(landmark));
  });
  return layer;
}

/// Draws the header and the footer over what of the scene lies there.
void draw_frame(RgbImage& picture, const MainComponent& map, const PlanView& view, std::string_view what) {
  const double bottom = kHeader + view.size.y();
  for (int v = 0; v < picture.height(); ++v)
    if (v < kHeader - 10 || v > bottom + 4)
      fill_rectangle(picture, {0, v}, {picture.width(), 1},
                     mix(kPaperTop, kPaperBottom, v / (picture.height() - 1.0)));
  draw_text(picture, {kMargin, 40}, what, {.height_px = 16, .bold = true});
  draw_text(picture, {kMargin, 66},
            fmt::format("{} landmarks, {} keyframes{}", map.info.landmarks, map.info.keyframes.size(),
                        map.is_whole ? "" : fmt::format(", the part of {} drawn", map.poses.size())));
  draw_directions(picture, view.axes, {picture.width() - 12.0, 6});
  draw_scale_bar(picture, view.pixels_per_metre, {picture.width() - kMargin, picture.height() - 30.0});
}

void draw_path(RgbImage& picture, const MainComponent& map, const PlanView& view, double width,
               const Rgb8& color) {
  for (std::size_t i = 1, recording = 1; i < map.poses.size(); ++i) {
    const bool begins = recording < map.begins.size() && map.begins[recording] == i;
    recording += begins ? 1 : 0;
    if (!begins)
      draw_line(picture, view(map.poses[i - 1].translation), view(map.poses[i].translation), color, width);
  }
}

/// Draws a mark with its name, which is written on the side where the path, with its next place at `next`, is
/// not, if there is room.
void draw_mark(RgbImage& picture, const Eigen::Vector2d& place, const Eigen::Vector2d& next,
               const Rgb8& color, const char* name) {
  constexpr double kRadius = 7, kRim = 2, kHeight = 14, kAway = 15;
  fill_circle(picture, place, kRadius + kRim, kHalo);
  fill_circle(picture, place, kRadius, color);
  const double room = kAway + text_width(name, kHeight) + 4;
  const bool is_right = place.x() < room || (place.x() >= next.x() && place.x() + room < picture.width());
  const Eigen::Vector2d text = place + Eigen::Vector2d(is_right ? kAway : -kAway, 5);
  Lettering lettering{.height_px = kHeight,
                      .color = kHalo,
                      .anchor = is_right ? LetteringAnchor::start : LetteringAnchor::end,
                      .bold = true};
  for (const double across : {-2, 0, 2})  // a rim, so that it can be read before landmarks
    for (const double up : {-2, 0, 2})
      draw_text(picture, text + Eigen::Vector2d(across, up), name, lettering);
  lettering.color = color;
  draw_text(picture, text, name, lettering);
}

/// Marks start and end of each recording of the map.
void draw_ends(RgbImage& picture, const MainComponent& map, const PlanView& view) {
  constexpr std::size_t kNext = 5;  // keyframes further on: where the path goes
  const auto place = [&](std::size_t i) { return view(map.poses[i].translation); };
  for (std::size_t i = 0; i < map.begins.size(); ++i) {
    const std::size_t first = map.begins[i];
    const std::size_t last = (i + 1 < map.begins.size() ? map.begins[i + 1] : map.poses.size()) - 1;
    draw_mark(picture, place(last), place(std::max(first + kNext, last) - kNext), kEnd, "end");
    draw_mark(picture, place(first), place(std::min(last, first + kNext)), kStart, "start");
  }
}

void draw_found_pose(RgbImage& picture, const FoundPose& pose, const PlanView& view) {
  constexpr double kRadius = 4, kRim = 1.2, kLook = 16;
  const Eigen::Vector2d place = view(pose.world_from_camera.translation);
  const Eigen::Vector3d forward = pose.world_from_camera.rotation * Eigen::Vector3d::UnitZ();
  const Eigen::Vector2d look(view.axes.right.dot(forward), -view.axes.up.dot(forward));
  const Rgb8& color = pose.good ? kGood : kWeak;
  draw_line(picture, place, place + kLook * look, color, 1.8);
  fill_circle(picture, place, kRadius + kRim, kHalo);
  fill_circle(picture, place, kRadius, color);
}

}  // namespace

RgbImage draw_landmarks(const fs::path& map_folder) {
  const MainComponent map = read_main_component(map_folder);
  const PlanView view = view_of(map, {});
  RgbImage picture = blank_picture(view);
  const LandmarkLayer layer = gather_landmarks(map, view, picture);
  layer.draw(picture);
  draw_path(picture, map, view, 5.5, kHalo);
  draw_path(picture, map, view, 2.5, kPath);
  draw_ends(picture, map, view);
  draw_frame(picture, map, view, "the map from above");
  draw_std_legend(picture, {layer.has_known(), layer.has_unknown()}, {kMargin + 16, picture.height() - 44.0});
  return picture;
}

RgbImage draw_found_poses(const fs::path& map_folder, const std::vector<FoundPose>& found,
                          std::int64_t not_found) {
  const MainComponent map = read_main_component(map_folder);
  const PlanView view = view_of(map, found);
  RgbImage picture = blank_picture(view);
  gather_landmarks(map, view, picture).draw(picture, kPale);
  draw_path(picture, map, view, 1.6, kPath);
  std::size_t good = 0;
  for (const bool is_good : {false, true})
    for (const FoundPose& pose : found)
      if (pose.good == is_good) draw_found_pose(picture, pose, view), good += is_good ? 1 : 0;
  draw_frame(picture, map, view, "poses found in the map, from above");
  const std::array<std::pair<Rgb8, std::string>, 2> verdicts{
      {{kGood, fmt::format("good {}", good)}, {kWeak, fmt::format("weak {}", found.size() - good)}}};
  const std::array<std::pair<Rgb8, std::string>, 2> of_map{
      {{kPath, "path of the map"}, {kPale, "landmarks"}}};
  const double text = draw_dot_legend(picture, verdicts, {kMargin, picture.height() - 52.0});
  draw_text(picture, {text, picture.height() - 52.0}, fmt::format("not found {}", not_found));
  draw_dot_legend(picture, of_map, {kMargin, picture.height() - 24.0});
  return picture;
}

}  // namespace cairn
