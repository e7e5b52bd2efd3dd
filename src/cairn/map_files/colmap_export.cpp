// SPDX-License-Identifier: Apache-2.0
#include "cairn/map_files/colmap_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/core/text.h"
#include "cairn/image/codec.h"
#include "cairn/map_files/colmap_features.h"
#include "cairn/map_files/colmap_files.h"
#include "cairn/map_files/colmap_sources.h"
#include "cairn/map_files/frame_file.h"
#include "cairn/map_files/landmark_stream.h"
#include "cairn/map_files/map_file.h"
#include "cairn/map_files/map_text_files.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

constexpr double kPixelCentre = 0.5;  // where COLMAP has it
constexpr std::uint32_t kLeftCamera = 1, kRightCamera = 2;

void require_one_world(const fs::path& folder, const MapInfo& info) {
  const auto other = std::find_if(info.keyframes.begin(), info.keyframes.end(), [&](const KeyframeEntry& e) {
    return e.component != info.keyframes.front().component;
  });
  if (other != info.keyframes.end())
    throw InputError({folder.string(), 0, "a map of one part, as a model has one world",
                      fmt::format("keyframes of part {} and of part {}", info.keyframes.front().component,
                                  other->component),
                      "Export a map whose keyframes are all connected."});
}

/// Throws InputError unless every keyframe is a frame of the sequence.
void require_frames(const fs::path& folder, const MapInfo& info, const Sequence& sequence) {
  for (std::size_t i = 0; i < info.keyframes.size(); ++i) {
    const auto& [frame, stamp_ns, component, checksum] = info.keyframes[i];
    const auto position = frame.index();
    if (frame.valid() && position < sequence.frames.size() && sequence.frames[position].stamp_ns == stamp_ns)
      continue;
    throw InputError({(folder / kMapInfoFile).string(), 0,
                      fmt::format("keyframes that are frames of {}", sequence.folder.string()),
                      fmt::format("keyframe {} of frame {} at {} s", i, frame.value, format_stamp(stamp_ns)),
                      "Export a map together with the sequence, and its --frames, that it was made of."});
  }
}

/// Interpolates between the centres of four pixels; beyond the border the nearest pixel counts.
Rgb8 color_at(const RgbImage& image, const Eigen::Vector2d& pixel) {
  const double x = std::clamp(pixel.x(), 0.0, image.width() - 1.0);
  const double y = std::clamp(pixel.y(), 0.0, image.height() - 1.0);
  const int u = static_cast<int>(x), v = static_cast<int>(y);
  const int next_u = std::min(u + 1, image.width() - 1), next_v = std::min(v + 1, image.height() - 1);
  const auto channel = [&](std::uint8_t Rgb8::*of) {
    const double above = (1 - (x - u)) * image(u, v).*of + (x - u) * image(next_u, v).*of;
    const double below = (1 - (x - u)) * image(u, next_v).*of + (x - u) * image(next_u, next_v).*of;
    return static_cast<std::uint8_t>(std::lround((1 - (y - v)) * above + (y - v) * below));
  };
  return {channel(&Rgb8::r), channel(&Rgb8::g), channel(&Rgb8::b)};
}

/// Returns the median of each channel, the lower one of an even number; there must be a colour.
Rgb8 median_color(std::vector<Rgb8>& colors) {
  const auto channel = [&](std::uint8_t Rgb8::*of) {
    const auto middle = colors.begin() + static_cast<std::ptrdiff_t>((colors.size() - 1) / 2);
    std::nth_element(colors.begin(), middle, colors.end(),
                     [of](const Rgb8& a, const Rgb8& b) { return a.*of < b.*of; });
    return *middle.*of;
  };
  return {channel(&Rgb8::r), channel(&Rgb8::g), channel(&Rgb8::b)};
}

/// Holds a keyframe's images and features.
struct ExportedKeyframe {
  ColmapImage left;
  std::optional<ColmapImage> right;
  std::vector<RecordedFeature> features;
  std::uint64_t observations = 0;
};

class Exporter {
 public:
  Exporter(const fs::path& folder, const MapInfo& info, const Sequence& sequence)
      : folder_(folder),
        info_(info),
        sequence_(sequence),
        root_(colmap_image_root(sequence)),
        rig_(recorded_rig(sequence)),
        poses_(read_map_poses(folder, info)) {}

