// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/opencv_extractor.h"

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>

namespace cairn {
namespace {

constexpr float kOrbPatch = 31.0F;  // pixels, diameter at the lowest pyramid level
constexpr int kFastThreshold = 7;   // grey levels: dim corners count, too, where there are no better ones
constexpr int kSmallestSide = 32;   // pixels: no patch fits below, and OpenCV's pyramids throw
constexpr double kOrbScale = 1.2;   // between pyramid levels

/// OpenCV's objects keep state while they work, so each extraction makes its own: microseconds beside
/// milliseconds.
cv::Ptr<cv::Feature2D> make_opencv(const std::string& name, int count) {
  if (name == "OPENCV_ORB")
    return cv::ORB::create(count, static_cast<float>(kOrbScale), 8, static_cast<int>(kOrbPatch), 0, 2,
                           cv::ORB::HARRIS_SCORE, static_cast<int>(kOrbPatch), kFastThreshold);
  if (name == "OPENCV_SIFT") return cv::SIFT::create(count);
  if (name == "AKAZE") return cv::AKAZE::create();
  return cv::BRISK::create();
}

void keep_strongest(std::vector<cv::KeyPoint>& keypoints, int count) {
  if (keypoints.size() <= static_cast<std::size_t>(count)) return;
  std::stable_sort(keypoints.begin(), keypoints.end(),
                   [](const auto& a, const auto& b) { return a.response > b.response; });
  keypoints.resize(static_cast<std::size_t>(count));
}

Keypoint from_opencv(const cv::KeyPoint& k, bool orb) {
  return {k.pt.x, k.pt.y, k.size, k.angle, k.response, orb ? std::max(1.0F, k.size / kOrbPatch) : 1.0F};
}

Descriptors from_opencv(const cv::Mat& rows) {
  const bool floats = rows.type() == CV_32F;  // SIFT: integers from 0 to 255 held in floats
  Descriptors descriptors(floats ? Norm::l2 : Norm::hamming, static_cast<std::size_t>(rows.cols),
                          static_cast<std::size_t>(rows.rows));
  for (int i = 0; i < rows.rows; ++i) {
    std::uint8_t* out = descriptors.row(static_cast<std::size_t>(i));
    for (int j = 0; j < rows.cols; ++j) {
      out[j] = floats ? static_cast<std::uint8_t>(std::clamp(rows.at<float>(i, j), 0.0F, 255.0F))
                      : rows.at<std::uint8_t>(i, j);
    }
  }
  return descriptors;
}

class OpencvExtractor : public Extractor {
 public:
  explicit OpencvExtractor(const FeatureOptions& options)
      : detector_(options.detector), descriptor_(options.descriptor), count_(options.count) {
    cv::setNumThreads(0);  // frames are worked on side by side; threads within one would only compete
  }

  [[nodiscard]] Features extract(const GrayImage& image, const Executor& /*executor*/) const override {
    if (image.width() < kSmallestSide || image.height() < kSmallestSide) return {};
    // OpenCV takes no const pixels; it does not write to its input.
    const cv::Mat mat(image.height(), image.width(), CV_8UC1, const_cast<std::uint8_t*>(image.data()));
    std::vector<cv::KeyPoint> keypoints;
    cv::Mat rows;
    const auto detector = make_opencv(detector_, count_);
    if (detector_ == descriptor_ && limits_itself()) {
      detector->detectAndCompute(mat, cv::noArray(), keypoints, rows);
    } else {
      detector->detect(mat, keypoints);
      keep_strongest(keypoints, count_);
      (detector_ == descriptor_ ? detector : make_opencv(descriptor_, count_))->compute(mat, keypoints, rows);
    }
    Features features;
    for (const cv::KeyPoint& keypoint : keypoints)
      features.keypoints.push_back(from_opencv(keypoint, detector_ == "OPENCV_ORB"));
    features.descriptors = from_opencv(rows);
    return features;
  }

 private:
  [[nodiscard]] bool limits_itself() const { return detector_ == "OPENCV_ORB" || detector_ == "OPENCV_SIFT"; }

  std::string detector_, descriptor_;
  int count_;
};

}  // namespace

std::unique_ptr<Extractor> make_opencv_extractor(const FeatureOptions& options) {
  return std::make_unique<OpencvExtractor>(options);
}

}  // namespace cairn
