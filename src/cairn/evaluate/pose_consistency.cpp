// SPDX-License-Identifier: Apache-2.0
#include "cairn/evaluate/pose_consistency.h"

#include <algorithm>

#include "cairn/core/error.h"

namespace cairn {
namespace {

/// Collects the errors of poses with one kind of covariance.
class PoseErrorCollector {
 public:
  explicit PoseErrorCollector(double scale) { scales_.tail<3>().setConstant(scale); }

  void add(const Rigid3& estimate, const Rigid3& truth, const Matrix6d& covariance) {
    const Vector6d error = left_perturbation(estimate, truth);
    const Matrix6d scaled = scales_.asDiagonal() * covariance * scales_.asDiagonal();
    pose_.add(error, scaled);
    rotation_.add(error.head<3>(), scaled.topLeftCorner<3, 3>());
    position_.add(error.tail<3>(), scaled.bottomRightCorner<3, 3>());
  }

  [[nodiscard]] std::optional<PoseConsistency> assess() const {
    if (pose_.count() == 0) return std::nullopt;
    return PoseConsistency{*pose_.assess(), *position_.assess(), *rotation_.assess()};
  }

 private:
  Vector6d scales_ = Vector6d::Ones();
  ErrorCollector pose_, position_, rotation_;
};

/// Returns the pair of a stamp, or null. Pairs are in order of time.
const PosePair* find_pair(std::span<const PosePair> pairs, std::int64_t stamp_ns) {
  const auto found =
      std::lower_bound(pairs.begin(), pairs.end(), stamp_ns,
                       [](const PosePair& pair, std::int64_t stamp) { return pair.stamp_ns < stamp; });
  return found != pairs.end() && found->stamp_ns == stamp_ns ? &*found : nullptr;
}

CovarianceScope scope_of(const std::string& prefix) {
  if (prefix == kLocalizationPrefixes[0]) return CovarianceScope::absolute;
  if (prefix == kLocalizationPrefixes[1]) return CovarianceScope::in_map;
  if (prefix == kKeyframePrefixes[0]) return CovarianceScope::from_first;
  require(prefix == kKeyframePrefixes[1], "a table has the columns of one of the known prefixes");
  return CovarianceScope::from_previous;
}

StatedPoses assess_poses(const CovarianceTable& table, std::size_t set, bool is_weak,
                         std::span<const PosePair> pairs, double scale) {
  StatedPoses stated{scope_of(table.prefixes[set]), is_weak, 0, 0, {}};
  PoseErrorCollector errors(scale);
  for (const CovarianceRow& row : table.rows) {
    if (row.is_weak != is_weak) continue;
    const PosePair* const pair = find_pair(pairs, row.stamp_ns);
    if (pair == nullptr) {
      ++stated.without_truth;
    } else if (!row.covariances[set]) {
      ++stated.without_covariance;
    } else {
      errors.add(pair->estimate.inverse(), pair->reference.inverse(), *row.covariances[set]);
    }
  }
  stated.consistency = errors.assess();
  return stated;
}

/// Returns for each row whether a component begins there.
std::vector<char> beginnings_of(const CovarianceTable& table) {
  std::vector<char> begins(table.rows.size(), 0);
  if (!begins.empty()) begins[0] = 1;
  const auto previous = std::find(table.prefixes.begin(), table.prefixes.end(), kKeyframePrefixes[1]);
  if (previous == table.prefixes.end()) return begins;
  const auto set = static_cast<std::size_t>(previous - table.prefixes.begin());
  for (std::size_t i = 1; i < begins.size(); ++i) begins[i] = table.rows[i].covariances[set] ? 0 : 1;
  return begins;
}

StatedPoses assess_motions(const CovarianceTable& table, std::size_t set, std::span<const PosePair> pairs,
                           double scale) {
  StatedPoses stated{scope_of(table.prefixes[set]), false, 0, 0, {}};
  const bool from_first = stated.scope == CovarianceScope::from_first;
  const std::vector<char> begins = beginnings_of(table);
  PoseErrorCollector errors(scale);
  const PosePair* origin = nullptr;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const CovarianceRow& row = table.rows[i];
    const PosePair* const pair = find_pair(pairs, row.stamp_ns);
    if (begins[i] != 0) {
      origin = pair;
      continue;
    }
    if (pair == nullptr || origin == nullptr) {
      ++stated.without_truth;
    } else if (!row.covariances[set]) {
      ++stated.without_covariance;
    } else {
      errors.add(pair->estimate.inverse() * origin->estimate, pair->reference.inverse() * origin->reference,
                 *row.covariances[set]);
    }
    if (!from_first) origin = pair;
  }
  stated.consistency = errors.assess();
  return stated;
}

}  // namespace

std::vector<StatedPoses> assess_localizations(const CovarianceTable& table, std::span<const PosePair> pairs,
                                              double scale) {
  std::vector<StatedPoses> all;
  const bool any_weak =
      std::any_of(table.rows.begin(), table.rows.end(), [](const CovarianceRow& row) { return row.is_weak; });
  for (const bool is_weak : {false, true})
    for (std::size_t set = 0; set < table.prefixes.size(); ++set)
      if (!is_weak || any_weak) all.push_back(assess_poses(table, set, is_weak, pairs, scale));
  return all;
}

std::vector<StatedPoses> assess_keyframes(const CovarianceTable& table, std::span<const PosePair> pairs,
                                          double scale) {
  std::vector<StatedPoses> all;
  for (std::size_t set = 0; set < table.prefixes.size(); ++set)
    all.push_back(assess_motions(table, set, pairs, scale));
  return all;
}

}  // namespace cairn
