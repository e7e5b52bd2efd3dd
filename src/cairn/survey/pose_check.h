// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "cairn/core/executor.h"
#include "cairn/observe/observer.h"
#include "cairn/sequence/given_poses.h"

namespace cairn {

/// Says whether the given poses agree with the images.
enum class PoseVerdict {
  undecided,      ///< too few pairs of frames whose motion the images show
  agreement,      ///< the poses move the camera about as the images do
  contradiction,  ///< they do not, and no known misreading explains it
  misread,        ///< they do not, and with another reading they do
};

/// Holds how well the given poses agree with the motion that the images show. All figures are medians over
/// pairs of frames.
struct PoseCheck {
  PoseVerdict verdict = PoseVerdict::undecided;
  int pairs = 0;                                         ///< pairs of frames that were compared
  double image_rotation_deg = 0, pose_rotation_deg = 0;  ///< between the two frames
  double image_motion_m = 0, pose_motion_m = 0;
  double flow_px = 0;  ///< how far a point moves in the image from one frame to the other, pixels
  /// Distance in the image from where the poses put a point of the other frame to where it is seen, pixels;
  /// infinite if they put most points behind the camera.
  double error_px = 0;
  std::string reading, remedy;  ///< if misread: what the poses are, and what to change
  double reading_error_px = 0;  ///< if misread: error_px with that reading
};

/// Compares the motions that the given poses and the images show between frames near each other, in at most a
/// dozen pairs spread over the sequence. Those of the images are found without poses: ORB features with
/// depth, matched by descriptor, P3P in RANSAC. The poses are called misread only if with another reading
/// points lie within a quarter of their motion in the image from where they are seen, and four times nearer
/// than as given: noisy or drifting poses agree with no reading, or with the given one. Undecided for a
/// sequence of one camera, and with fewer than three pairs. The same result at any number of threads.
[[nodiscard]] PoseCheck check_poses(const Sequence& sequence, const GivenPoses& poses,
                                    const ObserverOptions& options, const Executor& executor);

/// Says in one sentence how far images and poses differ, with the figures.
[[nodiscard]] std::string describe(const PoseCheck& check);

/// Throws InputError that names the figures and the reading if the poses are misread.
void refuse_misread(const PoseCheck& check, const Sequence& sequence, const GivenPoses& poses);

/// Returns "undecided", "agreement", "contradiction" or "misread".
[[nodiscard]] std::string_view to_string(PoseVerdict verdict);

}  // namespace cairn