  [[nodiscard]] ColmapCounts counts() const {
    return {images_each(), poses_.size() * images_each(), info_.landmarks};
  }
  void add_cameras(ColmapWriter& writer) const {
    writer.add_camera(kLeftCamera, rig_.left.camera);
    if (rig_.right) writer.add_camera(kRightCamera, rig_.right->camera);
  }
  /// Reads a keyframe and decodes its image; safe to call from several threads.
  [[nodiscard]] ExportedKeyframe keyframe(std::size_t number) const;
  /// Gathers the track of a landmark; to be called in their order, as `observations` hands out the next rows.
  [[nodiscard]] ColmapPoint point(std::size_t number, const StoredLandmark& landmark,
                                  ObservationStream& observations, RecordedFeatures& features) const;

 private:
  [[nodiscard]] std::uint32_t images_each() const { return rig_.right ? 2 : 1; }
  [[nodiscard]] std::uint32_t left_number(std::size_t keyframe) const {
    return static_cast<std::uint32_t>(keyframe) * images_each() + 1;
  }
  [[nodiscard]] CameraFromWorld left_from_world(std::size_t keyframe) const {
    return CameraFromWorld(Rigid3{rig_.left.recorded_from_map, Eigen::Vector3d::Zero()} *
                           poses_[keyframe].inverse());
  }
  [[nodiscard]] CameraFromWorld right_from_world(std::size_t keyframe) const {
    const Rigid3 right_from_map{rig_.right->recorded_from_map,
                                rig_.right->recorded_from_map * Eigen::Vector3d(-rig_.baseline, 0, 0)};
    return CameraFromWorld(right_from_map * poses_[keyframe].inverse());
  }
  void add_feature(const Observation& seen, LandmarkId landmark, const RgbImage& image,
                   ExportedKeyframe& exported) const;
  [[noreturn]] void fail_contradiction(std::size_t landmark, const ObservationRef& observation) const;

  const fs::path& folder_;
  const MapInfo& info_;
  const Sequence& sequence_;
  fs::path root_;
  RecordedRig rig_;
  std::vector<WorldFromCamera> poses_;
};

/// Lists the feature in an image, if it has a pixel there; returns its position in the list, -1 if it has
/// none.
std::int32_t list_pixel(const std::optional<Eigen::Vector2d>& pixel, LandmarkId landmark,
                        ColmapImage& image) {
  if (!pixel) return -1;
  image.pixels.push_back({pixel->array() + kPixelCentre, landmark.valid() ? landmark.value + 1 : -1});
  return static_cast<std::int32_t>(image.pixels.size()) - 1;
}

void Exporter::add_feature(const Observation& seen, LandmarkId landmark, const RgbImage& image,
                           ExportedKeyframe& exported) const {
  RecordedFeature feature;
  feature.landmark = landmark.valid() ? landmark.value : -1;
  const auto left = rig_.left.pixel(info_.rig, seen.u, seen.v);
  feature.index = list_pixel(left, landmark, exported.left);
  if (left) {
    feature.u = static_cast<float>(left->x());
    feature.v = static_cast<float>(left->y());
    feature.color = color_at(image, *left);
  }
  if (exported.right && seen.has_disparity()) {
    const Eigen::Vector2d recorded =
        info_.right_correction.value_or(StereoCorrection{}).right_pixel(info_.rig, seen.u, seen.v, seen.d);
    const auto right = rig_.right->pixel(info_.rig, recorded.x(), recorded.y());
    feature.right_index = list_pixel(right, landmark, *exported.right);
    if (right) {
      feature.right_u = static_cast<float>(right->x());
      feature.right_v = static_cast<float>(right->y());
    }
  }
  exported.observations += landmark.valid() ? 1 : 0;
  exported.features.push_back(feature);
}

ExportedKeyframe Exporter::keyframe(std::size_t number) const {
  const FrameFiles& files = sequence_.frames[info_.keyframes[number].frame.index()];
  const FrameFile frame = read_frame_file(folder_, info_, {static_cast<std::int32_t>(number)});
  const RgbImage image = read_rgb(files.color);
  ExportedKeyframe exported;
  exported.left = {
      left_number(number), kLeftCamera, left_from_world(number), colmap_image_name(root_, files.color), {}};
  if (rig_.right)
    exported.right = {left_number(number) + 1,
                      kRightCamera,
                      right_from_world(number),
                      colmap_image_name(root_, files.right),
                      {}};
  for (std::size_t i = 0; i < frame.landmarks.size(); ++i)
    add_feature(frame.observed.observations[i], frame.landmarks[i], image, exported);
  return exported;
}

/// Throws because a track and the images contradict each other, for which COLMAP would abort.
void Exporter::fail_contradiction(std::size_t landmark, const ObservationRef& observation) const {
  throw InputError({(folder_ / kDescriptorFile).string(), 0,
                    fmt::format("sightings of landmark {} as frames/ has them", landmark),
                    fmt::format("feature {} of keyframe {}", observation.feature, observation.keyframe.value),
                    std::string(kMapRemedy)});
}

