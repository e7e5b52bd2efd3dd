// SPDX-License-Identifier: Apache-2.0
// What the tests of whole runs share: a simulated street to be mapped.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cairn/core/progress.h"
#include "cairn/sequence/given_poses.h"
#include "cairn/simulate/simulate_street.h"
#include "cairn/survey/survey.h"
#include "cairn/testing/core/temporary_folder.h"

namespace cairn::testkit {

inline constexpr int kStreetFrames = 26;

/// Returns a street that is rendered in seconds.
[[nodiscard]] SimulateStreetOptions small_street(int frames);

/// Writes a simulated street with exact poses, in KITTI's format, into `folder`, which exists.
void write_small_street(const std::filesystem::path& folder, int frames);

/// Returns options with so small a window that frames and landmarks are written on the way.
[[nodiscard]] SurveyOptions small_window();

/// Stops after some updates, and remembers what it was told.
class Watcher : public Progress {
 public:
  explicit Watcher(int updates_before_stop = kStreetFrames + 1) : updates_left_(updates_before_stop) {}
  void update(std::int64_t done) override {
    --updates_left_;
    last_update = done;
  }
  void warn(const std::string& message) override { warnings.push_back(message); }
  [[nodiscard]] bool stop_requested() const override { return updates_left_ <= 0; }

  std::vector<std::string> warnings;
  std::int64_t last_update = 0;

 private:
  int updates_left_;
};

/// Makes a simulated street with exact poses once for all tests; each test works on a copy of the lists, and
/// maps into a folder of its own.
class StreetSurvey : public ::testing::Test {
 protected:
  static void SetUpTestSuite();
  static void TearDownTestSuite() { street_.reset(); }

  StreetSurvey();

  /// Maps the street into folder `name`.
  [[nodiscard]] SurveyResult survey(const std::string& name, int threads = 2,
                                    Progress* progress = nullptr) const;
  [[nodiscard]] std::filesystem::path folder(const std::string& name) const { return scratch_ / name; }
  /// Takes the pose from a frame.
  void forget_pose(std::size_t frame);
  /// Shows `frame` once more at its place, a moment later.
  void stand_at(std::size_t frame);
  /// Writes a file that is no image, and returns its path.
  [[nodiscard]] std::filesystem::path damaged_image() const;

  static inline std::unique_ptr<const TemporaryFolder> street_;
  const TemporaryFolder scratch_;
  Sequence sequence_;
  GivenPoses poses_;
  SurveyOptions options_ = small_window();
};

}  // namespace cairn::testkit
