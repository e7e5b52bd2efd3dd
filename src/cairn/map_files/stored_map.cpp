// SPDX-License-Identifier: Apache-2.0
#include "cairn/map_files/stored_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <mutex>

#include "cairn/core/error.h"
#include "cairn/map_files/frame_file.h"
#include "cairn/map_files/held_out_file.h"
#include "cairn/map_files/map_file.h"
#include "cairn/map_files/map_text_files.h"

namespace cairn {
namespace {

StoredKeyframe stored_keyframe(const FrameFile& file, const WorldFromCamera& world_from_camera) {
  StoredKeyframe view{world_from_camera, {}, {}, {}};
  const auto& [keypoints, descriptors] = file.observed.features;
  const auto count = static_cast<std::size_t>(
      std::count_if(file.landmarks.begin(), file.landmarks.end(), [](LandmarkId id) { return id.valid(); }));
  view.descriptors = Descriptors(descriptors.norm(), descriptors.bytes(), count);
  for (std::size_t i = 0; i < file.landmarks.size(); ++i) {
    if (!file.landmarks[i].valid()) continue;
    std::memcpy(view.descriptors.row(view.landmarks.size()), descriptors.row(i), descriptors.stride());
    view.landmarks.push_back(file.landmarks[i]);
    view.keypoints.push_back(keypoints[i]);
  }
  return view;
}

/// Returns the component with the most keyframes, the first of several.
std::int32_t main_component_of(const MapInfo& info) {
  std::map<std::int32_t, std::size_t> sizes;
  for (const KeyframeEntry& keyframe : info.keyframes) ++sizes[keyframe.component];
  const auto largest = std::max_element(sizes.begin(), sizes.end(),
                                        [](const auto& a, const auto& b) { return a.second < b.second; });
  return largest->first;
}

}  // namespace

/// Keeps the keyframes used last.
class StoredMap::Cache {
 public:
  using Entry = std::shared_ptr<const StoredKeyframe>;

  [[nodiscard]] Entry find(KeyframeId id) {
    const std::scoped_lock lock(mutex_);
    const auto place =
        std::find_if(entries_.begin(), entries_.end(), [&](const auto& e) { return e.first == id; });
    if (place == entries_.end()) return nullptr;
    std::rotate(entries_.begin(), place, place + 1);
    return entries_.front().second;
  }
  void add(KeyframeId id, const Entry& entry) {
    constexpr std::size_t kMost = 128;  // some 50 MB of SIFT
    const std::scoped_lock lock(mutex_);
    entries_.insert(entries_.begin(), {id, entry});
    if (entries_.size() > kMost) entries_.pop_back();
  }

 private:
  std::mutex mutex_;
  std::vector<std::pair<KeyframeId, Entry>> entries_;  // last used first
};

StoredMap::StoredMap(const std::filesystem::path& folder)
    : folder_(require_map_folder(folder)),
      info_(read_map_info(folder_ / kMapInfoFile)),
      poses_(read_map_poses(folder_, info_)),
      held_out_(read_held_out(folder_, info_)),
      points_(folder_ / kPointFile, kPointKind, info_.checksum_of(kPointFile)),
      places_(folder_, info_),
      main_component_(main_component_of(info_)),
      cache_(std::make_unique<Cache>()) {
  if (points_.size() != kPointBegin + kLandmarkBytes * std::uint64_t{info_.landmarks})
    points_.fail(fmt::format("{} landmarks, as map.json says", info_.landmarks),
                 fmt::format("{} bytes", points_.size()));
  if (!info_.checksum_of(kNoiseFile)) return;
  noise_.emplace(folder_ / kNoiseFile, kNoiseKind, info_.checksum_of(kNoiseFile));
  if (noise_->size() != kNoiseBegin + kNoiseBytes * std::uint64_t{info_.landmarks})
    noise_->fail(fmt::format("{} landmarks, as map.json says", info_.landmarks),
                 fmt::format("{} bytes", noise_->size()));
}

StoredMap::~StoredMap() = default;

bool StoredMap::in_main_component(KeyframeId id) const {
  return info_.keyframes[id.index()].component == main_component_;
}

StoredLandmark StoredMap::landmark(LandmarkId id) const {
  require(id.valid() && static_cast<std::uint32_t>(id.value) < info_.landmarks, "the landmark is in the map");
  const std::uint64_t begin = kPointBegin + kLandmarkBytes * static_cast<std::uint64_t>(id.value);
  StoredLandmark landmark;
  landmark.observations = points_.at<std::uint32_t>(begin + 4);
  landmark.first_row = points_.at<std::uint64_t>(begin + 8);
  std::memcpy(landmark.point_in_world.data(), points_.bytes(begin + 16, 24), 24);
  std::memcpy(landmark.covariance.data(), points_.bytes(begin + 40, 72), 72);
  const bool rows_exist = landmark.first_row <= info_.observations &&
                          landmark.observations <= info_.observations - landmark.first_row;
  if (!rows_exist || !landmark.point_in_world.allFinite() || !is_covariance(landmark.covariance))
    points_.fail(fmt::format("a finite point, a covariance and sightings for landmark {}", id.value),
                 "others");
  return landmark;
}

Eigen::Matrix3d StoredMap::noise_covariance(LandmarkId id) const {
  if (!noise_) return landmark(id).covariance;
  require(id.valid() && static_cast<std::uint32_t>(id.value) < info_.landmarks, "the landmark is in the map");
  std::uint64_t next = kNoiseBegin + kNoiseBytes * static_cast<std::uint64_t>(id.value);
  Eigen::Matrix3d covariance;
  for (Eigen::Index row = 0; row < 3; ++row) {
    for (Eigen::Index column = row; column < 3; ++column, next += sizeof(double))
      covariance(row, column) = covariance(column, row) = noise_->at<double>(next);
  }
  if (!is_covariance(covariance))
    noise_->fail(fmt::format("a covariance of landmark {}", id.value), "another matrix");
  return covariance;
}

std::shared_ptr<const StoredKeyframe> StoredMap::keyframe(KeyframeId id) const {
  require(id.valid() && id.index() < poses_.size(), "the keyframe is in the map");
  if (auto found = cache_->find(id)) return found;
  auto read = std::make_shared<const StoredKeyframe>(
      stored_keyframe(read_frame_file(folder_, info_, id), poses_[id.index()]));
  cache_->add(id, read);
  return read;
}

std::uint64_t StoredMap::touched_bytes() const {
  return points_.touched_bytes() + places_.touched_bytes() + (noise_ ? noise_->touched_bytes() : 0);
}

void StoredMap::check() const {
  check_map_text(folder_, info_, kPosesFile);
  check_map_text(folder_, info_, kUvlistFile);
  if (info_.checksum_of(kHeldOutFile)) check_map_text(folder_, info_, kHeldOutFile);
  check_sealed_file(folder_ / kPointFile, kPointKind, info_.checksum_of(kPointFile));
  if (noise_) check_sealed_file(folder_ / kNoiseFile, kNoiseKind, info_.checksum_of(kNoiseFile));
  check_sealed_file(folder_ / kDescriptorFile, kDescriptorKind, info_.checksum_of(kDescriptorFile));
  check_sealed_file(folder_ / kPlaceFile, kPlaceKind, info_.checksum_of(kPlaceFile));
  for (std::size_t i = 0; i < poses_.size(); ++i)
    (void)read_frame_file(folder_, info_, {static_cast<std::int32_t>(i)});
}

}  // namespace cairn
