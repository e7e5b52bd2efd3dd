// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/matching.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>

#include "cairn/features/extractor.h"
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
                                   cv::setNumThreads(threads);
                                   theirs();
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

}  // namespace

void add_matching(Comparisons& comparisons, const Inputs& inputs) {
  add_hamming(comparisons, inputs.pairs.back());
  add_l2(comparisons, inputs.pairs.back());
}

}  // namespace cairn::bench
