// SPDX-License-Identifier: Apache-2.0
#include "cairn/matching/matching.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <optional>

#include "cairn/features/extractor.h"
#include "cairn/matching/stereo_matching.h"
#include "features.h"

namespace cairn::bench {
namespace {

/// The descriptors of two images of one pair, and the same for OpenCV.
struct MatchingInput {
  Descriptors query, train;
  cv::Mat cv_query, cv_train;
};

/// OpenCV wants floats for L2.
cv::Mat to_opencv(const Descriptors& descriptors) {
  const bool l2 = descriptors.norm() == Norm::l2;
  const int rows = static_cast<int>(descriptors.count()), columns = static_cast<int>(descriptors.bytes());
  cv::Mat bytes(rows, columns, CV_8U), result;
  for (int i = 0; i < rows; ++i)
    std::copy_n(descriptors.row(static_cast<std::size_t>(i)), descriptors.bytes(), bytes.ptr(i));
  bytes.convertTo(result, l2 ? CV_32F : CV_8U);
  return result;
}

std::shared_ptr<const MatchingInput> describe(const ImagePair& pair, const std::string& method, int count) {
  const auto extractor = make_extractor({method, method, count});
  auto input = std::make_shared<MatchingInput>();
  input->query = extractor->extract(pair.first).descriptors;
  input->train = extractor->extract(pair.second).descriptors;
  input->cv_query = to_opencv(input->query);
  input->cv_train = to_opencv(input->train);
  return input;
}

Match from_opencv(const cv::DMatch& match) {
  return {match.queryIdx, match.trainIdx, match.distance};
}

std::vector<Match> nearest_by_opencv(const MatchingInput& input, bool mutual) {
  std::vector<cv::DMatch> found;
  cv::BFMatcher(cv::NORM_HAMMING, mutual).match(input.cv_query, input.cv_train, found);
  std::vector<Match> matches;
  for (const cv::DMatch& match : found) matches.push_back(from_opencv(match));
  return matches;
}

std::vector<std::array<Match, 2>> two_nearest_by_opencv(const MatchingInput& input) {
  std::vector<std::vector<cv::DMatch>> found;
  cv::BFMatcher(cv::NORM_L2).knnMatch(input.cv_query, input.cv_train, found, 2);
  std::vector<std::array<Match, 2>> matches;
  for (const auto& two : found) matches.push_back({from_opencv(two.at(0)), from_opencv(two.at(1))});
  return matches;
}

/// How many of theirs we have, too, at the same place of the list, to the bit of the distance.
template <class Found>
double count_identical(const std::vector<Found>& ours, const std::vector<Found>& theirs) {
  const std::size_t common = std::min(ours.size(), theirs.size());
  std::size_t same = 0;
  for (std::size_t i = 0; i < common; ++i) same += ours[i] == theirs[i] ? 1 : 0;
  return static_cast<double>(same);
}

/// All of theirs are ours, and we have no others.
template <class Found>
QualityComparison identity(const std::string& work, const std::vector<Found>& ours,
                           const std::vector<Found>& theirs) {
  const double others = static_cast<double>(std::max(ours.size(), theirs.size()) - theirs.size());
  return {work, count_identical(ours, theirs) - others, static_cast<double>(theirs.size()), 1.0, {}};
}

void time_both(Comparisons& comparisons, const std::string& work, double at_most_share,
               const std::function<void(const Executor&)>& ours, const Work& theirs) {
  for (const int threads : {1, 2}) {
    const auto executor = std::make_shared<Executor>(threads);
    comparisons.timed.push_back({work,
                                 threads,
                                 [=] { ours(*executor); },
                                 [=] {
                                   cv::setNumThreads(threads > 1 ? threads : 0);
                                   theirs();
                                   cv::setNumThreads(0);
                                 },
                                 at_most_share,
                                 {}});
  }
}

void add_hamming(Comparisons& comparisons, const ImagePair& pair) {
  constexpr double kAtMostShare = 1.0 / 20;
  const auto input = describe(pair, "OPENCV_ORB", 1000);
  MatchOptions mutual;
  mutual.mutual = true;
  const std::string size = fmt::format("{}x{}, 256 bits", input->query.count(), input->train.count());
  for (const MatchOptions& options : {MatchOptions(), mutual}) {
    const std::string work = fmt::format("Hamming {} {}", options.mutual ? "mutual" : "nearest", size);
    time_both(
        comparisons, work, kAtMostShare,
        [=](const Executor& executor) {
          (void)match_descriptors(input->query, input->train, options, executor);
        },
        [=] { (void)nearest_by_opencv(*input, options.mutual); });
    comparisons.quality.push_back(identity(work + ", identical matches",
                                           match_descriptors(input->query, input->train, options),
                                           nearest_by_opencv(*input, options.mutual)));
  }
}

void add_l2(Comparisons& comparisons, const ImagePair& pair) {
  constexpr double kAtMostShare = 1.0 / 8;
  const auto input = describe(pair, "OPENCV_SIFT", 2000);
  const std::string work =
      fmt::format("L2 two nearest {}x{}, 128 bytes", input->query.count(), input->train.count());
  time_both(
      comparisons, work, kAtMostShare,
      [=](const Executor& executor) { (void)match_two_nearest(input->query, input->train, executor); },
      [=] { (void)two_nearest_by_opencv(*input); });
  comparisons.quality.push_back(identity(work + ", identical matches",
                                         match_two_nearest(input->query, input->train),
                                         two_nearest_by_opencv(*input)));
}

/// Absolute errors of disparities, pixels, ascending, and the mean error without outliers.
struct DisparityErrors {
  std::vector<double> absolute;
  double mean = 0;

