// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/orb.h"

#include <fmt/format.h>

#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>

#include "cairn/features/extractor.h"
#include "cairn/features/fast.h"
#include "features.h"
#include "matched_geometry.h"

namespace cairn::bench {
namespace {

constexpr int kCount = 1000;

std::shared_ptr<const Extractor> extractor(const std::string& name) {
  return make_extractor({name, name, kCount});
}

/// OpenCV's threads for the time of one call; its extractor otherwise runs on one.
void with_threads(int threads, const Work& work) {
  cv::setNumThreads(threads);
  work();
  cv::setNumThreads(0);
}

/// Angle and descriptor of given keypoints; OpenCV's ORB describes the same ones, at given angles.
void add_description(Comparisons& comparisons, const Inputs& inputs) {
  constexpr std::size_t kGiven = 638;
  FastOptions fast;
  fast.border = 32;
  std::vector<Corner> corners = detect_fast(inputs.vga, fast);
  std::vector<Keypoint> keypoints;
  std::vector<cv::KeyPoint> given;
  for (std::size_t i = 0; i < kGiven && i < corners.size(); ++i) {
    const Corner& corner = corners[i * corners.size() / kGiven];
    keypoints.push_back({static_cast<float>(corner.u), static_cast<float>(corner.v)});
    given.emplace_back(keypoints.back().u, keypoints.back().v, 31.0F, 0.0F, 1.0F, 0);
  }
  const auto opencv = [given, &inputs] {
    const GrayImage& image = inputs.vga;
    const cv::Mat mat(image.height(), image.width(), CV_8UC1, const_cast<std::uint8_t*>(image.data()));
    cv::Mat rows;
    auto keypoints_of_call = given;
    cv::ORB::create()->compute(mat, keypoints_of_call, rows);
  };
  comparisons.timed.push_back({fmt::format("angle and descriptor of {} keypoints", keypoints.size()),
                               1,
                               [keypoints, &inputs] { (void)describe_orb(inputs.vga, keypoints); },
                               opencv,
                               {},
                               0.3});
}

}  // namespace

void add_orb(Comparisons& comparisons, const Inputs& inputs) {
  const auto ours = extractor("ORB");
  const auto peers = extractor("OPENCV_ORB");
  comparisons.timed.push_back({"ORB 1000, 640x480",
                               1,
                               [=, &inputs] { (void)ours->extract(inputs.vga); },
                               [=, &inputs] { (void)peers->extract(inputs.vga); },
                               1.0 / 3,
                               {}});
  const auto two = std::make_shared<const Executor>(2);
  comparisons.timed.push_back({"ORB 1000, 640x480",
                               2,
                               [=, &inputs] { (void)ours->extract(inputs.vga, *two); },
                               [=, &inputs] { with_threads(2, [&] { (void)peers->extract(inputs.vga); }); },
                               {},
                               {}});
  add_description(comparisons, inputs);
  add_correct_matches(comparisons, "ORB 1000", *ours, *peers, inputs.pairs, 1.0);
}

}  // namespace cairn::bench
