// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "cairn/localize/localizer.h"
#include "cairn/testing/localize/street_world.h"
#include "localization.h"

namespace cairn::bench {
namespace {

namespace fs = std::filesystem;

/// A simulated street, a map of it and images to be found there. The map is written when it is first used:
/// that takes seconds, which a run that asks for other rows need not spend.
class LazyMap {
 public:
  explicit LazyMap(double length) : length_(length) {}
  ~LazyMap() {
    std::error_code ignored;
    if (world_) fs::remove_all(folder_, ignored);
  }
  LazyMap(const LazyMap&) = delete;
  LazyMap& operator=(const LazyMap&) = delete;

  void open() {
    write();
    const StoredMap map(folder_);
  }

  /// An image after the other, again and again.
  void find_next_image() {
    write();
    if (!localizer_) open_for_queries();
    (void)localizer_->localize(images_[next_++ % images_.size()].frame);
  }

 private:
  void write() {
    if (world_) return;
    testkit::StreetWorld::Options street;
    street.length = length_;
    street.points = static_cast<std::size_t>(50 * length_);
    street.keyframes = static_cast<int>(length_ / 3);
    street.features = 800;
    world_.emplace(street);
    const std::string name = "cairn_bench_" + std::to_string(::getpid()) + "_";
    folder_ = fs::temp_directory_path() / (name + std::to_string(static_cast<int>(length_)));
    world_->write_map(folder_);
  }

  void open_for_queries() {
    constexpr std::uint64_t kImages = 60;
    map_ = std::make_unique<StoredMap>(folder_);
    localizer_.emplace(*map_, testkit::street_query_camera(), LocalizeOptions());
    for (std::uint64_t i = 0; i < kImages; ++i) {
      const double x = 5 + (length_ - 20) * static_cast<double>(i) / static_cast<double>(kImages);
      images_.push_back(world_->see(testkit::StreetWorld::pose_at(x, 0.2, 0.03), 1'000'000 + i, true, 1000));
    }
  }

  double length_;  // metres of street
  fs::path folder_;
  std::optional<testkit::StreetWorld> world_;
  std::unique_ptr<StoredMap> map_;
  std::optional<Localizer> localizer_;
  std::vector<testkit::StreetWorld::View> images_;
  std::size_t next_ = 0;
};

}  // namespace

void add_map_queries(Comparisons& comparisons) {
  constexpr double kShort = 200, kLong = 20'500, kOpenMs = 200, kAtMostShare = 2;
  const auto small = std::make_shared<LazyMap>(kShort), large = std::make_shared<LazyMap>(kLong);
  comparisons.timed.push_back(
      {"a map of a million landmarks opened", 1, [=] { large->open(); }, {}, {}, kOpenMs});
  comparisons.timed.push_back({"an image found among a million landmarks, beside among ten thousand",
                               1,
                               [=] { large->find_next_image(); },
                               [=] { small->find_next_image(); },
                               kAtMostShare,
                               {}});
}

}  // namespace cairn::bench
