// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/keyframe_covariances.h"

#include <Eigen/Cholesky>

#include "cairn/geometry/covariance.h"

namespace cairn {
namespace {

/// Lists the motions of a component, and what each is for.
class MotionList {
 public:
  MotionList(const Map& map, const Window& whole, std::vector<KeyframeCovariance>& covariances)
      : map_(map), whole_(whole), covariances_(covariances), camera_of_(map.keyframes().size(), -1) {
    for (std::size_t c = 0; c < whole.cameras.size(); ++c)
      camera_of_[static_cast<std::size_t>(whole.cameras[c].value)] = static_cast<std::int32_t>(c);
    for (std::size_t c = 0; c < whole.cameras.size(); ++c) add_camera(static_cast<std::int32_t>(c));
  }

  [[nodiscard]] const std::vector<CameraMotion>& motions() const { return motions_; }

  void store(const CameraCovariances& found) {
    for (std::size_t i = 0; i < found.covariances.size(); ++i)
      if (found.covariances[i].allFinite()) *targets_[i] = found.covariances[i];
  }

 private:
  void add_camera(std::int32_t camera) {
    const Keyframe& keyframe = map_[whole_.cameras[static_cast<std::size_t>(camera)]];
    KeyframeCovariance& covariance = covariances_[static_cast<std::size_t>(keyframe.id.value)];
    covariance = {};
    if (keyframe.parent.valid())
      add(camera_of_[static_cast<std::size_t>(keyframe.parent.value)], camera, covariance.from_parent);
    if (!keyframe.observed.frame.valid()) return;  // of the start map
    if (first_ < 0) {
      first_ = camera;
      covariance.from_first = Matrix6d::Zero();
    } else {
      add(first_, camera, covariance.from_first);
    }
    add(previous_, camera, covariance.from_previous);
    previous_ = camera;
  }

  void add(std::int32_t from, std::int32_t to, std::optional<Matrix6d>& target) {
    if (from < 0 || from == to) return;
    motions_.push_back({from, to});
    targets_.push_back(&target);
  }

  const Map& map_;
  const Window& whole_;
  std::vector<KeyframeCovariance>& covariances_;
  std::vector<std::int32_t> camera_of_;  // by keyframe
  std::vector<CameraMotion> motions_;
  std::vector<std::optional<Matrix6d>*> targets_;
  std::int32_t first_ = -1, previous_ = -1;
};

}  // namespace

void keep_keyframe_covariances(const Map& map, const Window& whole, std::span<const char> use_observation,
                               SharedField field, const Executor& executor,
                               std::vector<KeyframeCovariance>& covariances) {
  covariances.resize(map.keyframes().size());
  MotionList list(map, whole, covariances);
  list.store(camera_covariances(whole.problem, use_observation, list.motions(), field, executor));
}

/// An edge's error (t, u) is of a_from_b, and u half a rotation: (w, v) = -(2 u, t) of b_from_a.
std::optional<Matrix6d> edge_information_of(const Matrix6d& covariance) {
  const Eigen::LLT<Matrix6d> factor(covariance);
  if (factor.info() != Eigen::Success) return std::nullopt;
  Matrix6d by_error = Matrix6d::Zero();
  by_error.topRightCorner<3, 3>() = -2 * Eigen::Matrix3d::Identity();
  by_error.bottomLeftCorner<3, 3>() = -Eigen::Matrix3d::Identity();
  const Matrix6d information = by_error.transpose() * factor.solve(by_error);
  if (!information.allFinite()) return std::nullopt;
  return as_covariance(information);
}

}  // namespace cairn
