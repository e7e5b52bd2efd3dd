// SPDX-License-Identifier: Apache-2.0
#include "compared_trajectories.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/sequence/formats.h"
#include "cairn/sequence/trajectory_file.h"
#include "common.h"

namespace cairn::app {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kSecondNs = 1'000'000'000;

/// A file of poses with where it comes from.
struct NamedFile {
  std::string path;
  TrajectoryFile file;
};

/// The reference, with the frames of the sequence that carries it.
struct Reference {
  NamedFile named;
  bool is_sequence = false;
  bool has_clock = true;  ///< else whole numbers in a TUM file are numbers of frames
  std::vector<std::int64_t> numbers, stamps;
};

bool is_sequence(const fs::path& folder) {
  return is_tum(folder) || is_seven_scenes(folder) || is_kitti(folder) || is_euroc(folder) ||
         is_image_pairs(folder, {});
}

/// Warns if the poses are those of a run of cairn localize whose images have no times.
void warn_of_made_up_stamps(const fs::path& path) {
  const fs::path report = (fs::is_directory(path) ? path : path.parent_path()) / "run.json";
  if (!fs::is_regular_file(report)) return;
  const auto json = nlohmann::json::parse(cairn::read_file(report), nullptr, false);
  if (!json.is_object() || !json.contains("stamps") || !json["stamps"].is_string()) return;
  const auto stamps = json["stamps"].get<std::string>();
  if (stamps == "times") return;
  print_warnings(
      {fmt::format("{}: its stamps are {}. They pair with REF only if it counts alike; "
                   "localization.csv has the names of the files.",
                   path.string(), stamps)});
}

TrajectoryFile read_file(const fs::path& path, const TrajectoryFileOptions& options) {
  const bool holds_poses =
      !fs::is_directory(path) || fs::exists(path / "trajectory.txt") || is_pose_folder(path);
  if (holds_poses) {
    TrajectoryFile file = read_trajectory_file(path, options);
    print_warnings(file.warnings);
    warn_of_made_up_stamps(path);
    return file;
  }
  throw InputError({path.string(), 0, "a trajectory file, or a run's folder with trajectory.txt",
                    "a folder without one", "Name the file that holds the trajectory."});
}

TrajectoryFile truth_of(const Sequence& sequence) {
  TrajectoryFile file;
  if (sequence.truth && !sequence.truth->empty()) {
    file.poses = *sequence.truth;
    file.first_key = file.poses.front().stamp_ns;
    return file;
  }
  if (const auto oxts = oxts_in(sequence.folder)) return read_file(*oxts, {});
  throw InputError({sequence.folder.string(), 0, "a sequence with true poses",
                    fmt::format("none ({})", sequence.format), "Name a trajectory file as REF."});
}

Reference read_reference(const std::string& path, const std::string& camera) {
  Reference reference;
  reference.named.path = path;
  const bool is_folder = fs::is_directory(path) && !fs::exists(fs::path(path) / "run.json");
  if (!is_folder || (is_pose_folder(path) && !is_sequence(path))) {
    reference.named.file = read_file(path, {});
    return reference;
  }
  SequenceOptions options;
  options.camera = camera;
  const Sequence sequence = open_sequence(path, options);
  print_warnings(sequence.report.warnings);
  reference.named.file = truth_of(sequence);
  reference.is_sequence = true;
  reference.has_clock = has_clock(sequence);
  for (const FrameFiles& frame : sequence.frames) {
    reference.numbers.push_back(frame.number);
    reference.stamps.push_back(frame.stamp_ns);
  }
  return reference;
}

/// Numbers and positions as whole seconds.
void count_as_seconds(NamedFile& named) {
  constexpr std::int64_t kLargest = 9'000'000'000;
  for (StampedPose& pose : named.file.poses) {
    if (std::abs(pose.stamp_ns) > kLargest)
      throw InputError({named.path, 0, "numbers of frames up to 9000000000", fmt::format("{}", pose.stamp_ns),
                        "Name the column 'time' if it holds times."});
    pose.stamp_ns *= kSecondNs;
  }
}

void take_stamps_by_position(const Trajectory& from, TrajectoryFile& file) {
  for (std::size_t i = 0; i < from.size(); ++i) file.poses[i].stamp_ns = from[i].stamp_ns;
  file.first_key = from.front().stamp_ns;
  file.key = PoseKey::stamp;
}

/// A reference without times gets those of an estimate that has some, pose by pose. Returns whether there are
/// times then.
bool find_times(const std::vector<NamedFile>& estimates, TrajectoryFile& reference) {
  if (reference.key == PoseKey::stamp) return true;
  const auto with_times = std::find_if(estimates.begin(), estimates.end(), [&](const NamedFile& estimate) {
    return estimate.file.key == PoseKey::stamp && estimate.file.poses.size() == reference.poses.size();
  });
  if (reference.key == PoseKey::position && with_times != estimates.end()) {
    take_stamps_by_position(with_times->file.poses, reference);
    return true;
  }
  return false;
}

[[noreturn]] void fail_to_pair(const NamedFile& estimate, const Reference& reference) {
  const auto describe = [](const TrajectoryFile& file) {
    const char* const by = file.key == PoseKey::stamp    ? "with time stamps"
                           : file.key == PoseKey::number ? "by numbers of frames"
                                                         : "without time stamps";
    return fmt::format("{} poses {}", file.poses.size(), by);
  };
  throw InputError({estimate.path, 0,
                    fmt::format("poses that pair with those of {}: {}", reference.named.path,
                                describe(reference.named.file)),
                    describe(estimate.file),
                    "Give both with time stamps (TUM format), or one pose for each of the other's."});
}

/// Returns the stamps of the poses of an estimate that stamp_like_reference keeps, as its file has them.
std::vector<std::int64_t> file_stamps(const Reference& reference, const TrajectoryFile& file) {
  const std::set<std::int64_t> numbers(reference.numbers.begin(), reference.numbers.end());
  const bool is_stamp = file.key == PoseKey::stamp;
  const bool loses_poses = reference.is_sequence && file.key == PoseKey::number;
  std::vector<std::int64_t> stamps;
  for (const StampedPose& pose : file.poses)
    if (!loses_poses || numbers.contains(pose.stamp_ns))
      stamps.push_back(is_stamp ? pose.stamp_ns : kSecondNs * pose.stamp_ns);
  return stamps;
}

/// Stamps an estimate on the reference's clock, where it has none of its own.
void stamp_like_reference(const Reference& reference, NamedFile& estimate) {
  TrajectoryFile& file = estimate.file;
  const TrajectoryFile& truth = reference.named.file;
  if (file.key == PoseKey::stamp && truth.key == PoseKey::stamp) return;
  if (file.key == PoseKey::number && truth.key == PoseKey::number) return count_as_seconds(estimate);
  const bool fits_frames = file.key == PoseKey::number || file.poses.size() == reference.stamps.size();
  if (reference.is_sequence && fits_frames)
    return stamp_by_frames(estimate.path, reference.numbers, reference.stamps, file);
  const bool by_position = file.key != PoseKey::number && truth.key != PoseKey::number;
  if (!by_position || file.poses.size() != truth.poses.size()) fail_to_pair(estimate, reference);
  if (truth.key == PoseKey::stamp) return take_stamps_by_position(truth.poses, file);
  for (std::size_t i = 0; i < file.poses.size(); ++i)
    file.poses[i].stamp_ns = static_cast<std::int64_t>(i) * kSecondNs;
}

/// From the first stamp of the estimate's file to that of the reference's; 0 if that is no number of
/// nanoseconds.
std::int64_t offset_of_starts(const TrajectoryFile& estimate, const TrajectoryFile& reference) {
  std::int64_t offset_ns = 0;
  return __builtin_sub_overflow(reference.first_key, estimate.first_key, &offset_ns) ? 0 : offset_ns;
}

void shift(const StampOffset& offset, std::int64_t start_offset_ns, NamedFile& estimate) {
  const std::int64_t offset_ns = offset.is_start() ? start_offset_ns : std::llround(1e9 * offset.seconds());
  for (StampedPose& pose : estimate.file.poses) {
    if (!__builtin_add_overflow(pose.stamp_ns, offset_ns, &pose.stamp_ns)) continue;
    throw InputError({"--offset", 0, "an offset that leaves the stamps within 292 years of 1970", offset.text,
                      "Correct the value."});
  }
  if (offset.is_start())
    print_warnings({fmt::format("{}: the first stamps are aligned by an offset of {} s.", estimate.path,
                                format_seconds(offset_ns))});
}

}  // namespace

ComparedTrajectories read_compared(const ComparedPaths& paths) {
  Reference reference = read_reference(paths.reference, paths.camera);
  std::vector<NamedFile> estimates;
  for (const std::string& path : paths.estimates) {
    const TrajectoryFileOptions options{.may_have_numbers = !reference.has_clock,
                                        .origin = reference.named.file.origin};
    estimates.push_back({path, read_file(path, options)});
  }
  ComparedTrajectories compared;
  compared.has_times = find_times(estimates, reference.named.file);
  for (NamedFile& estimate : estimates) {
    const bool has_stamps = estimate.file.key == PoseKey::stamp;
    compared.file_stamps_ns.push_back(file_stamps(reference, estimate.file));
    stamp_like_reference(reference, estimate);
    compared.start_offsets_ns.push_back(offset_of_starts(estimate.file, reference.named.file));
    if (has_stamps && compared.has_times) shift(paths.offset, compared.start_offsets_ns.back(), estimate);
    compared.estimates.push_back(std::move(estimate.file.poses));
  }
  if (!compared.has_times) count_as_seconds(reference.named);
  compared.reference = std::move(reference.named.file.poses);
  return compared;
}

}  // namespace cairn::app
