// SPDX-License-Identifier: Apache-2.0
#include "cairn/map_files/map_file.h"

#include <cstring>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/geometry/covariance.h"
#include "cairn/geometry/unit_rotation.h"
#include "cairn/map_files/frame_file.h"
#include "cairn/map_files/map_writer.h"

namespace cairn {
namespace {

/// Holds what is written of a map, in the order of the new numbers.
struct Selection {
  std::vector<KeyframeId> keyframes;
  std::vector<LandmarkId> landmarks;
  std::vector<KeyframeId>
      keyframe_numbers;  ///< new number of each keyframe of the map; not valid if it is erased
  std::vector<LandmarkId> landmark_numbers;
};

template <class AnyId>
std::vector<AnyId> numbers_of(const std::vector<AnyId>& selected, std::size_t count) {
  std::vector<AnyId> numbers(count);
  for (std::size_t i = 0; i < selected.size(); ++i)
    numbers[selected[i].index()] = {static_cast<std::int32_t>(i)};
  return numbers;
}

Selection select(const Map& map) {
  Selection selection{map.keyframe_ids(), map.landmark_ids(), {}, {}};
  selection.keyframe_numbers = numbers_of(selection.keyframes, map.keyframes().size());
  selection.landmark_numbers = numbers_of(selection.landmarks, map.landmarks().size());
  return selection;
}

/// Returns the header with the norm and size of the map's descriptors.
MapHeader header_of(const Map& map) {
  MapHeader header = map.header();
  for (const Keyframe& keyframe : map.keyframes()) {
    const Descriptors& descriptors = keyframe.observed.features.descriptors;
    if (descriptors.count() == 0) continue;
    header.descriptor.norm = descriptors.norm();
    header.descriptor.bytes = static_cast<std::uint32_t>(descriptors.bytes());
    break;
  }
  return header;
}

std::vector<LandmarkId> renumbered(const std::vector<LandmarkId>& landmarks, const Selection& selection) {
  std::vector<LandmarkId> numbers(landmarks.size());
  for (std::size_t i = 0; i < landmarks.size(); ++i)
    if (landmarks[i].valid()) numbers[i] = selection.landmark_numbers[landmarks[i].index()];
  return numbers;
}

/// Returns the view of an observation as a reader of the files will have it, so that a map that was read
/// gives the same table.
PosedObservation stored_view(const Keyframe& keyframe, std::size_t feature) {
  const WorldFromCamera world_from_camera(
      {unit_rotation(keyframe.world_from_camera.rotation), keyframe.world_from_camera.translation});
  return {world_from_camera.inverse(), as_stored(keyframe.observed.observations[feature])};
}

FinishedLandmark finished(const Map& map, const Landmark& landmark, const Eigen::Matrix3d& covariance,
                          const Selection& selection, const DescriptorKind& kind) {
  FinishedLandmark result{
      landmark.point_in_world, as_covariance(covariance), landmark.observations, {}, {}, {}};
  result.descriptors = Descriptors(kind.norm, kind.bytes, landmark.observations.size());
  std::vector<PosedObservation> views;
  for (std::size_t i = 0; i < landmark.observations.size(); ++i) {
    const Keyframe& keyframe = map[landmark.observations[i].keyframe];
    const auto feature = static_cast<std::size_t>(landmark.observations[i].feature);
    const Features& features = keyframe.observed.features;
    require(feature < features.keypoints.size(), "a sighting is of a feature with a keypoint");
    views.push_back(stored_view(keyframe, feature));
    result.keypoints.push_back(features.keypoints[feature]);
    std::memcpy(result.descriptors.row(i), features.descriptors.row(feature), kind.bytes);
    result.observations[i].keyframe = selection.keyframe_numbers[landmark.observations[i].keyframe.index()];
  }
  result.indicators = indicators_of(map.rig(), landmark.point_in_world, views);
  return result;
}

}  // namespace

void write_map(const std::filesystem::path& folder, const Map& map,
               std::span<const Eigen::Matrix3d> covariances) {
  const Selection selection = select(map);
  require(!selection.keyframes.empty(), "a map to write has keyframes");
  require(covariances.empty() || covariances.size() == map.landmarks().size(),
          "a covariance for each landmark, or none");
  OutputFolder output(folder, "map");
  const MapHeader header = header_of(map);
  MapWriter writer(output.work(), header);
  for (const KeyframeId id : selection.keyframes)
    writer.add_frame(map[id].observed, renumbered(map[id].landmarks, selection),
                     WorldFromCamera(map[id].world_from_camera), map[id].component);
  for (const LandmarkId id : selection.landmarks) {
    const Eigen::Matrix3d covariance =
        covariances.empty() ? Eigen::Matrix3d::Zero() : covariances[id.index()];
    writer.add_landmark(finished(map, map[id], covariance, selection, header.descriptor));
  }
  writer.finish();
  MapWriter::discard_append_files(output.work());
  output.commit();
}

}  // namespace cairn
