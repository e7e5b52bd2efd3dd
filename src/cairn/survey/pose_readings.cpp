// SPDX-License-Identifier: Apache-2.0
#include "cairn/survey/pose_readings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace cairn {
namespace {

/// Describes what else a stated pose may mean; it is of the body, or of the camera if there is no body.
struct Change {
  std::string name, remedy;
  std::function<Rigid3(const Rigid3&)> apply;
};

/// Describes where else the camera may sit on the body, or the frame, that the poses are of.
struct Mount {
  std::string name, remedy;
  Rigid3 subject_from_camera;
};

/// Returns whether the poses may be stated by angles; a table has angles or quaternions.
bool have_angles(const GivenPoses& given) {
  return given.format == "table" || given.format == "OXTS";
}

bool are_of_body(const GivenPoses& given) {
  return have_angles(given) || motion_norm(given.subject_from_camera) > 0;
}

bool have_quaternions(const Sequence& sequence, const GivenPoses& given) {
  if (given.format == "truth") return sequence.format != "KITTI" && sequence.format != "7-Scenes";
  return given.format != "OXTS" && given.format != "KITTI";
}

Change identity() {
  return {"", "", [](const Rigid3& pose) { return pose; }};
}

/// Returns readings of the four numbers in another order than the one stated.
std::vector<Change> quaternion_orders() {
  const auto reordered = [](const Rigid3& pose, bool w_is_first) {
    const Eigen::Quaterniond& q = pose.rotation;
    return Rigid3{w_is_first ? Eigen::Quaterniond(q.x(), q.y(), q.z(), q.w())
                             : Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y()),
                  pose.translation};
  };
  return {{"quaternions with qw first, qw qx qy qz", "Write them in the order qx qy qz qw.",
           [=](const Rigid3& pose) { return reordered(pose, true); }},
          {"quaternions with qw last, qx qy qz qw", "Write them in the order qw qx qy qz.",
           [=](const Rigid3& pose) { return reordered(pose, false); }}};
}

/// Returns the orders of quaternions that may be meant. A file in the TUM format states qw last, one in
/// EuRoC's first, so only the other order is possible; the names of a table's columns may be wrong either
/// way.
std::vector<Change> other_quaternion_orders(const Sequence& sequence, const GivenPoses& given) {
  if (!have_quaternions(sequence, given)) return {};
  std::vector<Change> orders = quaternion_orders();
  if (given.format == "table") {
    orders[0].remedy = "Rename the columns: those named qx, qy, qz, qw hold qw, qx, qy, qz.";
    orders[1].remedy = "Rename the columns: those named qw, qx, qy, qz hold qx, qy, qz, qw.";
    return orders;
  }
  const bool states_w_first =
      given.format == "EuRoC" || (given.format == "truth" && sequence.format == "EuRoC");
  return {orders[states_w_first ? 1 : 0]};
}

Change inverse_poses() {
  return {"inverse poses, camera_from_world", "Write world_from_camera: the inverse of each pose.",
          [](const Rigid3& pose) { return pose.inverse(); }};
}

Eigen::Quaterniond turn(double angle, const Eigen::Vector3d& axis) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis));
}

/// (roll, pitch, yaw) of Rz(yaw) Ry(pitch) Rx(roll).
using Angles = Eigen::Vector3d;

Angles angles_of(const Eigen::Quaterniond& rotation) {
  const Eigen::Matrix3d r = rotation.toRotationMatrix();
  return {std::atan2(r(2, 1), r(2, 2)), -std::asin(std::clamp(r(2, 0), -1.0, 1.0)),
          std::atan2(r(1, 0), r(0, 0))};
}

Change by_angles(const std::string& name, const std::string& remedy, const Eigen::Quaterniond& reference,
                 const std::function<Angles(const Angles&)>& change) {
  return {name, remedy, [=](const Rigid3& pose) {
            const Angles a = change(angles_of(reference.conjugate() * pose.rotation));
            const Eigen::Quaterniond rotation = turn(a.z(), Eigen::Vector3d::UnitZ()) *
                                                turn(a.y(), Eigen::Vector3d::UnitY()) *
                                                turn(a.x(), Eigen::Vector3d::UnitX());
            return Rigid3{(reference * rotation).normalized(), pose.translation};
          }};
}

/// Returns the readings of angles that may be meant. A table states roll, pitch and heading against north,
/// east, down; OXTS packets against east, north, up.
std::vector<Change> other_angles(const GivenPoses& given) {
  constexpr double kRight = std::numbers::pi / 2, kRadian = std::numbers::pi / 180;
  const bool is_table = given.format == "table";
  if (!have_angles(given)) return {};
  constexpr double kHalf = std::numbers::sqrt2 / 2;
  const Eigen::Quaterniond reference =
      is_table ? Eigen::Quaterniond(0, kHalf, kHalf, 0) : Eigen::Quaterniond::Identity();
  const std::string heading = is_table ? "heading" : "yaw";
  const auto of_heading = [&](const std::string& name, const std::string& remedy, double sign, double plus) {
    return by_angles(name, remedy, reference,
                     [=](const Angles& a) { return Angles(a.x(), a.y(), sign * a.z() + plus); });
  };
  std::vector<Change> changes{
      of_heading(heading + " of the other sign", fmt::format("Change the sign of {}.", heading), -1, 0),
      of_heading(is_table ? "heading counter-clockwise from east" : "yaw clockwise from north",
                 fmt::format("Replace {} by 90 degrees minus it.", heading), -1, kRight)};
  for (const int quarters : {1, 2, 3}) {
    changes.push_back(of_heading(
        fmt::format("{} that lacks {} degrees", heading, 90 * quarters),
        fmt::format("Add {} degrees to {}, or turn body_from_camera in camera.yaml.", 90 * quarters, heading),
        1, quarters * kRight));
  }
  if (is_table) {
    changes.push_back(by_angles("angles in radians", "Name the columns roll_rad, pitch_rad, heading_rad.",
                                reference, [=](const Angles& a) -> Angles { return a / kRadian; }));
  }
  return changes;
}

