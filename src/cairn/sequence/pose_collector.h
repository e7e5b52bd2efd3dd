// SPDX-License-Identifier: Apache-2.0
// Private to this room: the poses of one file in their order, and what is odd about them.
#pragma once

#include <vector>

#include "cairn/core/text.h"
#include "cairn/sequence/recorded_poses.h"

namespace cairn {

/// Collects the poses of a file. Each stamp is taken once: a second pose that equals the first is left out
/// silently, a different one with a warning.
class PoseCollector {
 public:
  /// Appends to `recorded`, whose key must be set and which must outlive the collector.
  explicit PoseCollector(RecordedPoses& recorded) : recorded_(recorded) {}

  /// Appends a pose. Throws InputError that names the line unless the pose's key is at or above the last
  /// one's.
  void add(const TextFile& file, const TextLine& line, const RecordedPose& pose);
  /// Counts a row that states no position, as receivers write before they have a fix.
  void leave_out(const TextFile& file, const TextLine& line, std::int64_t key);
  /// Appends the warnings: rows left out, other poses at the same stamp, and positions that no vehicle
  /// reaches in the time between two rows. InputError if every row was left out.
  void finish();

 private:
  /// Counts the lines with one oddity.
  struct Oddities {
    int count = 0;
    std::string first;   ///< "file:line" of the first
    std::string detail;  ///< of the first
  };
  void note(const TextFile& file, const TextLine& line, std::string detail, Oddities& oddities) const;
  void check_speed(const TextFile& file, const TextLine& line, const RecordedPose& pose);
  [[nodiscard]] std::string describe(std::int64_t key) const;

  RecordedPoses& recorded_;
  Oddities left_out_, repeated_, jumps_;
};

}  // namespace cairn
