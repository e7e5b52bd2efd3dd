// SPDX-License-Identifier: Apache-2.0
#include "cairn/localize/retrieval.h"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

/// Collects the keyframes that show something which looks like one descriptor, each once.
class Voters {
 public:
  explicit Voters(std::size_t keyframes) : last_(keyframes, -1) {}

  [[nodiscard]] const std::vector<std::int32_t>& of(const StoredMap& map, std::int32_t query,
                                                    const PlaceFile::Neighbours& neighbours) {
    constexpr std::size_t kMostNeighbours = 16;  // a texture that is everywhere says nothing of the place
    voters_.clear();
    for (std::size_t i = 0; i < std::min(neighbours.size(), kMostNeighbours); ++i) {
      const StoredLandmark landmark = map.landmark({static_cast<std::int32_t>(neighbours[i].landmark)});
      for (const std::int32_t keyframe : map.places().keyframes(landmark.first_row, landmark.observations)) {
        std::int32_t& last = last_[static_cast<std::size_t>(keyframe)];
        if (last == query) continue;
        last = query;
        voters_.push_back(keyframe);
      }
    }
    return voters_;
  }

 private:
  std::vector<std::int32_t> last_;  // descriptor that each keyframe was a voter of
  std::vector<std::int32_t> voters_;
};

}  // namespace

std::vector<PlaceCandidate> find_places(const StoredMap& map, const Descriptors& descriptors,
                                        std::size_t most) {
  constexpr double kMaxDistanceShare = 0.45;  // as PlaceIndexOptions
  constexpr std::size_t kLeaves = 2;
  const auto found = map.places().find(descriptors, kMaxDistanceShare, kLeaves);
  const std::size_t documents = map.poses().size();
  std::vector<double> scores(documents, 0.0);
  Voters voters(documents);
  double total = 0;
  for (std::size_t query = 0; query < found.size(); ++query) {
    const auto& of_query = voters.of(map, static_cast<std::int32_t>(query), found[query]);
    const auto frequency = static_cast<double>(std::max<std::size_t>(1, of_query.size()));
    const double weight = std::log(static_cast<double>(documents + 1) / frequency);
    total += weight;
    for (const std::int32_t keyframe : of_query) scores[static_cast<std::size_t>(keyframe)] += weight;
  }
  std::vector<PlaceCandidate> candidates;
  for (std::size_t i = 0; i < documents; ++i)
    if (scores[i] > 0) scores[i] /= std::sqrt(static_cast<double>(map.places().shown_landmarks()[i]));
  for (std::size_t i = 0; i < documents; ++i)
    if (scores[i] > 0 && map.in_main_component({static_cast<std::int32_t>(i)}))
      candidates.push_back({static_cast<std::int32_t>(i), scores[i] / total});
  const auto kept = static_cast<std::ptrdiff_t>(std::min(most, candidates.size()));
  std::partial_sort(candidates.begin(), candidates.begin() + kept, candidates.end(),
                    [](const PlaceCandidate& a, const PlaceCandidate& b) {
                      return a.score != b.score ? a.score > b.score : a.id < b.id;
                    });
  candidates.resize(static_cast<std::size_t>(kept));
  return candidates;
}

std::vector<KeyframeId> keyframes_near(const StoredMap& map, const WorldFromCamera& world_from_camera,
                                       std::size_t most) {
  constexpr double kMinAxisCosine = 0.5;  // 60 degrees: descriptors rarely survive more
  struct Near {
    double squared_distance;
    std::int32_t keyframe;
    bool operator<(const Near& other) const {
      return squared_distance != other.squared_distance ? squared_distance < other.squared_distance
                                                        : keyframe < other.keyframe;
    }
  };
  const auto axis_of = [](const WorldFromCamera& pose) -> Eigen::Vector3d {
    return pose.rotation * Eigen::Vector3d::UnitZ();
  };
  std::vector<Near> near;
  for (std::size_t i = 0; i < map.poses().size(); ++i) {
    const WorldFromCamera& pose = map.poses()[i];
    const double cosine = axis_of(pose).dot(axis_of(world_from_camera));
    if (cosine < kMinAxisCosine || !map.in_main_component({static_cast<std::int32_t>(i)})) continue;
    const double squared = (pose.translation - world_from_camera.translation).squaredNorm();
    near.push_back({squared / (cosine * cosine), static_cast<std::int32_t>(i)});
  }
  const auto kept = static_cast<std::ptrdiff_t>(std::min(most, near.size()));
  std::partial_sort(near.begin(), near.begin() + kept, near.end());
  std::vector<KeyframeId> ids;
  for (std::ptrdiff_t i = 0; i < kept; ++i) ids.push_back({near[static_cast<std::size_t>(i)].keyframe});
  return ids;
}

}  // namespace cairn
