// SPDX-License-Identifier: Apache-2.0
// Every detector and matcher on images that the input describes: any size, any contents. Whatever comes,
// there is a result whose parts fit together.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "cairn/core/random.h"
#include "cairn/features/extractor.h"
#include "cairn/features/orb.h"
#include "cairn/matching/guided_matching.h"
#include "cairn/matching/matching.h"
#include "cairn/matching/stereo_matching.h"

namespace cairn {
namespace {

/// Takes numbers from the front of the input; zeros when it is used up.
class Input {
 public:
  Input(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  int below(int count) {
    const int value = next() * 256 + next();
    return value % count;
  }
  double between(double low, double high) { return low + (high - low) * below(65536) / 65535.0; }
  int next() {
    if (size_ == 0) return 0;
    --size_;
    return *data_++;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
};

void check(bool holds) {
  if (!holds) std::abort();
}

std::uint8_t level_of(int kind, int u, int v, int parameter, Random& random) {
  switch (kind) {
    case 0:
      return static_cast<std::uint8_t>(parameter);
    case 1:
      return static_cast<std::uint8_t>(random.index(256));
    case 2:  // a board
      return (u / (1 + parameter % 17) + v / (1 + parameter % 13)) % 2 == 0 ? 255 : 0;
    case 3:
      return static_cast<std::uint8_t>(u * parameter + v);
    default:  // blobs
      return static_cast<std::uint8_t>(127 + 120 * std::sin(u * parameter * 0.01) *
                                                 std::cos(v * parameter * 0.013));
  }
}

GrayImage image_of(Input& input) {
  constexpr int kKinds = 5, kLargest = 160;
  const int largest = input.below(2) == 0 ? kLargest : 48;
  GrayImage image(input.below(largest), input.below(largest));
  const int kind = input.below(kKinds), parameter = input.next();
  Random random(static_cast<std::uint64_t>(input.next()));
  for (int v = 0; v < image.height(); ++v)
    for (int u = 0; u < image.width(); ++u) image(u, v) = level_of(kind, u, v, parameter, random);
  for (int scratches = input.below(20); scratches > 0 && !image.empty(); --scratches)
    image(input.below(image.width()), input.below(image.height())) = static_cast<std::uint8_t>(input.next());
  return image;
}

void check_features(const Features& features, const GrayImage& image, int count) {
  check(features.keypoints.size() == features.descriptors.count());
  check(features.keypoints.size() <= static_cast<std::size_t>(count));
  for (const Keypoint& k : features.keypoints) {
    check(k.u >= -0.5F && k.v >= -0.5F && k.u <= static_cast<float>(image.width()) - 0.5F &&
          k.v <= static_cast<float>(image.height()) - 0.5F);
    check(k.size > 0 && std::isfinite(k.size) && k.sigma_px > 0 && std::isfinite(k.response));
    check(k.angle_deg == -1 || (k.angle_deg >= 0 && k.angle_deg < 360));
  }
}

void check_matches(const std::vector<Match>& matches, std::size_t queries, std::size_t trains) {
  for (const Match& match : matches) {
    check(match.query >= 0 && static_cast<std::size_t>(match.query) < queries);
    check(match.train >= 0 && static_cast<std::size_t>(match.train) < trains);
    check(std::isfinite(match.distance) && match.distance >= 0);
  }
}

MatchOptions options_of(Input& input) {
  MatchOptions options;
  if (input.below(2) == 1) options.max_ratio = input.between(0, 1);
  if (input.below(2) == 1) options.max_distance = input.between(0, 300);
  options.mutual = input.below(2) == 1;
  return options;
}

void match_by_brute_force(const Features& a, const Features& b, Input& input) {
  check_matches(match_descriptors(a.descriptors, b.descriptors, options_of(input)), a.keypoints.size(),
                b.keypoints.size());
  check(match_two_nearest(a.descriptors, b.descriptors).size() == a.keypoints.size() || b.keypoints.empty());
  check_matches(match_mutual(a.descriptors, b.descriptors), a.keypoints.size(), b.keypoints.size());
}

void match_in_windows(const Features& a, const Features& b, Input& input) {
  std::vector<SearchWindow> places(a.keypoints.size());
  for (SearchWindow& place : places)
    place = {input.between(-100, 300), input.between(-100, 300), input.between(0, 100), 0,
             input.between(0, 300)};
  check_matches(match_predicted(places, a.descriptors, b, options_of(input)), places.size(),
                b.keypoints.size());
}

void match_left_right(const GrayImage& image, const Features& features, const GrayImage& other,
                      const Features& other_features, Input& input) {
  const bool fits = other.width() == image.width() && other.height() == image.height();
  const GrayImage& right = fits ? other : image;
  const Features& right_features = fits ? other_features : features;
  const Rig rig{input.between(1, 500), input.between(1, 500), 80, 80, input.between(0.001, 2)};
  StereoMatchOptions options;
  options.min_depth = input.between(0.01, 5);
  for (const auto& match : match_stereo(rig, {features, image}, {right_features, right}, options)) {
    if (!match) continue;
    check(match->right >= 0 && static_cast<std::size_t>(match->right) < right_features.keypoints.size());
    check(std::isfinite(match->disparity) && match->disparity > 0 &&
          std::isfinite(match->sigma_disparity_px));
  }
}

void fuzz(Input input) {
  const std::vector<std::string>& names = detector_names();
  const std::string& name = names[static_cast<std::size_t>(input.below(static_cast<int>(names.size())))];
  const int count = input.below(3) == 0 ? 100'000 : 1 + input.below(300);
  const auto extractor = make_extractor({name, name, count});
  const GrayImage first = image_of(input), second = image_of(input);
  const Features a = extractor->extract(first), b = extractor->extract(second);
  if (name == "ORB" || name == "SIFT") {  // the others keep no such promise
    check_features(a, first, count);
    check_features(b, second, count);
  }
  check(describe_orb(second, a.keypoints).angles_deg.size() == a.keypoints.size());
  if (a.keypoints.size() > 3000 || b.keypoints.size() > 3000) return;  // time
  match_by_brute_force(a, b, input);
  match_in_windows(a, b, input);
  match_left_right(first, a, second, b, input);
}

}  // namespace
}  // namespace cairn

// libFuzzer's name, NOLINTNEXTLINE(readability-identifier-naming)
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  cairn::fuzz({data, size});
  return 0;
}
