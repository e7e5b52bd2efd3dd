// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "cairn/core/append_file.h"
#include "cairn/geometry/framed.h"
#include "cairn/map/held_out_frame.h"
#include "cairn/map/indicators.h"
#include "cairn/map/map.h"
#include "cairn/map_files/map_info.h"

namespace cairn {

/// Holds a landmark that will not change any more.
struct FinishedLandmark {
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();  ///< metres
  /// Covariance of the point, square metres; 0: not known.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  std::vector<ObservationRef> observations;  ///< at least one; by ascending keyframe, one for each
  std::vector<Keypoint> keypoints;           ///< of each observation; only size and sigma are stored
  Descriptors descriptors;                   ///< of each observation
  LandmarkIndicators indicators;             ///< indicators for its row in uvlist.txt
  /// The part of it that is the landmark's own, by the noise of the images; the rest it has in common with
  /// its neighbours. nullopt: all is its own. The map keeps these parts if all
  /// landmarks have one.
  std::optional<Eigen::Matrix3d> noise_covariance = std::nullopt;
};

/// Holds how far a MapWriter has come.
struct MapWriterState {
  static constexpr std::size_t kAppendFiles = 6;
  std::array<AppendFileState, kAppendFiles> append_files;
  std::int32_t frames = 0;
  std::uint32_t landmarks = 0;
  std::uint64_t features = 0, observations = 0;
  std::uint32_t with_noise = 0;  ///< landmarks with a covariance of their own

  /// Appends the state to `writer`.
  void put(ByteWriter& writer) const;
  /// Reads a state that was put.
  [[nodiscard]] static MapWriterState get(BinaryReader& reader);
};

/// Writes the folder of a map, whose layout is docs/map_format.md, piece by piece. Memory does not grow with
/// the map, but for a thousandth of the files' size when they are put together at the end.
///
/// Frames are added in order, and so are landmarks; a landmark may come before the frames that show it or
/// after them. After a crash the writer resumes from its last saved state, and the same calls then end with
/// the same bytes as without the crash.
///
/// Throws InputError if the disk fails, and PreconditionError for what no map can have.
class MapWriter {
 public:
  /// Begins a map in `folder`, which exists. `header.descriptor` names one of descriptor_names(), and has the
  /// descriptors' norm and bytes.
  MapWriter(const std::filesystem::path& folder, const MapHeader& header);
  /// Resumes in the folder in which `state` was saved; what was added later is lost.
  MapWriter(const std::filesystem::path& folder, const MapHeader& header, const MapWriterState& state);
  ~MapWriter();

  /// Adds the next frame. Its feature i shows landmark landmarks[i], a final number, or none if that is not
  /// valid. Observations are finite, their standard deviations and disparities above 0.
  void add_frame(const ObservedFrame& observed, std::span<const LandmarkId> landmarks,
                 const WorldFromCamera& world_from_camera, std::int32_t component = 0);
  /// Adds the next landmark.
  void add_landmark(const FinishedLandmark& landmark);
  [[nodiscard]] std::int32_t frames() const { return frames_; }
  [[nodiscard]] std::uint32_t landmarks() const { return landmarks_; }

  /// Writes all that was added to the disk, and returns the state for resuming there.
  [[nodiscard]] MapWriterState save();

  /// Puts the files of the map together; `held_out` are frames of it, and the map has no such file if there
  /// are none. To be called last, with at least one frame. Its working files stay in the folder, so that a
  /// crash during the call can be resumed as well; discard_append_files removes them.
  void finish(std::span<const HeldOutFrame> held_out = {});
  /// Removes the working files from the folder of a map that is finished.
  static void discard_append_files(const std::filesystem::path& folder);

 private:
  enum class Part { points, observations, table, poses, keyframes, noise };
  [[nodiscard]] AppendFile& append_file(Part part) { return *append_files_[static_cast<std::size_t>(part)]; }
  void open_append_files(const MapWriterState* state);
  void remove_frames_from(std::int32_t first) const;
  void write_binary(const char* name, const BinaryWriter& begin, Part part, MapInfo& info);
  void write_text(const char* name, std::string_view begin, Part part, MapInfo& info);
  void write_info(const MapInfo& info);

  std::filesystem::path folder_;
  MapHeader header_;
  std::array<std::unique_ptr<AppendFile>, MapWriterState::kAppendFiles> append_files_;
  std::vector<std::filesystem::path> unsaved_;  // frame files since the last save
  std::int32_t frames_ = 0;
  std::uint32_t landmarks_ = 0;
  std::uint64_t features_ = 0, observations_ = 0;
  std::uint32_t with_noise_ = 0;  // landmarks
};

}  // namespace cairn