/// Returns the distance of pixel and projection; infinite if the point is not in front of the camera.
double distance_px(const RecordedCamera& camera, const Eigen::Vector3d& point_in_camera, float u, float v) {
  const auto projected = camera.camera.project(point_in_camera);
  if (!projected) return std::numeric_limits<double>::infinity();
  return (*projected - Eigen::Vector2d(static_cast<double>(u), static_cast<double>(v))).norm();
}

ColmapPoint Exporter::point(std::size_t number, const StoredLandmark& landmark,
                            ObservationStream& observations, RecordedFeatures& features) const {
  ColmapPoint point{number + 1, landmark.point_in_world, {}, -1, {}};
  std::vector<Rgb8> colors;
  double sum_px = 0;
  for (std::uint32_t k = 0; k < landmark.observations; ++k) {
    const ObservationRef observation = observations.next()->observation;
    const auto keyframe = observation.keyframe.index();
    if (!features.has(observation)) fail_contradiction(number, observation);
    const RecordedFeature seen = features.at(observation);
    if (seen.landmark != static_cast<std::int32_t>(number)) fail_contradiction(number, observation);
    if (seen.index >= 0) {
      colors.push_back(seen.color);
      point.track.emplace_back(left_number(keyframe), seen.index);
      sum_px += distance_px(rig_.left, left_from_world(keyframe) * landmark.point_in_world, seen.u, seen.v);
    }
    if (seen.right_index >= 0) {
      point.track.emplace_back(left_number(keyframe) + 1, seen.right_index);
      sum_px += distance_px(*rig_.right, right_from_world(keyframe) * landmark.point_in_world, seen.right_u,
                            seen.right_v);
    }
  }
  if (!colors.empty()) point.color = median_color(colors);
  if (std::isfinite(sum_px) && !point.track.empty())
    point.error_px = sum_px / static_cast<double>(point.track.size());
  return point;
}

/// Makes the folder of the model, and removes it again if it was made and stays empty, as after an error.
class ModelFolder {
 public:
  explicit ModelFolder(const fs::path& path) : path_(path) {
    std::error_code error;
    made_ = fs::create_directories(path, error);
    if (error) fail_writing(path, "make the folder", error.value());
  }
  ~ModelFolder() {
    std::error_code ignored;  // of a folder that is not empty
    if (made_) fs::remove(path_, ignored);
  }
  ModelFolder(const ModelFolder&) = delete;
  ModelFolder& operator=(const ModelFolder&) = delete;

 private:
  const fs::path& path_;
  bool made_ = false;
};

struct Targets {
  ColmapWriter& writer;
  RecordedFeatures& features;
};

/// Returns how many features show a landmark.
std::uint64_t add_images(const Exporter& exporter, std::size_t keyframes, const Executor& executor,
                         Progress& progress, const Targets& targets) {
  std::uint64_t observations = 0;
  progress.start("exporting", static_cast<std::int64_t>(keyframes), "keyframes");
  executor.ordered_pipeline<ExportedKeyframe>(
      keyframes, [&](std::size_t i) { return exporter.keyframe(i); },
      [&](std::size_t i, ExportedKeyframe&& keyframe) {
        targets.writer.add_image(keyframe.left);
        if (keyframe.right) targets.writer.add_image(*keyframe.right);
        targets.features.add(keyframe.features);
        observations += keyframe.observations;
        progress.update(static_cast<std::int64_t>(i) + 1);
        return true;
      });
  progress.finish();
  return observations;
}

}  // namespace

void write_colmap_model(const fs::path& map_folder, const Sequence& sequence, const fs::path& model_folder,
                        const Executor& executor, Progress& progress) {
  const fs::path folder = require_map_folder(map_folder);
  const MapInfo info = read_map_info(folder / kMapInfoFile);
  require_one_world(folder, info);
  require_frames(folder, info, sequence);
  const Exporter exporter(folder, info, sequence);
  const ModelFolder made(model_folder);
  ColmapWriter writer(model_folder, exporter.counts());
  RecordedFeatures features(model_folder);
  exporter.add_cameras(writer);
  const std::uint64_t observations =
      add_images(exporter, info.keyframes.size(), executor, progress, {writer, features});
  if (observations != info.observations)
    throw InputError({(folder / kPointFile).string(), 0,
                      fmt::format("{} sightings of landmarks, as frames/ has", observations),
                      fmt::format("{}", info.observations), std::string(kMapRemedy)});
  LandmarkStream landmarks(folder, info);
  ObservationStream rows(folder, info);
  for (std::size_t i = 0; const auto landmark = landmarks.next(); ++i)
    writer.add_point(exporter.point(i, *landmark, rows, features));
  writer.commit();
}

}  // namespace cairn
