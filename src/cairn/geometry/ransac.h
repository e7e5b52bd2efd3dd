// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "cairn/core/random.h"

namespace cairn {

/// Sets how long RANSAC samples and with which random numbers.
struct RansacOptions {
  int max_iterations = 500;  ///< enough for samples of three with 20 % inliers: 1 - (1 - 0.2^3)^500 = 98 %
  /// Sampling stops once a sample of inliers alone was drawn with this probability.
  double confidence = 0.999;
  std::uint64_t seed = 1;
  std::uint64_t item = 0;  ///< number of this problem among many; each has its own random numbers

  /// Throws PreconditionError if max_iterations is below 1 or confidence is not in (0, 1).
  void validate() const;
};

/// Says if a model was found and, if not, why.
enum class RansacStatus {
  ok,
  too_few_data,  ///< fewer than a sample
  degenerate,    ///< no sample, or not all inliers together, determine a model
  by_chance,     ///< a model was found that wrong data would support as well: see log10_false_alarms
};

[[nodiscard]] std::string_view to_string(RansacStatus status);

/// Describes how a model was found. There is no model unless `status` is ok or by_chance.
struct RansacReport {
  RansacStatus status = RansacStatus::too_few_data;
  std::vector<std::int32_t> inliers;  ///< positions of data within their limit, increasing
  int iterations = 0;                 ///< samples drawn
  double cost = 0;                    ///< sum of squared errors, each at most its limit (MSAC)
  /// Decimal logarithm of the number of models with at least so many inliers that are expected if the data
  /// are unrelated; the model is accepted below -2.
  double log10_false_alarms = 0;

  /// Returns ok if the number of false alarms is low enough to accept a model that is determined, else
  /// by_chance.
  [[nodiscard]] RansacStatus verdict() const {
    constexpr double kBelieved = -2;
    return log10_false_alarms < kBelieved ? RansacStatus::ok : RansacStatus::by_chance;
  }
  [[nodiscard]] bool found() const { return status == RansacStatus::ok; }
};

/// Holds a model and how it was found.
template <class Model>
struct RansacResult : RansacReport {
  Model model{};
};

/// Draws `N` different indices below `count`; count must be at least N.
template <std::size_t N>
[[nodiscard]] std::array<std::uint32_t, N> draw_sample(Random& random, std::uint32_t count) {
  std::array<std::uint32_t, N> sample{};
  for (std::size_t i = 0; i < N; ++i) {
    const auto drawn = sample.begin() + static_cast<std::ptrdiff_t>(i);
    do {
      sample[i] = random.index(count);
    } while (std::find(sample.begin(), drawn, sample[i]) != drawn);
  }
  return sample;
}

/// Computes the number of samples after which one of inliers alone has been drawn with the options'
/// confidence (Fischler and Bolles 1981, sec. II.B), at most max_iterations.
[[nodiscard]] int samples_needed(std::size_t inliers, std::size_t count, std::size_t sample_size,
                                 const RansacOptions& options);

/// Computes the decimal logarithm of the number of false alarms of a model with `inliers` of `count` data,
/// from `models` models per sample, if an outlier is within the limit with probability `chance` (Moisan and
/// Stival 2004, prop. 1, with a fixed limit): models C(count, inliers) C(inliers, sample_size)
/// chance^(inliers - sample_size).
[[nodiscard]] double log10_false_alarms(std::size_t inliers, std::size_t count, std::size_t sample_size,
                                        std::size_t models, double chance);

/// Estimates a model by RANSAC (Fischler and Bolles 1981) with bounded squared errors as the score (MSAC,
/// Torr and Zisserman 2000), local optimisation of each new best model by least squares over inliers whose
/// limit shrinks (LO-RANSAC, Chum, Matas, Kittler 2003, "iterative") and adaptive stop. One engine for all
/// problems. Deterministic from seed and item; one thread. A Problem has
///
///     using Model;                            what is estimated, ready for squared_error
///     kSampleSize, kMaxModels                 data in a sample, models that one sample can give
///     size()                                  number of data
///     solve(sample, models) -> size_t         computes the models of a minimal sample; returns how many
///     squared_error(model, i) -> double       of datum i, in variances; infinite if undefined
///     limit(i) -> double                      of squared_error of an inlier: a chi-square quantile
///     refine(inliers, model) -> bool          least squares over inliers from model; false if undetermined
///     chance() -> double                      probability that an outlier is within the limit
template <class Problem>
class Ransac {
 public:
  using Model = typename Problem::Model;

