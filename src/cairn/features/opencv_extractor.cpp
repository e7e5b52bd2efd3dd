// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>

#include "cairn/core/error.h"
#include "cairn/core/text.h"
#include "cairn/features/extractor.h"

namespace cairn {
namespace {

constexpr float kOrbPatch = 31.0F;  // pixels, diameter at the lowest pyramid level
constexpr int kFastThreshold = 7;   // grey levels: dim corners count, too, where there are no better ones
constexpr int kSmallestSide = 32;   // pixels: no patch fits below, and OpenCV's pyramids throw
constexpr double kOrbScale = 1.2;   // between pyramid levels

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

/// OpenCV's objects keep state while they work, so each extraction makes its own: microseconds beside
/// milliseconds.
cv::Ptr<cv::Feature2D> make_opencv(const std::string& name, int count) {
  if (name == "ORB")
    return cv::ORB::create(count, static_cast<float>(kOrbScale), 8, static_cast<int>(kOrbPatch), 0, 2,
                           cv::ORB::HARRIS_SCORE, static_cast<int>(kOrbPatch), kFastThreshold);
  if (name == "SIFT") return cv::SIFT::create(count);
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
      : detector_(upper(options.detector)), descriptor_(upper(options.descriptor)), count_(options.count) {
    cv::setNumThreads(0);  // frames are worked on side by side; threads within one would only compete
  }

  [[nodiscard]] Features extract(const GrayImage& image) const override {
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
      features.keypoints.push_back(from_opencv(keypoint, detector_ == "ORB"));
    features.descriptors = from_opencv(rows);
    return features;
  }

 private:
  [[nodiscard]] bool limits_itself() const { return detector_ == "ORB" || detector_ == "SIFT"; }

  std::string detector_, descriptor_;
  int count_;
};

void check_name(const std::string& option, const std::string& name, const std::vector<std::string>& known) {
  if (std::find(known.begin(), known.end(), upper(name)) != known.end()) return;
  throw InputError({option, 0, fmt::format("one of {}", fmt::join(known, ", ")), fmt::format("'{}'", name),
                    fmt::format("Did you mean '{}'?", nearest_name(upper(name), known))});
}

}  // namespace

const std::vector<std::string>& detector_names() {
  static const std::vector<std::string> kNames{"ORB", "SIFT", "AKAZE", "BRISK"};
  return kNames;
}

const std::vector<std::string>& descriptor_names() {
  return detector_names();
}

void FeatureOptions::validate() const {
  check_name("detector", detector, detector_names());
  check_name("descriptor", descriptor, descriptor_names());
  const bool akaze_alone = upper(descriptor) == "AKAZE" && upper(detector) != "AKAZE";
  const bool sift_octaves = upper(detector) == "SIFT" && upper(descriptor) == "ORB";
  if (akaze_alone || sift_octaves) {
    throw InputError(
        {"descriptor", 0, fmt::format("a descriptor that can describe {} keypoints", upper(detector)),
         fmt::format("'{}'", descriptor), fmt::format("Set descriptor to {}.", upper(detector))});
  }
  if (count < 1)
    throw InputError(
        {"features", 0, "at least 1 feature per image", fmt::format("{}", count), "The default is 1000."});
}

std::unique_ptr<Extractor> make_extractor(const FeatureOptions& options) {
  options.validate();
  return std::make_unique<OpencvExtractor>(options);
}

}  // namespace cairn
