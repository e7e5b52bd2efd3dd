// SPDX-License-Identifier: Apache-2.0
#include "cairn/survey/pose_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>

#include "cairn/core/error.h"
#include "cairn/core/executor.h"
#include "cairn/core/progress.h"
#include "cairn/core/random.h"
#include "cairn/sequence/given_poses.h"
#include "cairn/sequence/sequence.h"
#include "cairn/testing/core/temporary_folder.h"
#include "cairn/testing/geometry/random_points.h"
#include "cairn/testing/survey/street_survey.h"

namespace cairn {
namespace {

constexpr int kFrames = 24;

/// A simulated street with exact poses, made once for all tests; each test spoils a copy of the poses.
class CheckPoses : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    street_ = std::make_unique<const testkit::TemporaryFolder>();
    testkit::write_small_street(street_->path(), kFrames);
  }
  static void TearDownTestSuite() { street_.reset(); }

  CheckPoses() : sequence_(open_sequence(street_->path())), poses_(read_given_poses(sequence_)) {
    poses_.format = "TUM";
    poses_.source = "poses.txt";
    sequence_.format = "TUM";
  }

  void change(const std::function<Rigid3(const Rigid3&)>& by) {
    for (auto& pose : poses_.frames) pose->world_from_camera = WorldFromCamera(by(pose->world_from_camera));
  }
  void add_noise(double metres, double degrees) {
    Random random(11);
    change([&](const Rigid3& pose) {
      return Rigid3{
          pose.rotation * rotation_exp(testkit::normal_vector(random, degrees * std::numbers::pi / 180)),
          pose.translation + testkit::normal_vector(random, metres)};
    });
  }
  [[nodiscard]] PoseCheck check(int threads = 2) const {
    return check_poses(sequence_, poses_, {}, Executor(threads));
  }
  void expect_misread(const std::string& as) const {
    const PoseCheck found = check();
    EXPECT_EQ(to_string(found.verdict), "misread") << describe(found);
    EXPECT_EQ(found.reading, as) << describe(found);
    EXPECT_LT(found.reading_error_px, 1.5);
    EXPECT_GT(found.error_px, 4 * found.reading_error_px);
  }

  static inline std::unique_ptr<const testkit::TemporaryFolder> street_;
  Sequence sequence_;
  GivenPoses poses_;
};

TEST_F(CheckPoses, right_ones_agree) {
  const PoseCheck found = check();
  EXPECT_EQ(found.verdict, PoseVerdict::agreement);
  EXPECT_EQ(found.pairs, 12);
  EXPECT_LT(found.error_px, 1);
  EXPECT_GT(found.flow_px, 5);
  EXPECT_NEAR(found.image_motion_m, found.pose_motion_m, 0.1);
  EXPECT_NEAR(found.image_rotation_deg, found.pose_rotation_deg, 0.2);
  EXPECT_NO_THROW(refuse_misread(found, sequence_, poses_));
}

TEST_F(CheckPoses, names_of_a_quaternion_may_be_wrong_either_way) {
  poses_.format = "table";
  change([](const Rigid3& pose) {  // qx qy qz qw stood below qw qx qy qz
    const Eigen::Quaterniond& q = pose.rotation;
    return Rigid3{Eigen::Quaterniond(q.x(), q.y(), q.z(), q.w()), pose.translation};
  });
  expect_misread("quaternions with qw last, qx qy qz qw");
}

TEST_F(CheckPoses, poses_of_the_camera_may_be_taken_for_a_body) {
  poses_.format = "table";
  poses_.subject_from_camera = {Eigen::Quaterniond(0.5, 0.5, 0.5, 0.5), {1.2, 0.3, -0.9}};
  change([this](const Rigid3& pose) { return pose * poses_.subject_from_camera; });
  expect_misread("poses of the camera itself");
}

TEST_F(CheckPoses, the_order_of_quaternions_is_named) {
  change([](const Rigid3& pose) {  // qw qx qy qz were read as qx qy qz qw
    const Eigen::Quaterniond& q = pose.rotation;
    return Rigid3{Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y()), pose.translation};
  });
  expect_misread("quaternions with qw first, qw qx qy qz");
  try {
    refuse_misread(check(), sequence_, poses_);
    FAIL();
  } catch (const InputError& error) {
    const std::string said = error.what();
    for (const char* part :
         {"poses.txt", "degrees", "px", "qw first", "Write them in the order qx qy qz qw."})
      EXPECT_NE(said.find(part), std::string::npos) << said;
  }
}

