// SPDX-License-Identifier: Apache-2.0
#include "cairn/map/colmap_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/geometry/unit_rotation.h"
#include "cairn/map/frame_file.h"
#include "cairn/map/landmark_stream.h"
#include "cairn/map/map_file.h"
#include "cairn/map/map_texts.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

constexpr double kPixelCentre = 0.5;
constexpr double kUnknownError = -1;  // as COLMAP has it

/// A landmark's place and what its sightings have summed up to so far.
struct SightedPoint {
  Eigen::Vector3d point_in_world;
  float distance_sum_px = 0;
  std::uint32_t shown = 0;
  std::uint32_t sightings = 0;  // that it is to have
};

/// Text that goes to a file by and by.
class TextWriter {
 public:
  explicit TextWriter(const fs::path& path) : file_(path) {}
  template <class... Values>
  void add(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
    if (text_.size() >= kPiece) flush();
  }
  void commit() {
    flush();
    file_.commit();
  }

 private:
  static constexpr std::size_t kPiece = 1 << 16;
  void flush() {
    file_.write({text_.data(), text_.size()});
    text_.clear();
  }

  AtomicFile file_;
  fmt::memory_buffer text_;
};

void require_one_world(const fs::path& folder, const MapInfo& info) {
  const auto other = std::find_if(info.keyframes.begin(), info.keyframes.end(), [&](const KeyframeEntry& e) {
    return e.part != info.keyframes.front().part;
  });
  if (other != info.keyframes.end())
    throw InputError(
        {folder.string(), 0, "a map of one part, as a model has one world",
         fmt::format("keyframes of part {} and of part {}", info.keyframes.front().part, other->part),
         "Export a map whose keyframes are all connected."});
}

void write_camera(const fs::path& path, const MapInfo& info) {
  const Rig& rig = info.rig;
  write_file(
      path,
      fmt::format("# CAMERA_ID, MODEL, WIDTH, HEIGHT, fx, fy, cx, cy; pixels have their centres at .5\n"
                  "1 PINHOLE {} {} {} {} {} {}\n",
                  info.width, info.height, rig.fx, rig.fy, rig.cx + kPixelCentre, rig.cy + kPixelCentre));
}

std::vector<SightedPoint> read_points(const fs::path& folder, const MapInfo& info) {
  std::vector<SightedPoint> points;
  LandmarkStream stream(folder, info);
  while (const auto landmark = stream.next())
    points.push_back({landmark->point_in_world, 0, 0, landmark->sightings});
  return points;
}

/// Of pixel and projection; infinite where the point is not in front of the camera.
float distance_px(const Rig& rig, const Eigen::Vector3d& point_in_camera, const Observation& seen) {
  if (!is_in_front(point_in_camera)) return std::numeric_limits<float>::infinity();
  const Eigen::Vector3d projected = rig.project(point_in_camera);
  return static_cast<float>(std::hypot(projected.x() - seen.u, projected.y() - seen.v));
}

/// The numbers that images are called by: of frames where all are known, else of keyframes.
std::vector<std::int32_t> image_numbers(const MapInfo& info) {
  std::vector<std::int32_t> numbers;
  for (const KeyframeEntry& entry : info.keyframes) numbers.push_back(entry.frame.value);
  if (*std::min_element(numbers.begin(), numbers.end()) < 0)
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<std::int32_t>(i);
  return numbers;
}

/// The image's two lines.
void add_image(const FrameFile& frame, std::int32_t number, const CameraFromWorld& camera_from_world,
               TextWriter& file) {
  const Eigen::Quaterniond q = unit_rotation(camera_from_world.rotation);
  const Eigen::Vector3d& t = camera_from_world.translation;
  file.add("{} {} {} {} {} {} {} {} 1 {:06}.png\n", frame.number.value + 1, q.w(), q.x(), q.y(), q.z(), t.x(),
           t.y(), t.z(), number);
  const std::vector<Observation>& seen = frame.observed.observations;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const LandmarkId id = frame.landmarks[i];
    file.add("{}{:.4f} {:.4f} {}", i == 0 ? "" : " ", seen[i].u + kPixelCentre, seen[i].v + kPixelCentre,
             id.valid() ? id.value + 1 : -1);
  }
  file.add("\n");
}

void add_sightings(const Rig& rig, const FrameFile& frame, const CameraFromWorld& camera_from_world,
                   std::vector<SightedPoint>& points) {
  for (std::size_t i = 0; i < frame.landmarks.size(); ++i) {
    if (!frame.landmarks[i].valid()) continue;
    SightedPoint& point = points[static_cast<std::size_t>(frame.landmarks[i].value)];
    point.distance_sum_px +=
        distance_px(rig, camera_from_world * point.point_in_world, frame.observed.observations[i]);
    ++point.shown;
  }
}

void write_images(const fs::path& path, const fs::path& folder, const MapInfo& info,
                  std::vector<SightedPoint>& points) {
  const std::vector<WorldFromCamera> poses = read_map_poses(folder, info);
  const std::vector<std::int32_t> numbers = image_numbers(info);
  TextWriter file(path);
  file.add("# IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME; POINTS2D[] as (X, Y, POINT3D_ID)\n");
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const FrameFile frame = read_frame_file(folder, info, {static_cast<std::int32_t>(i)});
    const CameraFromWorld camera_from_world = poses[i].inverse();
    add_image(frame, numbers[i], camera_from_world, file);
    add_sightings(info.rig, frame, camera_from_world, points);
  }
  file.commit();
}

/// COLMAP ends where a track and the images contradict each other.
void check_sightings(const fs::path& folder, const std::vector<SightedPoint>& points) {
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].shown != points[i].sightings)
      throw InputError({(folder / kPointFile).string(), 0,
                        fmt::format("{} sightings of landmark {}, as frames/ has", points[i].shown, i),
                        fmt::format("{}", points[i].sightings), std::string(kMapRemedy)});
}

void write_points(const fs::path& path, const fs::path& folder, const MapInfo& info,
                  const std::vector<SightedPoint>& points) {
  SightingStream sightings(folder, info);
  TextWriter file(path);
  file.add("# POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n");
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& [point_in_world, sum, shown, count] = points[i];
    const double error = std::isfinite(sum) ? static_cast<double>(sum) / shown : kUnknownError;
    file.add("{} {} {} {} 128 128 128 {:.5f}", i + 1, point_in_world.x(), point_in_world.y(),
             point_in_world.z(), error);
    for (std::uint32_t k = 0; k < count; ++k) {
      const auto row = sightings.next();
      file.add(" {} {}", row->sighting.keyframe.value + 1, row->sighting.feature);
    }
    file.add("\n");
  }
  file.commit();
}

}  // namespace

void write_colmap_model(const fs::path& map_folder, const fs::path& model_folder) {
  const fs::path folder = require_map_folder(map_folder);
  const MapInfo info = read_map_info(folder / kMapInfoFile);
  require_one_world(folder, info);
  std::error_code error;
  fs::create_directories(model_folder, error);
  if (error) fail_writing(model_folder, "make the folder", error.value());
  write_camera(model_folder / "cameras.txt", info);
  std::vector<SightedPoint> points = read_points(folder, info);
  write_images(model_folder / "images.txt", folder, info, points);
  check_sightings(folder, points);
  write_points(model_folder / "points3D.txt", folder, info, points);
}

}  // namespace cairn
