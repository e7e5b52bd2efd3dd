// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cairn/core/id.h"
#include "cairn/map/map_header.h"
#include "cairn/map/observed_frame.h"

namespace cairn {

/// Feature `feature` of a keyframe shows a landmark.
struct ObservationRef {
  KeyframeId keyframe;
  std::int32_t feature = -1;
  auto operator<=>(const ObservationRef&) const = default;  // NOLINT(modernize-use-nullptr): as Id
};

struct Landmark {
  LandmarkId id;
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();
  std::vector<ObservationRef> observations;  ///< by keyframe, increasing, one for each; none: erased

  [[nodiscard]] bool erased() const { return observations.empty(); }
};

struct Keyframe {
  KeyframeId id;
  ObservedFrame observed;             ///< empty where erased
  std::vector<LandmarkId> landmarks;  ///< one per feature; not valid where it shows none
  Rigid3 world_from_camera;           ///< where not erased: ask Map::world_from_camera
  KeyframeId parent;                  ///< an earlier keyframe that it was placed by; not valid for a first
  KeyframeId anchor;                  ///< of an erased one: the ancestor that was left when it was erased,
  Rigid3 anchor_from_camera;          ///< and where it was then
  std::int32_t component =
      0;                ///< keyframes of different components have no common world; ask Map::component_of
  bool erased = false;  ///< redundant: only its place is kept, relative to its anchor
};

/// Keyframes and the landmarks they show, each knowing the other. Ids are positions and stay valid: what is
/// erased leaves a gap. The world of component 0 is the first keyframe's camera frame.
class Map {
 public:
  Map() = default;
  explicit Map(MapHeader header) : header_(std::move(header)) {}
  /// Of images of unknown size.
  Map(const Rig& rig, std::string descriptor) {
    header_.rig = rig;
    header_.descriptor.name = std::move(descriptor);
  }

  /// Norm and size of the descriptors are what the keyframes have, whatever it says of them.
  [[nodiscard]] const MapHeader& header() const { return header_; }
  [[nodiscard]] const Rig& rig() const { return header_.rig; }
  /// Name of the descriptors' kind, as in FeatureOptions.
  [[nodiscard]] const std::string& descriptor() const { return header_.descriptor.name; }
  /// By id, erased ones included.
  [[nodiscard]] const std::vector<Keyframe>& keyframes() const { return keyframes_; }
  [[nodiscard]] const std::vector<Landmark>& landmarks() const { return landmarks_; }
  [[nodiscard]] const Keyframe& operator[](KeyframeId id) const { return keyframes_[index(id)]; }
  [[nodiscard]] const Landmark& operator[](LandmarkId id) const { return landmarks_[index(id)]; }
  /// Those that are not erased, increasing.
  [[nodiscard]] std::vector<KeyframeId> keyframe_ids() const;
  [[nodiscard]] std::vector<LandmarkId> landmark_ids() const;
  /// Of any keyframe, also an erased one.
  [[nodiscard]] Rigid3 world_from_camera(KeyframeId id) const;
  /// The component that a keyframe belongs to, also an erased one.
  [[nodiscard]] std::int32_t component_of(KeyframeId id) const;

  KeyframeId add_keyframe(ObservedFrame&& observed, const Rigid3& world_from_camera, KeyframeId parent,
                          std::int32_t component);
  /// A landmark that `first` shows; the feature shows no other.
  LandmarkId add_landmark(const Eigen::Vector3d& point_in_world, ObservationRef first);
  /// The feature shows no other landmark, the keyframe no other feature of this one.
  void add_observation(LandmarkId landmark, ObservationRef observation);
  /// Does nothing where there is no such observation. A landmark without observations is erased.
  void remove_observation(LandmarkId landmark, KeyframeId keyframe);
  /// `gone` becomes `kept`: its observations go over, except in keyframes that show both, where they end.
  void merge(LandmarkId gone, LandmarkId kept);
  void erase(LandmarkId landmark);
  /// Its observations end; its place stays known relative to its anchor.
  void erase(KeyframeId keyframe);
  void move(KeyframeId keyframe, const Rigid3& world_from_camera);
  void move(LandmarkId landmark, const Eigen::Vector3d& point_in_world);
  void set_component(KeyframeId keyframe, std::int32_t component);
  /// The recording that the keyframes are of ends here: their FrameIds are valid no more, as the next one
  /// counts its frames from 0 again.
  void end_recording();

 private:
  template <class AnyId>
  [[nodiscard]] static std::size_t index(AnyId id) {
    return id.index();
  }
  [[nodiscard]] Keyframe& keyframe(KeyframeId id) { return keyframes_[index(id)]; }
  [[nodiscard]] Landmark& landmark(LandmarkId id) { return landmarks_[index(id)]; }

  MapHeader header_;
  std::vector<Keyframe> keyframes_;
  std::vector<Landmark> landmarks_;
};

}  // namespace cairn
