// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cairn/core/id.h"
#include "cairn/core/parameter.h"
#include "cairn/image/image.h"
#include "cairn/sequence/calibration.h"
#include "cairn/sequence/frame_range.h"
#include "cairn/sequence/trajectory.h"

namespace cairn {

/// Locates the images of one frame. Paths that the format does not have are empty.
struct FrameFiles {
  std::int64_t stamp_ns = 0;
  std::int64_t number = 0;  ///< in the file names; the position if there is none
  std::filesystem::path color;
  std::filesystem::path depth;
  std::filesystem::path right;
  std::int64_t position = 0;  ///< in the recording, before frames were chosen
};

/// Describes how the frames were found, for `cairn info` and warnings.
struct SequenceReport {
  /// How images found their partners: "time, nearest stamp", a file; empty: by name.
  std::string associated_by;
  std::int64_t color_images = 0;  ///< colour or left
  std::int64_t depth_images = 0;
  std::int64_t right_images = 0;
  std::int64_t associated = 0;  ///< colour images that got a depth image, or left ones that got a right one
  double max_stamp_gap_s = 0;   ///< largest difference of the stamps of a pair
  std::vector<std::string> warnings;  ///< warnings about its poses, a sentence each
};

/// Describes a recording on disk: images, times and cameras. FrameLoader decodes the images.
struct Sequence {
  std::filesystem::path folder;
  std::string format;  ///< "TUM", "7-Scenes", "numbered", "stamped", "KITTI", "EuRoC"
  Calibration calibration;
  std::string calibration_source;  ///< source of the calibration, for people
  std::vector<FrameFiles> frames;  ///< stamps strictly increasing
  /// True if the stamps are times: from lists, or file numbers over a rate that the calibration states or the
  /// format implies (7-Scenes is a video at 30 Hz). False if they only keep the frames apart; then nothing is
  /// known about the time between two of them.
  bool has_times = true;
  std::optional<std::int64_t> first_stamp_ns;  ///< of the recording, before frames were chosen
  std::int64_t listed = 0;                     ///< frames of the recording, before they were chosen
  /// world_from_camera of the colour (rectified left) camera, if the format has it.
  std::optional<Trajectory> truth;
  SequenceReport report;
};

/// Tells whether a sequence is of calibrated pairs: it has a baseline and right images.
[[nodiscard]] inline bool is_stereo(const Sequence& sequence) {
  return sequence.calibration.baseline && !sequence.frames.empty() && !sequence.frames.front().right.empty();
}

/// Holds parts of a calibration that parameter files give (camera.fx, camera.scale ...).
struct CameraParameters {
  std::optional<double> fx, fy, cx, cy;  ///< pixels
  std::optional<double> scale;           ///< depth, units per metre
};

/// Sets how a sequence is read and which of its frames are used.
struct SequenceOptions {
  /// Path of a camera.yaml, or tum-fr1|tum-fr2|tum-fr3, or the numbers fx,fy,cx,cy[,scale] of a pinhole
  /// camera of the images' size; empty: the sequence's own.
  std::string camera;
  CameraParameters camera_parameters;  ///< take precedence over the calibration
  std::string rgb_dir, rgb_extension;  ///< of numbered files; empty: the usual ones
  std::string depth_dir, depth_extension;
  std::string left, right;   ///< patterns or folders of stereo images without lists; empty: the usual ones
  std::string color, depth;  ///< patterns or folders of RGB-D images without lists; empty: the usual ones
  std::optional<std::int64_t> start_index;  ///< file number of the first frame
  std::optional<std::int64_t> end_index;    ///< file number of the first frame that is left out
  double max_stamp_gap_s = 0.02;  ///< TUM, EuRoC: largest difference of an associated pair (as the TUM tools)
  std::optional<FrameRange> frames;  ///< frames to use; nullopt: all
  /// Numbers of the files to use, increasing; of TUM and EuRoC lists the numbers of the frames, the first
  /// is 1.
  std::optional<std::vector<std::int64_t>> frame_numbers;
  std::optional<FrameRange> without;  ///< frames to leave out; nullopt: none
};

/// Visits the parameters by which a sequence is read: camera.*, the folders and numbers of its files.
void visit(SequenceOptions& options, ParameterVisitor& visitor);

/// Recognises the format and lists the frames. Throws InputError for any defect.
[[nodiscard]] Sequence open_sequence(const std::filesystem::path& folder,
                                     const SequenceOptions& options = {});

/// Holds one decoded frame.
struct Frame {
  FrameId id;
  std::int64_t stamp_ns = 0;
  GrayImage gray;
  DepthImage depth;  ///< registered to the colour camera, metres; empty if the sequence has none
  GrayImage right;   ///< of a stereo pair; empty if the sequence has none
};

/// Decodes the frames of one sequence, which must outlive it; safe to call from several threads. Raw stereo
/// pairs are rectified: what is loaded fits Calibration::camera.
class FrameLoader {
 public:
  explicit FrameLoader(const Sequence& sequence);
  explicit FrameLoader(const Sequence&&) = delete;
  ~FrameLoader();
  /// Loads a frame. Throws InputError if an image cannot be decoded or its size is not the calibration's.
  [[nodiscard]] Frame load(FrameId id) const;
  /// Checks the images of a frame without decoding them: only the beginning and the end of each file. Throws
  /// InputError as `load` does.
  void probe(FrameId id) const;
  /// Loads the colour or left image. Throws InputError as `load` does.
  [[nodiscard]] RgbImage load_color(FrameId id) const;
  /// Loads the depth image, empty if the frame has none. Throws InputError as `load` does.
  [[nodiscard]] DepthImage load_depth(FrameId id) const;
  /// Loads the right image, empty if the frame has none. Throws InputError as `load` does.
  [[nodiscard]] GrayImage load_right(FrameId id) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cairn
