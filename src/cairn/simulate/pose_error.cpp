// SPDX-License-Identifier: Apache-2.0
#include "cairn/simulate/pose_error.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "cairn/core/error.h"
#include "cairn/core/random.h"
#include "cairn/core/text.h"

namespace cairn {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;
constexpr std::uint64_t kStreams = 1ULL << 63;  // keeps the errors' random streams from those of the images

void expect(bool holds, const char* option, const char* expected, double found) {
  if (holds) return;
  throw InputError({option, 0, expected, fmt::format("{}", found), "Choose another value."});
}

void expect_deviations(const char* option, double metres, double degrees) {
  expect(metres >= 0 && metres <= 100, option, "metres from 0 to 100", metres);
  expect(degrees >= 0 && degrees <= 10, option, "degrees from 0 to 10", degrees);
}

Vector6d deviations(double metres, double degrees) {
  Vector6d result;
  result << Eigen::Vector3d::Constant(metres), Eigen::Vector3d::Constant(kRadiansPerDegree * degrees);
  return result;
}

/// Draws independent normal numbers, each from a stream of its own.
class NormalVector {
 public:
  NormalVector(std::uint64_t seed, std::uint64_t first_stream)
      : streams_{Random(seed, first_stream),     Random(seed, first_stream + 1),
                 Random(seed, first_stream + 2), Random(seed, first_stream + 3),
                 Random(seed, first_stream + 4), Random(seed, first_stream + 5)} {}

  [[nodiscard]] Vector6d next() {
    Vector6d result;
    for (Eigen::Index i = 0; i < 6; ++i) result[i] = streams_.at(static_cast<std::size_t>(i)).normal();
    return result;
  }

 private:
  std::array<Random, 6> streams_;
};

}  // namespace

void PoseErrorOptions::validate() const {
  constexpr double kShortest = 1e-3, kLongest = 1e5;  // seconds
  expect_deviations("--pose-error", position_std, rotation_std_deg);
  expect_deviations("--pose-jitter", jitter_position_std, jitter_rotation_std_deg);
  expect(correlation_time_s >= kShortest && correlation_time_s <= kLongest, "--pose-error-time",
         "seconds from 0.001 to 100000", correlation_time_s);
}

bool PoseErrorOptions::is_any() const {
  return total_position_std() > 0 || total_rotation_std_deg() > 0;
}

double PoseErrorOptions::total_position_std() const {
  return std::hypot(position_std, jitter_position_std);
}

double PoseErrorOptions::total_rotation_std_deg() const {
  return std::hypot(rotation_std_deg, jitter_rotation_std_deg);
}

std::vector<Vector6d> draw_pose_errors(const PoseErrorOptions& options,
                                       std::span<const std::int64_t> stamps_ns, std::uint64_t seed) {
  options.validate();
  NormalVector wander(seed, kStreams), jitter(seed, kStreams + 6);
  const Vector6d wander_std = deviations(options.position_std, options.rotation_std_deg),
                 jitter_std = deviations(options.jitter_position_std, options.jitter_rotation_std_deg);
  std::vector<Vector6d> errors;
  Vector6d state = Vector6d::Zero();  // of standard deviation 1
  for (std::size_t i = 0; i < stamps_ns.size(); ++i) {
    const double gap_s = i > 0 ? 1e-9 * static_cast<double>(stamps_ns[i] - stamps_ns[i - 1]) : 0;
    const double kept = i > 0 ? std::exp(-gap_s / options.correlation_time_s) : 0;
    state = kept * state + std::sqrt(1 - kept * kept) * wander.next();
    errors.emplace_back(wander_std.cwiseProduct(state) + jitter_std.cwiseProduct(jitter.next()));
  }
  return errors;
}

StampedPoses stamped_poses(const Trajectory& trajectory) {
  StampedPoses poses;
  for (const StampedPose& pose : trajectory) poses.emplace_back(pose.stamp_ns, pose.world_from_camera);
  return poses;
}

StampedPoses with_pose_errors(const PoseErrorOptions& options, StampedPoses poses, std::uint64_t seed) {
  std::vector<std::int64_t> stamps_ns;
  for (const auto& [stamp_ns, pose] : poses) stamps_ns.push_back(stamp_ns);
  const std::vector<Vector6d> errors = draw_pose_errors(options, stamps_ns, seed);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    Rigid3& pose = poses[i].second;
    pose.translation += errors[i].head<3>();
    pose.rotation = (rotation_exp(errors[i].tail<3>()) * pose.rotation).normalized();
  }
  return poses;
}

std::string format_pose_table(const PoseErrorOptions& options, const StampedPoses& poses, char separator) {
  std::string text =
      "time_s x_m y_m z_m qx qy qz qw std_x_m std_y_m std_z_m std_rx_deg std_ry_deg std_rz_deg\n";
  const double metres = options.total_position_std(), degrees = options.total_rotation_std_deg();
  for (const auto& [stamp_ns, pose] : poses) {
    const auto& t = pose.translation;
    const auto& q = pose.rotation;
    text += fmt::format("{} {:.9f} {:.9f} {:.9f} {:.12f} {:.12f} {:.12f} {:.12f} {} {} {} {} {} {}\n",
                        format_stamp(stamp_ns), t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w(), metres,
                        metres, metres, degrees, degrees, degrees);
  }
  for (char& c : text)
    if (c == ' ') c = separator;
  return text;
}

}  // namespace cairn
