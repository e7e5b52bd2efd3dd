// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cairn/core/id.h"
#include "cairn/map/map_header.h"
#include "cairn/map/observed_frame.h"

namespace cairn {

/// Refers to the observation of a landmark: feature `feature` of a keyframe shows it.
struct ObservationRef {
  KeyframeId keyframe;
  std::int32_t feature = -1;
  auto operator<=>(const ObservationRef&) const = default;  // NOLINT(modernize-use-nullptr): as Id
};

/// Holds a point of the map and the observations that show it.
struct Landmark {
  LandmarkId id;
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();
  std::vector<ObservationRef> observations;  ///< by ascending keyframe, one for each; none: erased

  [[nodiscard]] bool erased() const { return observations.empty(); }
};

/// Holds a frame whose pose and features the map keeps.
struct Keyframe {
  KeyframeId id;
  ObservedFrame observed;             ///< without features if the keyframe is erased
  std::vector<LandmarkId> landmarks;  ///< one per feature; not valid if it shows none
  Rigid3 world_from_camera;           ///< unless erased, see Map::world_from_camera
  KeyframeId parent;  ///< earlier keyframe that it was placed by; not valid for the first of a component
  KeyframeId anchor;  ///< if erased: nearest ancestor that was left when it was erased
  Rigid3 anchor_from_camera;  ///< if erased: pose relative to the anchor when it was erased
  /// Keyframes of different components have no common world; see also Map::component_of.
  std::int32_t component = 0;
  bool erased = false;  ///< whether it was redundant; then only its pose relative to its anchor is kept
};

/// Holds keyframes and the landmarks that they show, each knowing the other. Ids are positions and stay
/// valid: what is erased leaves a gap. The world of component 0 is the first keyframe's camera frame.
class Map {
 public:
  Map() = default;
  explicit Map(MapHeader header) : header_(std::move(header)) {}
  /// Makes an empty map of images of unknown size.
  Map(const Rig& rig, std::string descriptor) {
    header_.rig = rig;
    header_.descriptor.name = std::move(descriptor);
  }

  /// Returns the header. Norm and size of the descriptors are those of the keyframes, whatever the header
  /// says.
  [[nodiscard]] const MapHeader& header() const { return header_; }
  [[nodiscard]] const Rig& rig() const { return header_.rig; }
  /// Returns the name of the descriptors' kind, as in FeatureOptions.
  [[nodiscard]] const std::string& descriptor() const { return header_.descriptor.name; }
  /// Returns all keyframes by id, erased ones included.
  [[nodiscard]] const std::vector<Keyframe>& keyframes() const { return keyframes_; }
  /// Returns all landmarks by id, erased ones included.
  [[nodiscard]] const std::vector<Landmark>& landmarks() const { return landmarks_; }
  [[nodiscard]] const Keyframe& operator[](KeyframeId id) const { return keyframes_[index(id)]; }
  [[nodiscard]] const Landmark& operator[](LandmarkId id) const { return landmarks_[index(id)]; }
  /// Returns the ids of the keyframes that are not erased, in ascending order.
  [[nodiscard]] std::vector<KeyframeId> keyframe_ids() const;
  /// Returns the ids of the landmarks that are not erased, in ascending order.
  [[nodiscard]] std::vector<LandmarkId> landmark_ids() const;
  /// Returns the pose of any keyframe, also of an erased one.
  [[nodiscard]] Rigid3 world_from_camera(KeyframeId id) const;
  /// Returns the component of any keyframe, also of an erased one.
  [[nodiscard]] std::int32_t component_of(KeyframeId id) const;

  /// Adds a keyframe that shows no landmarks yet. Throws PreconditionError unless `parent` is earlier, or not
  /// valid.
  KeyframeId add_keyframe(ObservedFrame&& observed, const Rigid3& world_from_camera, KeyframeId parent,
                          std::int32_t component);
  /// Adds a landmark with its first observation. Throws PreconditionError if the feature shows another
  /// landmark.
  LandmarkId add_landmark(const Eigen::Vector3d& point_in_world, ObservationRef first);
  /// Adds an observation. Throws PreconditionError if the feature shows another landmark, or the keyframe
  /// shows this one already.
  void add_observation(LandmarkId landmark, ObservationRef observation);
  /// Removes the observation of a landmark in a keyframe, if there is one. A landmark without observations is
  /// erased.
  void remove_observation(LandmarkId landmark, KeyframeId keyframe);
  /// Marks the disparity by which a keyframe shows a landmark as not measured. Removes the whole observation
  /// if no other one of the landmark has a disparity, because its depth is to be known without motion, too.
  void remove_disparity(LandmarkId landmark, KeyframeId keyframe);
  /// Makes one landmark of two: erases `gone` and moves its observations to `kept`, except in keyframes that
  /// show both, in which they are removed. Throws PreconditionError if the two are the same.
  void merge(LandmarkId gone, LandmarkId kept);
  /// Erases a landmark and removes its observations.
  void erase(LandmarkId landmark);
  /// Erases a keyframe: removes its observations and features; its pose relative to its anchor is kept.
  /// Throws PreconditionError if it is erased already, or has no parent.
  void erase(KeyframeId keyframe);
  void move(KeyframeId keyframe, const Rigid3& world_from_camera);
  void move(LandmarkId landmark, const Eigen::Vector3d& point_in_world);
  void set_component(KeyframeId keyframe, std::int32_t component);
  /// Takes a field off the disparities of all keyframes (cairn::correct_disparities), and adds it to the
  /// header's correction. Landmarks that one keyframe alone shows move to where it shows them then.
  void correct_disparities(const DisparityField& field, double min_sigmas);
  /// Sets the standard deviations of all disparities to those of `noise`, and the header's.
  void weigh_disparities(const DisparityNoise& noise);
  /// Ends the recording that the keyframes are of: their FrameIds become invalid, because the next recording
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