  Ransac(const Problem& problem, const RansacOptions& options) : problem_(problem), options_(options) {
    options.validate();
  }

  [[nodiscard]] RansacResult<Model> run() {
    if (problem_.size() < Problem::kSampleSize) return {};
    Random random(options_.seed, options_.item);
    needed_ = options_.max_iterations;
    for (; result_.iterations < needed_; ++result_.iterations)
      try_sample(draw_sample<Problem::kSampleSize>(random, static_cast<std::uint32_t>(problem_.size())));
    finish();
    return std::move(result_);
  }

 private:
  struct Score {
    double cost = 0;
    std::size_t inliers = 0;
  };

  /// Scores a model; stops once its cost reaches the best: most models are wrong and show it early.
  [[nodiscard]] Score score(const Model& model) const {
    Score sum;
    for (std::size_t i = 0; i < problem_.size() && sum.cost < best_.cost; ++i) {
      const double limit = problem_.limit(i), error = problem_.squared_error(model, i);
      sum.inliers += error < limit ? 1 : 0;
      sum.cost += error < limit ? error : limit;
    }
    return sum;
  }

  [[nodiscard]] std::vector<std::int32_t> inliers_within(const Model& model, double widening) const {
    std::vector<std::int32_t> inliers;
    for (std::size_t i = 0; i < problem_.size(); ++i)
      if (problem_.squared_error(model, i) < widening * problem_.limit(i))
        inliers.push_back(static_cast<std::int32_t>(i));
    return inliers;
  }

  bool accept(const Model& model) {
    const Score found = score(model);
    if (!(found.cost < best_.cost)) return false;
    best_ = found;
    result_.model = model;
    return true;
  }

  void try_sample(const std::array<std::uint32_t, Problem::kSampleSize>& sample) {
    std::array<Model, Problem::kMaxModels> models;
    const std::size_t count = problem_.solve(sample, models);
    bool better = false;
    for (std::size_t i = 0; i < count; ++i) better = accept(models[i]) || better;
    if (!better) return;
    optimise_locally();
    needed_ = samples_needed(best_.inliers, problem_.size(), Problem::kSampleSize, options_);
  }

  void optimise_locally() {
    Model model = result_.model;
    for (const double widening : {4.0, 1.0}) {
      if (!problem_.refine(inliers_within(model, widening), model)) return;
      accept(model);
    }
  }

  /// Refines the best model by least squares until its cost no longer falls.
  void finish() {
    result_.status = RansacStatus::degenerate;
    if (best_.cost == std::numeric_limits<double>::infinity()) return;
    constexpr int kMaxRounds = 10;
    bool determined = true;
    for (int round = 0; round < kMaxRounds && determined; ++round) {
      Model model = result_.model;
      determined = problem_.refine(inliers_within(model, 1.0), model);
      if (!determined || !accept(model)) break;
    }
    result_.inliers = inliers_within(result_.model, 1.0);
    result_.cost = best_.cost;
    result_.log10_false_alarms =
        log10_false_alarms(result_.inliers.size(), problem_.size(), Problem::kSampleSize, Problem::kMaxModels,
                           problem_.chance());
    if (determined || result_.verdict() == RansacStatus::by_chance) result_.status = result_.verdict();
  }

  const Problem& problem_;
  const RansacOptions& options_;
  RansacResult<Model> result_;
  Score best_{std::numeric_limits<double>::infinity(), 0};
  int needed_ = 0;
};

}  // namespace cairn