std::vector<Change> other_places(const GivenPoses& given) {
  if (given.format != "table" || given.origin) return {};
  return {{"east and north exchanged", "Exchange the names of the two columns.", [](const Rigid3& pose) {
             return Rigid3{pose.rotation, {pose.translation.y(), pose.translation.x(), pose.translation.z()}};
           }}};
}

std::vector<Change> changes_of(const Sequence& sequence, const GivenPoses& given) {
  std::vector<Change> changes{identity()};
  if (given.format != "OXTS") changes.push_back(inverse_poses());
  for (const auto& more :
       {other_quaternion_orders(sequence, given), other_angles(given), other_places(given)})
    changes.insert(changes.end(), more.begin(), more.end());
  return changes;
}

/// Returns the mounts of the camera that may be meant, first the stated one.
std::vector<Mount> mounts_of(const GivenPoses& given) {
  const Rigid3& stated = given.subject_from_camera;
  struct Axes {
    const char *words, *xyzw;
    Eigen::Quaterniond axes_from_camera;
  };
  const Axes known[] = {
      {"x forward, y left, z up", "[-0.5, 0.5, -0.5, 0.5]", {0.5, -0.5, 0.5, -0.5}},
      {"x forward, y right, z down", "[0.5, 0.5, 0.5, 0.5]", {0.5, 0.5, 0.5, 0.5}},
      {"x right, y up, z backward", "[1, 0, 0, 0]", {0, 1, 0, 0}},
  };
  std::vector<Mount> mounts{{"", "", stated}};
  const bool of_body = are_of_body(given);
  for (const Axes& axes : known) {
    if (rotation_angle(stated.rotation.conjugate() * axes.axes_from_camera) < 1e-3) continue;
    mounts.push_back(
        {of_body ? fmt::format("poses of a body on which the camera looks forward, {}", axes.words)
                 : fmt::format("poses of axes with {}", axes.words),
         of_body
             ? fmt::format("Write quaternion_xyzw: {} into body_from_camera in camera.yaml.", axes.xyzw)
             : fmt::format("Write poses of the camera (x right, y down, z forward): multiply each rotation "
                           "on the right by the quaternion_xyzw {}.",
                           axes.xyzw),
         {axes.axes_from_camera, stated.translation}});
  }
  if (of_body && motion_norm(stated) > 0)
    mounts.push_back({"poses of the camera itself",
                      "Write them in TUM format, or leave 'body' out of camera.yaml.", Rigid3{}});
  if (of_body)
    mounts.push_back({"body_from_camera as its inverse, camera_from_body",
                      "Write the inverse of body_from_camera into camera.yaml.", stated.inverse()});
  return mounts;
}

PoseReading reading_of(const CameraPoses& poses, const Rigid3& stated_camera_from_subject,
                       const Change& change, const Mount& mount) {
  PoseReading reading;
  reading.is_combined = !change.name.empty() && !mount.name.empty();
  const char* const comma = reading.is_combined ? ", and " : "";
  reading.name = change.name + comma + mount.name;
  reading.remedy = change.remedy + (reading.is_combined ? " " : "") + mount.remedy;
  for (const auto& pose : poses) {
    reading.poses.emplace_back();
    if (pose)
      reading.poses.back() =
          WorldFromCamera(change.apply(*pose * stated_camera_from_subject) * mount.subject_from_camera);
  }
  return reading;
}

/// Returns the reading in which frame i has the pose of frame i + `by`; `offset_s` was added to the stamps
/// already.
PoseReading shifted(const Sequence& sequence, const CameraPoses& poses, double offset_s, int by) {
  PoseReading reading;
  const auto count = static_cast<std::int64_t>(poses.size());
  double seconds = 0;
  std::int64_t shared = 0;
  for (std::int64_t i = 0; i < count; ++i) {
    reading.poses.emplace_back();
    if (i + by < 0 || i + by >= count) continue;
    const auto from = static_cast<std::size_t>(i + by), to = static_cast<std::size_t>(i);
    reading.poses.back() = poses[from];
    seconds += 1e-9 * static_cast<double>(sequence.frames[to].stamp_ns - sequence.frames[from].stamp_ns);
    ++shared;
  }
  if (shared > 0) seconds /= static_cast<double>(shared);
  reading.name = fmt::format("poses of the frames {} {}", std::abs(by), by > 0 ? "later" : "earlier");
  reading.remedy = fmt::format(
      "Add {:.3f} s to the stamps of the poses, --pose-offset {:.3f} in all, or correct their numbers.",
      seconds, offset_s + seconds);
  return reading;
}

}  // namespace

std::vector<PoseReading> other_readings(const Sequence& sequence, const GivenPoses& given) {
  const CameraPoses poses = camera_poses(given);
  const std::vector<Mount> mounts = mounts_of(given);
  const Rigid3 camera_from_subject = mounts.front().subject_from_camera.inverse();
  std::vector<PoseReading> readings;
  for (const Change& change : changes_of(sequence, given)) {
    for (const Mount& mount : mounts) {
      if (change.name.empty() && mount.name.empty()) continue;
      readings.push_back(reading_of(poses, camera_from_subject, change, mount));
    }
  }
  constexpr int kMostFrames = 10;
  for (int by = 1; by <= kMostFrames; ++by) {
    readings.push_back(shifted(sequence, poses, given.time_offset_s, by));
    readings.push_back(shifted(sequence, poses, given.time_offset_s, -by));
  }
  return readings;
}

}  // namespace cairn
