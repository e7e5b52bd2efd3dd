// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cairn/features/features.h"
#include "cairn/image/image.h"
#include "cairn/matching/matching.h"

namespace cairn {

/// Holds the features of one image and how long they took.
struct TimedFeatures {
  std::string path;
  GrayImage image;
  Features features;
  double time_ms = 0;  ///< to find and describe them, decoding not included
};

/// Holds what is told of one image's features.
struct FeatureCounts {
  std::string path;
  int width = 0, height = 0;  ///< pixels
  std::size_t keypoints = 0, descriptor_bytes = 0;
  double time_ms = 0;
};

/// Counts the features of an image.
[[nodiscard]] FeatureCounts counts_of(const TimedFeatures& timed);

/// Returns a JSON object: the method and each image's counts; `unreadable` images were skipped.
[[nodiscard]] std::string format_features_json(const std::string& method,
                                               std::span<const FeatureCounts> images,
                                               std::int64_t unreadable);
/// Returns a line for each image, and one for those that were skipped if there are any.
[[nodiscard]] std::string format_features_text(std::span<const FeatureCounts> images,
                                               std::int64_t unreadable);
/// Returns a line of names, then one row for each keypoint: u,v,size,angle_deg,response; pixels and degrees.
[[nodiscard]] std::string format_keypoints_csv(std::span<const Keypoint> keypoints);

/// Holds two images and the matches between them.
struct MatchReport {
  std::string method;
  const TimedFeatures& a;
  const TimedFeatures& b;
  std::span<const Match> matches;
  double time_ms = 0;  ///< of the matching
};

/// Returns a JSON object with the counts and times of a match.
[[nodiscard]] std::string format_match_json(const MatchReport& report);
/// Returns the counts and times of a match, a line for each image and one for the matches.
[[nodiscard]] std::string format_match_text(const MatchReport& report);
/// Returns a line of names, then one row for each match: u1,v1,u2,v2,distance; pixels.
[[nodiscard]] std::string format_matches_csv(const MatchReport& report);

}  // namespace cairn
