// SPDX-License-Identifier: Apache-2.0
#include "cairn/observe/row_errors.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/core/median.h"
#include "cairn/features/extractor.h"
#include "cairn/matching/stereo_matching.h"
#include "cairn/matching/window_offset.h"
#include "cairn/observe/observer.h"
#include "cairn/sequence/sample_frames.h"

namespace cairn {
namespace {

constexpr std::size_t kPairs = 8;
constexpr int kFeatures = 600;

/// Holds the left row less the right one of one window, at a place of the images.
struct RowReading {
  RowField basis;
  double error_px;
};

/// Measures the windows of one pair.
class RowMeasurer {
 public:
  explicit RowMeasurer(const Sequence& sequence)
      : loader_(sequence),
        rig_(rig_of(sequence.calibration, {})),
        extractor_(make_extractor({.detector = "ORB", .descriptor = "ORB", .count = kFeatures})) {
    matching_.row_band = 4;          // sigmas: rows may be wrong by some pixels
    matching_.min_correlation = -1;  // judged when the right row is known
  }

  [[nodiscard]] std::vector<RowReading> operator()(FrameId id) const {
    try {
      return read(loader_.load(id));
    } catch (const InputError&) {
      return {};
    }
  }

 private:
  [[nodiscard]] std::vector<RowReading> read(const Frame& frame) const {
    const Features left = extractor_->extract(frame.gray), right = extractor_->extract(frame.right);
    const auto matches = match_stereo(rig_, {left, frame.gray}, {right, frame.right}, matching_);
    std::vector<RowReading> readings;
    for (std::size_t i = 0; i < matches.size(); ++i) {
      if (!matches[i]) continue;
      const Keypoint& keypoint = left.keypoints[i];
      const Keypoint& other = right.keypoints[static_cast<std::size_t>(matches[i]->right)];
      add_reading(frame, {keypoint.u, keypoint.v}, {other.u - keypoint.u, other.v - keypoint.v}, readings);
    }
    return readings;
  }

  void add_reading(const Frame& frame, const Eigen::Vector2f& pixel, const Eigen::Vector2f& guess,
                   std::vector<RowReading>& readings) const {
    constexpr double kReach = 4, kMinCorrelation = 0.85, kMaxSigma = 0.3;  // pixels
    const auto found =
        measure_offset(frame.gray, frame.right, pixel.cast<double>(), guess.cast<double>(), kReach);
    if (!found || found->correlation < kMinCorrelation || found->sigma_px > kMaxSigma) return;
    const double u_right = static_cast<double>(pixel.x()) + found->offset.x();
    readings.push_back({row_field_basis(rig_, u_right, static_cast<double>(pixel.y())), -found->offset.y()});
  }

  FrameLoader loader_;
  Rig rig_;
  std::unique_ptr<Extractor> extractor_;
  StereoMatchOptions matching_;
};

double robust_deviation(std::vector<double> errors) {
  if (errors.empty()) return 0;
  for (double& error : errors) error = std::abs(error);
  return kSigmaPerMedian * median(std::move(errors));
}

std::vector<double> residuals(std::span<const RowReading> readings, const RowField& field) {
  std::vector<double> errors;
  for (const RowReading& reading : readings) errors.push_back(reading.error_px - field.dot(reading.basis));
  return errors;
}

/// Fits the field with Cauchy's weights; a prior of 10 px keeps what the readings leave open near 0.
RowField fit_field(std::span<const RowReading> readings) {
  constexpr int kRounds = 15;
  constexpr double kTuning = 2.385;  // 95 % efficiency on a normal distribution
  constexpr double kPriorWeight = 1e-2;
  RowField field = RowField::Zero();
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<double> errors = residuals(readings, field);
    const double scale = kTuning * std::max(robust_deviation(errors), 0.01);
    Eigen::Matrix<double, 6, 6> normal = kPriorWeight * Eigen::Matrix<double, 6, 6>::Identity();
    RowField right = RowField::Zero();
    for (std::size_t i = 0; i < readings.size(); ++i) {
      const double weight = 1 / (1 + errors[i] * errors[i] / (scale * scale));
      normal += weight * readings[i].basis * readings[i].basis.transpose();
      right += weight * readings[i].error_px * readings[i].basis;
    }
    field = normal.ldlt().solve(right);
  }
  return field;
}

/// Computes the standard deviations of the terms of a field by the scatter of the readings about it.
RowField formal_sigma(std::span<const RowReading> readings, double scatter) {
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  for (const RowReading& reading : readings) normal += reading.basis * reading.basis.transpose();
  normal.diagonal().array() += 1e-6;  // against terms that no reading shows
  const Eigen::Matrix<double, 6, 6> inverse = normal.ldlt().solve(Eigen::Matrix<double, 6, 6>::Identity());
  return scatter * inverse.diagonal().cwiseMax(0).cwiseSqrt();
}

double rms_of(const RowField& field, std::span<const RowReading> readings) {
  double squares = 0;
  for (const RowReading& reading : readings) squares += std::pow(field.dot(reading.basis), 2);
  return readings.empty() ? 0 : std::sqrt(squares / static_cast<double>(readings.size()));
}

}  // namespace

bool RowErrors::is_determined() const {
  constexpr int kMinMatches = 200;
  return pairs > 1 && matches >= kMinMatches;
}

bool RowErrors::should_be_applied() const {
  constexpr double kMinRmsPx = 0.2;
  return is_determined() && rms_px > kMinRmsPx && halves_differ_px < 0.5 * rms_px;
}

RowErrors measure_row_errors(const Sequence& sequence, const Executor& executor) {
  RowErrors errors;
  if (!is_stereo(sequence)) return errors;
  const RowMeasurer read(sequence);
  const std::vector<FrameId> ids = sample_frames(sequence.frames.size(), kPairs);
  const auto of_pairs =
      executor.map<std::vector<RowReading>>(ids.size(), [&](std::size_t k) { return read(ids[k]); });
  std::vector<RowReading> readings;
  std::size_t middle = 0;
  for (std::size_t k = 0; k < of_pairs.size(); ++k) {
    errors.pairs += of_pairs[k].empty() ? 0 : 1;
    readings.insert(readings.end(), of_pairs[k].begin(), of_pairs[k].end());
    if (k < of_pairs.size() / 2) middle = readings.size();
  }
  const std::span<const RowReading> all = readings;
  errors.matches = static_cast<int>(readings.size());
  errors.field = fit_field(all);
  errors.rms_px = rms_of(errors.field, all);
  errors.scatter_px = robust_deviation(residuals(all, errors.field));
  const RowField difference = fit_field(all.first(middle)) - fit_field(all.subspan(middle));
  errors.halves_differ_px = rms_of(difference, all);
  errors.sigma = formal_sigma(all, errors.scatter_px).cwiseMax(difference.cwiseAbs() / 2);
  return errors;
}

AlignedRows align_rows(const Sequence& sequence, const std::string& self_calibration,
                       const Executor& executor) {
  AlignedRows aligned{sequence, {}};
  if (self_calibration == "off" || sequence.calibration.right_correction) return aligned;
  aligned.errors = measure_row_errors(sequence, executor);
  aligned.applied = self_calibration == "auto" && aligned.errors.should_be_applied();
  if (aligned.applied) aligned.sequence.calibration.right_correction = {aligned.errors.field};
  return aligned;
}

}  // namespace cairn