TEST_F(CheckPoses, inverse_ones_are_named) {
  change([](const Rigid3& pose) { return pose.inverse(); });
  expect_misread("inverse poses, camera_from_world");
}

TEST_F(CheckPoses, axes_of_a_body_are_named) {
  const GivenPoses right = poses_;
  const auto turn_axes = [&](const Eigen::Quaterniond& axes_from_camera) {
    poses_ = right;
    change([&](const Rigid3& pose) {
      return Rigid3{pose.rotation * axes_from_camera.conjugate(), pose.translation};
    });
  };
  turn_axes({0.5, -0.5, 0.5, -0.5});
  expect_misread("poses of axes with x forward, y left, z up");
  turn_axes({0.5, 0.5, 0.5, 0.5});
  expect_misread("poses of axes with x forward, y right, z down");
  turn_axes({0, 1, 0, 0});
  expect_misread("poses of axes with x right, y up, z backward");
}

TEST_F(CheckPoses, a_heading_of_the_other_sign_is_named) {
  poses_.format = "table";
  const Rigid3 body_from_camera{{0.5, 0.5, 0.5, 0.5}, {1, 0.2, -0.8}};
  poses_.subject_from_camera = body_from_camera;
  const Rigid3 to_north_east{rotation_exp(Eigen::Vector3d(0, 0, 0.7)), {}};
  change([&](const Rigid3& pose) { return to_north_east * pose; });
  change([&](const Rigid3& pose) {
    // against north, east, down the heading turns about down: its sign mirrors east for a level body
    const Rigid3 body = pose * body_from_camera.inverse();
    constexpr double kHalf = std::numbers::sqrt2 / 2;
    const Eigen::Quaterniond enu_from_ned(0, kHalf, kHalf, 0);
    const Eigen::Matrix3d r = (enu_from_ned.conjugate() * body.rotation).toRotationMatrix();
    const double heading = std::atan2(r(1, 0), r(0, 0));
    const Eigen::Quaterniond back(Eigen::AngleAxisd(-2 * heading, Eigen::Vector3d::UnitZ()));
    const Eigen::Quaterniond ned_from_body(r);
    return Rigid3{enu_from_ned * back * ned_from_body, body.translation} * body_from_camera;
  });
  expect_misread("heading of the other sign");
}

TEST_F(CheckPoses, two_misreadings_at_once_are_named) {
  change([](const Rigid3& pose) {
    const Eigen::Quaterniond q = pose.rotation * Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5).conjugate();
    return Rigid3{Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y()), pose.translation};
  });
  expect_misread("quaternions with qw first, qw qx qy qz, and poses of axes with x forward, y left, z up");
}

TEST_F(CheckPoses, noisy_ones_are_never_called_misread) {
  const GivenPoses right = poses_;
  for (const double metres : {0.1, 1.0, 3.0}) {
    for (const double degrees : {0.0, 0.5, 5.0}) {
      poses_ = right;
      add_noise(metres, degrees);
      EXPECT_NE(check().verdict, PoseVerdict::misread) << metres << " m, " << degrees << " degrees";
    }
  }
}

TEST_F(CheckPoses, drifting_and_scaled_ones_agree) {
  change([](const Rigid3& pose) { return Rigid3{pose.rotation, 1.15 * pose.translation}; });
  EXPECT_EQ(check().verdict, PoseVerdict::agreement);
  int frame = 0;
  change([&](const Rigid3& pose) {
    return Rigid3{rotation_exp(Eigen::Vector3d(0, 0, 0.003 * frame)), {0.05 * frame++, 0, 0}} * pose;
  });
  EXPECT_EQ(check().verdict, PoseVerdict::agreement);
}

TEST_F(CheckPoses, few_frames_are_undecided) {
  for (std::size_t i = 3; i < poses_.frames.size(); ++i) poses_.frames[i].reset();
  const PoseCheck found = check();
  EXPECT_EQ(found.verdict, PoseVerdict::undecided);
  EXPECT_LT(found.pairs, 3);
}

TEST_F(CheckPoses, is_the_same_at_any_number_of_threads) {
  const PoseCheck one = check(1), three = check(3);
  EXPECT_EQ(one.error_px, three.error_px);
  EXPECT_EQ(one.image_rotation_deg, three.image_rotation_deg);
}

}  // namespace
}  // namespace cairn
