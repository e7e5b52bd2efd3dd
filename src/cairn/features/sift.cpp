// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/sift.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <mutex>

#include "cairn/core/error.h"
#include "cairn/features/sift_descriptor.h"
#include "cairn/features/sift_orientation.h"
#include "cairn/features/sift_patch.h"
#include "cairn/features/sift_scale_space.h"
#include "cairn/features/uniform_selection.h"

namespace cairn {
namespace {

constexpr double kReach = 8;        // sigmas: most of a descriptor's patch, which is turned
constexpr std::size_t kGrain = 32;  // points that one thread works on at a time

struct Described {
  Keypoint keypoint;
  std::array<std::uint8_t, kSiftDescriptorBytes> descriptor{};
};

/// Scale spaces between their uses: to take fresh memory from the system costs as much time as to fill it.
class ScaleSpacePool {
 public:
  explicit ScaleSpacePool(int layers) : layers_(layers) {}

  std::unique_ptr<ScaleSpace> take(int width, int height) {
    const std::lock_guard lock(mutex_);
    const auto fits = [&](const auto& space) { return space->width() == width && space->height() == height; };
    const auto found = std::find_if(idle_.begin(), idle_.end(), fits);
    if (found == idle_.end()) {
      idle_.clear();  // of other sizes: the images have changed
      return std::make_unique<ScaleSpace>(width, height, layers_);
    }
    std::unique_ptr<ScaleSpace> space = std::move(*found);
    idle_.erase(found);
    return space;
  }

  void give_back(std::unique_ptr<ScaleSpace> space) {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(space));
  }

 private:
  int layers_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<ScaleSpace>> idle_;
};

Keypoint keypoint_of(const ScaleSpace& space, const ScalePoint& point, float angle_deg) {
  const double pixel = ScaleSpace::pixel_size(point.octave);
  const double sigma = pixel * space.sigma(static_cast<double>(point.level));
  return {static_cast<float>(pixel * static_cast<double>(point.x)),
          static_cast<float>(pixel * static_cast<double>(point.y)),
          static_cast<float>(4 * kSiftCellSigmas * sigma),
          angle_deg,
          point.response,
          static_cast<float>(std::max(1.0, sigma / kSiftSigma))};
}

/// Selects the strongest points, evenly over the image; they come strongest first.
std::vector<ScalePoint> select_points(const ScaleSpace& space, const std::vector<ScalePoint>& points,
                                      std::size_t count) {
  std::vector<PixelPosition> places;
  for (const ScalePoint& point : points) {
    const auto pixel = static_cast<float>(ScaleSpace::pixel_size(point.octave));
    places.push_back({pixel * point.x, pixel * point.y});
  }
  std::vector<ScalePoint> selected;
  for (const std::size_t i : select_uniform(places, space.width(), space.height(), count))
    selected.push_back(points[i]);
  return selected;
}

/// Selects the strongest features, evenly over the image: points with several directions may have given more
/// than wanted.
Features select_features(const ScaleSpace& space, const std::vector<Described>& described,
                         std::size_t count) {
  std::vector<PixelPosition> places;
  for (const Described& feature : described) places.push_back({feature.keypoint.u, feature.keypoint.v});
  const auto selected = select_uniform(places, space.width(), space.height(), count);
  Features features{{}, Descriptors(Norm::l2, kSiftDescriptorBytes, selected.size())};
  for (const std::size_t i : selected) {
    const auto& descriptor = described[i].descriptor;
    std::copy(descriptor.begin(), descriptor.end(), features.descriptors.row(features.keypoints.size()));
    features.keypoints.push_back(described[i].keypoint);
  }
  return features;
}

class SiftExtractor : public Extractor {
 public:
  explicit SiftExtractor(const SiftOptions& options) : options_(options), pool_(options.layers) {}

  [[nodiscard]] Features extract(const GrayImage& image, const Executor& executor) const override {
    std::unique_ptr<ScaleSpace> space = pool_.take(image.width(), image.height());
    space->build(image, executor);
    const auto count = static_cast<std::size_t>(options_.count);
    const auto points = select_points(*space, find_sift_extrema(*space, options_.extrema, executor), count);
    Features features = select_features(*space, describe(*space, points, executor), count);
    pool_.give_back(std::move(space));
    return features;
  }

 private:
  /// A feature for each direction of each point. Directions and descriptors are of the same pixels, so one
  /// follows the other while these are in the cache.
  [[nodiscard]] std::vector<Described> describe(const ScaleSpace& space,
                                                const std::vector<ScalePoint>& points,
                                                const Executor& executor) const {
    std::vector<std::vector<Described>> chunks((points.size() + kGrain - 1) / kGrain);
    executor.for_each_chunk(points.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (i + 1 < end) prefetch_patch(space, points[i + 1], kReach);
        for (const float angle_deg : sift_orientations(space, points[i])) {
          Described& feature = chunks[begin / kGrain].emplace_back();
          feature.keypoint = keypoint_of(space, points[i], angle_deg);
          describe_sift(space, points[i], angle_deg, options_.root, feature.descriptor.data());
        }
      }
    });
    std::vector<Described> described;
    for (const auto& chunk : chunks) described.insert(described.end(), chunk.begin(), chunk.end());
    return described;
  }

  SiftOptions options_;
  mutable ScaleSpacePool pool_;
};

}  // namespace

void SiftOptions::validate() const {
  const auto check = [](const char* option, bool good, const char* expected, double found) {
    if (!good)
      throw InputError({option, 0, expected, fmt::format("{}", found), "See the defaults in SiftOptions."});
  };
  constexpr int kMostLayers = 10;
  check("count", count >= 1, "at least 1 feature per image", count);
  check("layers", layers >= 1 && layers <= kMostLayers, "1 to 10 layers per octave", layers);
  check("contrast", extrema.contrast > 0, "a contrast above 0", extrema.contrast);
  check("edge_ratio", extrema.edge_ratio >= 1, "a ratio of at least 1", extrema.edge_ratio);
}

std::unique_ptr<Extractor> make_sift_extractor(const SiftOptions& options) {
  options.validate();
  return std::make_unique<SiftExtractor>(options);
}

}  // namespace cairn
