// SPDX-License-Identifier: Apache-2.0
#include "cairn/testing/calibrate/body_drive.h"

#include <cmath>
#include <utility>
#include <vector>

#include "cairn/core/random.h"

namespace cairn::testkit {
namespace {

/// Returns where the body truly is `t` seconds after the start: about 6 m/s, with two bends to the left and
/// two to the right.
Rigid3 body_at(const BodyDrive& drive, double t) {
  if (!drive.turns) return {Eigen::Quaterniond::Identity(), {6 * t, 0, 0}};
  const double heading = 1.2 * std::sin(0.6 * t), roll = drive.tilts ? 0.06 * std::sin(1.3 * t) : 0,
               pitch = drive.tilts ? 0.05 * std::sin(0.9 * t + 1) : 0;
  const Eigen::Quaterniond rotation(Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()) *
                                    Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
                                    Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()));
  return {rotation,
          {6 * t + 2 * std::sin(0.5 * t), 8 * std::sin(0.4 * t), drive.tilts ? 0.2 * std::sin(t) : 0}};
}

}  // namespace

Rigid3 BodyDrive::stated() {
  return {Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5), {1.4, 0.3, 0.7}};
}

GivenPath BodyDrive::given() const {
  std::vector<SubjectPose> poses;
  for (int i = -100; i <= static_cast<int>(100 * duration_s) + 100; ++i) {
    const double stamp = 0.01 * i;
    Rigid3 pose = body_at(*this, stamp + planted[time_term]);
    Random random(seed, static_cast<std::uint64_t>(10000 + i));  // other streams than those of the images
    for (double& coordinate : pose.translation) coordinate += given_noise * random.normal();
    poses.push_back({std::llround(1e9 * stamp), pose});
  }
  GivenPath path;
  path.path = PosePath(std::move(poses), 0.15);
  path.subject_from_camera = stated();
  path.is_of_body = true;
  return path;
}

Trajectory BodyDrive::visual() const {
  const Rigid3 body_from_camera{rotation_exp(planted.segment<3>(boresight_term)) * stated().rotation,
                                stated().translation + planted.segment<3>(lever_arm_term)};
  const Rigid3 world{rotation_exp({0.3, -2, 1}), {5, 6, 7}};
  Trajectory trajectory;
  for (int i = 0; i <= static_cast<int>(10 * duration_s); ++i) {
    Random random(seed, static_cast<std::uint64_t>(i));
    const auto noise = [&](double sigma) {
      return Eigen::Vector3d(sigma * random.normal(), sigma * random.normal(), sigma * random.normal());
    };
    Rigid3 pose = world * body_at(*this, 0.1 * i) * body_from_camera;
    pose.translation = pose.translation / (1 + planted[scale_term]) + noise(place_noise);
    pose.rotation = (pose.rotation * rotation_exp(noise(angle_noise))).normalized();
    trajectory.push_back({100'000'000LL * i, WorldFromCamera(pose)});
  }
  return trajectory;
}

}  // namespace cairn::testkit
