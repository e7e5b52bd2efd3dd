// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/extractor.h"

#include <fmt/format.h>

#include <algorithm>

#include "cairn/core/error.h"
#include "cairn/core/suggestion.h"
#include "cairn/features/opencv_extractor.h"
#include "cairn/features/orb.h"
#include "cairn/features/sift.h"

namespace cairn {
namespace {

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

bool is_own(const std::string& upper_name) {
  return upper_name == "ORB" || upper_name == "SIFT" || upper_name == "ROOTSIFT";
}

void check_name(const std::string& option, const std::string& name, const std::vector<std::string>& known) {
  if (std::find(known.begin(), known.end(), upper(name)) != known.end()) return;
  throw InputError({option, 0, fmt::format("one of {}", fmt::join(known, ", ")), fmt::format("'{}'", name),
                    suggestion(upper(name), known, "Choose one of these.")});
}

/// AKAZE describes only its own keypoints, ORB needs levels that SIFT's octaves are not, and ours describe
/// what they detect.
bool fit_together(const std::string& detector, const std::string& descriptor) {
  if (detector == descriptor || (detector == "SIFT" && descriptor == "ROOTSIFT")) return true;
  if (is_own(detector) || is_own(descriptor) || descriptor == "AKAZE") return false;
  return !(detector == "OPENCV_SIFT" && descriptor == "OPENCV_ORB");
}

}  // namespace

const std::vector<std::string>& detector_names() {
  static const std::vector<std::string> kNames{"ORB", "SIFT", "OPENCV_ORB", "OPENCV_SIFT", "AKAZE", "BRISK"};
  return kNames;
}

const std::vector<std::string>& descriptor_names() {
  static const std::vector<std::string> kNames{"ORB",         "SIFT",  "ROOTSIFT", "OPENCV_ORB",
                                               "OPENCV_SIFT", "AKAZE", "BRISK"};
  return kNames;
}

void visit(FeatureOptions& options, ParameterVisitor& visitor) {
  visitor.parameter({"detector", any("a name"),
                     "ORB and SIFT are cairn's own and describe only what they detect; OPENCV_ORB, "
                     "OPENCV_SIFT, AKAZE and BRISK are OpenCV's and mix if they fit together."},
                    options.detector);
  visitor.parameter({"descriptor", any("a name"),
                     "The same names, and ROOTSIFT, which describes the features of the detector SIFT."},
                    options.descriptor);
  visitor.parameter({"features", at_least(1, "feature per image"), "Most features taken of an image.",
                     "number_of_features"},
                    options.count);
  visitor.parameter(
      {"contrast", above(0, "a share of the grey range"),
       "Weakest feature that the detector SIFT takes; less gives more features of dim texture."},
      options.contrast);
}

void FeatureOptions::validate() const {
  check_name("detector", detector, detector_names());
  check_name("descriptor", descriptor, descriptor_names());
  if (!fit_together(upper(detector), upper(descriptor))) {
    throw InputError(
        {"descriptor", 0, fmt::format("a descriptor that can describe {} keypoints", upper(detector)),
         fmt::format("'{}'", descriptor), fmt::format("Set descriptor to {}.", upper(detector))});
  }
  check_ranges(*this);
}

std::unique_ptr<Extractor> make_extractor(const FeatureOptions& options) {
  options.validate();
  FeatureOptions named = options;
  named.detector = upper(options.detector);
  named.descriptor = upper(options.descriptor);
  if (named.detector == "ORB") {
    OrbOptions orb;
    orb.count = options.count;
    return make_orb_extractor(orb);
  }
  if (named.detector == "SIFT") {
    SiftOptions sift;
    sift.count = options.count;
    sift.extrema.contrast = options.contrast;
    sift.root = named.descriptor == "ROOTSIFT";
    return make_sift_extractor(sift);
  }
  return make_opencv_extractor(named);
}

}  // namespace cairn