  [[nodiscard]] double quantile(double share) const {
    return absolute.empty()
               ? 0
               : absolute[static_cast<std::size_t>(share * static_cast<double>(absolute.size() - 1))];
  }
};

/// True disparity between the pixels around (u, v): on a plane it is linear. Nothing at an outline.
std::optional<double> true_disparity(const StereoPair& pair, double u, double v) {
  constexpr double kMaxStep = 1;  // pixels, from a pixel to the next
  const int u0 = static_cast<int>(std::floor(u)), v0 = static_cast<int>(std::floor(v));
  if (!pair.depth.contains(u0, v0) || !pair.depth.contains(u0 + 1, v0 + 1)) return std::nullopt;
  std::array<double, 4> at{};
  for (std::size_t i = 0; i < 4; ++i) {
    const double depth = pair.depth(u0 + static_cast<int>(i % 2), v0 + static_cast<int>(i / 2));
    if (!(depth > 0)) return std::nullopt;
    at[i] = pair.fx_baseline / depth;
  }
  const auto [least, most] = std::minmax_element(at.begin(), at.end());
  if (*most - *least > kMaxStep) return std::nullopt;
  const double s = u - u0, t = v - v0;
  return (1 - t) * ((1 - s) * at[0] + s * at[1]) + t * ((1 - s) * at[2] + s * at[3]);
}

DisparityErrors errors_of(const StereoPair& pair, const std::vector<Keypoint>& keypoints,
                          const std::vector<std::optional<StereoMatch>>& matches) {
  constexpr double kOutlierPx = 1;
  DisparityErrors errors;
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (!matches[i]) continue;
    const auto truth =
        true_disparity(pair, static_cast<double>(keypoints[i].u), static_cast<double>(keypoints[i].v));
    if (!truth) continue;
    const double error = matches[i]->disparity - *truth;
    errors.absolute.push_back(std::abs(error));
    if (std::abs(error) < kOutlierPx) sum += error, count += 1;
  }
  std::sort(errors.absolute.begin(), errors.absolute.end());
  errors.mean = count > 0 ? sum / count : 0;
  return errors;
}

void add_left_right(Comparisons& comparisons, const StereoPair& pair, const std::string& method) {
  constexpr double kAtMostMs = 3, kAtMostMedianPx = 0.3;
  const auto extractor = make_extractor({method, method, 2000});
  const auto left = std::make_shared<Features>(extractor->extract(pair.left));
  const auto right = std::make_shared<Features>(extractor->extract(pair.right));
  const Rig rig{pair.fx_baseline, pair.fx_baseline, 0, 0, 1};  // disparity needs the product alone
  const auto match = [=, &pair](const Executor& executor) {
    return match_stereo(rig, {*left, pair.left}, {*right, pair.right}, {}, executor);
  };
  const std::string work = fmt::format("left-right {} {}, 1242x375", method, left->keypoints.size());
  for (const int threads : {1, 2}) {
    const auto executor = std::make_shared<Executor>(threads);
    comparisons.timed.push_back({work, threads, [=] { (void)match(*executor); }, {}, {}, kAtMostMs});
  }
  const DisparityErrors errors = errors_of(pair, left->keypoints, match(Executor()));
  const auto count = static_cast<double>(errors.absolute.size());
  const auto wrong = static_cast<double>(
      errors.absolute.end() - std::upper_bound(errors.absolute.begin(), errors.absolute.end(), 3.0));
  comparisons.quality.push_back({work + ", matched at places with true depth", count, 0, {}, {}});
  comparisons.quality.push_back({work + ", median error, px", errors.quantile(0.5), 0, {}, kAtMostMedianPx});
  comparisons.quality.push_back({work + ", 90 % of errors below, px", errors.quantile(0.9), 0, {}, {}});
  comparisons.quality.push_back({work + ", mean error of those below 1 px", errors.mean, 0, {}, {}});
  comparisons.quality.push_back(
      {work + ", share beyond 3 px, %", 100 * wrong / std::max(1.0, count), 0, {}, {}});
}

}  // namespace

void add_matching(Comparisons& comparisons, const Inputs& inputs) {
  add_hamming(comparisons, inputs.pairs.back());
  add_l2(comparisons, inputs.pairs.back());
  for (const char* method : {"SIFT", "ORB"}) add_left_right(comparisons, inputs.stereo, method);
}

}  // namespace cairn::bench
