// SPDX-License-Identifier: Apache-2.0
#include "cairn/evaluate/pose_pairs.h"

#include <fmt/format.h>

#include <cmath>

#include "cairn/core/error.h"
#include "cairn/core/text.h"
#include "cairn/sequence/association.h"

namespace cairn {
namespace {

std::vector<std::int64_t> stamps_of(const Trajectory& trajectory) {
  std::vector<std::int64_t> stamps;
  stamps.reserve(trajectory.size());
  for (const auto& pose : trajectory) stamps.push_back(pose.stamp_ns);
  return stamps;
}

struct Centres {
  std::vector<Eigen::Vector3d> estimated, reference;
};

Centres centres_of(std::span<const PosePair> pairs) {
  Centres centres;
  for (const auto& pair : pairs) {
    centres.estimated.push_back(pair.estimate.translation);
    centres.reference.push_back(pair.reference.translation);
  }
  return centres;
}

}  // namespace

std::vector<PosePair> pair_poses(const Trajectory& estimate, const Trajectory& reference, double max_gap_s) {
  constexpr double kMaxGap = 1e6;
  require(max_gap_s >= 0 && max_gap_s <= kMaxGap, "max_gap_s is between 0 and 1e6 seconds");
  std::vector<PosePair> pairs;
  for (const auto& [i, j] :
       associate_stamps(stamps_of(estimate), stamps_of(reference), std::llround(1e9 * max_gap_s))) {
    pairs.push_back({estimate[i].stamp_ns, estimate[i].world_from_camera, reference[j].world_from_camera});
  }
  return pairs;
}

std::vector<PosePair> read_pose_pairs(const std::filesystem::path& path) {
  constexpr std::string_view kLayout = "estimate, then reference, each t tx ty tz qx qy qz qw";
  constexpr std::size_t kFields = 16;
  const TextFile file(path);
  std::vector<PosePair> pairs;
  for (const TextLine& line : file.lines()) {
    if (line.fields.size() != kFields) {
      file.fail(line, fmt::format("{} values ({})", kFields, kLayout), fmt::format("{}", line.fields.size()),
                "Correct the line, or give two trajectories of 8 values a line.");
    }
    const StampedPose estimate = parse_tum_pose(file, line, 0), reference = parse_tum_pose(file, line, 8);
    pairs.push_back({estimate.stamp_ns, estimate.world_from_camera, reference.world_from_camera});
  }
  if (!pairs.empty()) return pairs;
  throw InputError({path.string(), 0, "pairs of poses, one pair a line: estimate, then reference", "none",
                    "Check that this is the right file."});
}

Alignment align_pairs(std::span<const PosePair> pairs, bool with_scale) {
  const Centres centres = centres_of(pairs);
  return align_points(centres.estimated, centres.reference, with_scale);
}

std::vector<PosePair> aligned_pairs(const Similarity3& reference_from_estimate,
                                    std::span<const PosePair> pairs) {
  std::vector<PosePair> aligned(pairs.begin(), pairs.end());
  for (auto& pair : aligned) pair.estimate = reference_from_estimate * pair.estimate;
  return aligned;
}

double rms_distance(std::span<const PosePair> pairs) {
  const Centres centres = centres_of(pairs);
  return rms_distance(Similarity3{}, centres.estimated, centres.reference);
}

}  // namespace cairn
