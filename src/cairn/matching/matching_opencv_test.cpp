// SPDX-License-Identifier: Apache-2.0
// cairn's matches beside those of OpenCV's brute-force matcher.
#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>

#include "cairn/core/random.h"
#include "cairn/matching/matching.h"

namespace cairn {
namespace {

/// `values` different values of a byte: few make ties.
Descriptors random_descriptors(Norm norm, std::size_t bytes, std::size_t count, std::uint32_t values,
                               std::uint64_t seed) {
  Random random(seed);
  Descriptors descriptors(norm, bytes, count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t b = 0; b < (values < 256 ? 2 : bytes); ++b)
      descriptors.row(i)[b] = static_cast<std::uint8_t>(random.index(values));
  return descriptors;
}

cv::Mat to_opencv(const Descriptors& descriptors) {
  cv::Mat bytes(static_cast<int>(descriptors.count()), static_cast<int>(descriptors.bytes()), CV_8U), result;
  for (int i = 0; i < bytes.rows; ++i)
    std::copy_n(descriptors.row(static_cast<std::size_t>(i)), descriptors.bytes(), bytes.ptr(i));
  bytes.convertTo(result, descriptors.norm() == Norm::l2 ? CV_32F : CV_8U);
  return result;
}

cv::BFMatcher matcher(Norm norm, bool mutual) {
  return cv::BFMatcher(norm == Norm::l2 ? cv::NORM_L2 : cv::NORM_HAMMING, mutual);
}

Match from_opencv(const cv::DMatch& match) {
  return {match.queryIdx, match.trainIdx, match.distance};
}

class MatchBesideOpencv : public testing::TestWithParam<std::tuple<Norm, std::uint32_t>> {
 protected:
  Norm norm_ = std::get<0>(GetParam());
  Descriptors query_ =
      random_descriptors(norm_, norm_ == Norm::l2 ? 128 : 32, 300, std::get<1>(GetParam()), 1);
  Descriptors train_ =
      random_descriptors(norm_, norm_ == Norm::l2 ? 128 : 32, 250, std::get<1>(GetParam()), 2);

  [[nodiscard]] std::vector<Match> by_opencv(bool mutual) const {
    std::vector<cv::DMatch> found;
    matcher(norm_, mutual).match(to_opencv(query_), to_opencv(train_), found);
    std::vector<Match> matches;
    for (const cv::DMatch& match : found) matches.push_back(from_opencv(match));
    return matches;
  }
};

TEST_P(MatchBesideOpencv, nearest_are_identical) {
  EXPECT_EQ(match_descriptors(query_, train_, {}), by_opencv(false));
}

TEST_P(MatchBesideOpencv, mutual_are_identical) {
  EXPECT_EQ(match_mutual(query_, train_), by_opencv(true));
}

TEST_P(MatchBesideOpencv, two_nearest_are_identical) {
  std::vector<std::vector<cv::DMatch>> found;
  matcher(norm_, false).knnMatch(to_opencv(query_), to_opencv(train_), found, 2);
  std::vector<std::array<Match, 2>> expected;
  for (const auto& two : found) expected.push_back({from_opencv(two.at(0)), from_opencv(two.at(1))});
  EXPECT_EQ(match_two_nearest(query_, train_), expected);
}

INSTANTIATE_TEST_SUITE_P(, MatchBesideOpencv,
                         testing::Combine(testing::Values(Norm::hamming, Norm::l2),
                                          testing::Values(4U, 256U)),
                         [](const auto& param) {
                           return std::string(std::get<0>(param.param) == Norm::l2 ? "l2" : "hamming") +
                                  (std::get<1>(param.param) < 256 ? "_tied" : "");
                         });

}  // namespace
}  // namespace cairn
