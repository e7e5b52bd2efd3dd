// SPDX-License-Identifier: Apache-2.0
#include "cairn/map_files/map_statistics.h"

#include <fmt/format.h>

#include <algorithm>

#include "cairn/core/checksum.h"
#include "cairn/core/error.h"
#include "cairn/core/random.h"
#include "cairn/map/indicators.h"
#include "cairn/map_files/frame_file.h"
#include "cairn/map_files/held_out_file.h"
#include "cairn/map_files/landmark_stream.h"
#include "cairn/map_files/map_file.h"
#include "cairn/map_files/map_text_files.h"
#include "cairn/map_files/mapped_file.h"
#include "cairn/map_files/place_layout.h"
#include "cairn/map_files/uvlist.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFirstIndicator = 4;  // column of uvlist.txt after id x y z
constexpr const char* kLargestStd = "largest_std";

[[noreturn]] void fail(const fs::path& path, std::string expected, std::string found) {
  throw InputError({path.string(), 0, std::move(expected), std::move(found), std::string(kMapRemedy)});
}

/// Represents a set of observations in 64 bits, whatever their order: the sum of a random number for each, so
/// that frames/, which has them by keyframes, and Point.bin with Descriptor.bin, which have them by
/// landmarks, can be compared without holding either.
class ObservationSet {
 public:
  void add(const ObservationRef& observation, LandmarkId landmark, std::string_view descriptor) {
    sum_ += Random(pair(observation.keyframe.value, observation.feature),
                   pair(landmark.value, static_cast<std::int32_t>(crc32(descriptor))))
                .next();
  }
  bool operator==(const ObservationSet&) const = default;

 private:
  static std::uint64_t pair(std::int32_t high, std::int32_t low) {
    return std::uint64_t{static_cast<std::uint32_t>(high)} << 32U | static_cast<std::uint32_t>(low);
  }
  std::uint64_t sum_ = 0;
};

/// Returns the observations in frames/.
void add_sightings(std::int32_t keyframe, const FrameFile& frame, ObservationSet& shown) {
  const Descriptors& descriptors = frame.observed.features.descriptors;
  for (std::size_t f = 0; f < frame.landmarks.size(); ++f)
    if (frame.landmarks[f].valid())
      shown.add({{keyframe}, static_cast<std::int32_t>(f)}, frame.landmarks[f],
                {reinterpret_cast<const char*>(descriptors.row(f)), descriptors.bytes()});
}

ObservationSet read_frames(const fs::path& folder, const MapInfo& info) {
  ObservationSet shown;
  std::uint64_t features = 0;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(info.keyframes.size()); ++i) {
    const FrameFile frame = read_frame_file(folder, info, {i});
    features += frame.landmarks.size();
    add_sightings(i, frame, shown);
  }
  if (features != info.features)
    fail(folder / kMapInfoFile, fmt::format("{} features, as the files in frames/ have", features),
         fmt::format("{}", info.features));
  return shown;
}

/// Counts the indicators of one landmark after the other.
class IndicatorCounter {
 public:
  explicit IndicatorCounter(MapStatistics& figures) : figures_(figures) {
    const std::vector<std::string>& columns = uvlist_columns();
    for (std::size_t i = kFirstIndicator; i < columns.size(); ++i) {
      figures.indicators.push_back({columns[i], {}});
      is_point_std_.push_back(columns[i] == "std_x" || columns[i] == "std_y" || columns[i] == "std_z");
    }
    figures.indicators.insert(figures.indicators.begin() + kAfterStds, {kLargestStd, {}});
    is_point_std_.insert(is_point_std_.begin() + kAfterStds, true);
  }

  void add(const StoredLandmark& landmark, const std::vector<double>& row) {
    const bool has_covariance = !landmark.covariance.isZero(0);
    figures_.most_observations = std::max(figures_.most_observations, landmark.observations);
    figures_.without_covariance += has_covariance ? 0 : 1;
    for (std::size_t i = 0; i < figures_.indicators.size(); ++i) {
      if (is_point_std_[i] && !has_covariance) continue;
      const std::size_t column = kFirstIndicator + i - (i > kAfterStds ? 1 : 0);
      figures_.indicators[i].values.add(i == kAfterStds ? largest_std(landmark.covariance) : row[column]);
    }
  }

 private:
  static constexpr std::size_t kAfterStds = 4;  // where largest_std is: after frames std_x std_y std_z
  MapStatistics& figures_;
  std::vector<bool> is_point_std_;
};

/// Returns the observations in Point.bin and Descriptor.bin, and counts the landmarks' indicators.
ObservationSet read_landmarks(const fs::path& folder, MapStatistics& figures) {
  LandmarkStream landmarks(folder, figures.info);
  ObservationStream observations(folder, figures.info);
  UvlistStream table(folder / kUvlistFile, figures.info.checksum_of(kUvlistFile));
  IndicatorCounter counter(figures);
  ObservationSet shown;
  for (std::int32_t i = 0; const auto landmark = landmarks.next(); ++i) {
    for (std::uint32_t k = 0; k < landmark->observations; ++k) {
      const auto row = observations.next();
      shown.add(row->observation, {i}, {row->descriptor, figures.info.descriptor.bytes});
    }
    const std::vector<double>* row = table.next();
    if (row == nullptr || row->front() != i)
      fail(folder / kUvlistFile, fmt::format("a row for landmark {}", i), "another or none");
    counter.add(*landmark, *row);
  }
  if (table.next() != nullptr)
    fail(folder / kUvlistFile, fmt::format("{} rows", figures.info.landmarks), "more");
  return shown;
}

}  // namespace

MapStatistics read_map_statistics(const fs::path& map_folder) {
  const fs::path folder = require_map_folder(map_folder);
  MapStatistics figures;
  figures.info = read_map_info(folder / kMapInfoFile);
  for (const KeyframeEntry& keyframe : figures.info.keyframes)
    ++figures.component_keyframes[keyframe.component];
  (void)read_map_poses(folder, figures.info);
  (void)read_held_out(folder, figures.info);
  if (figures.info.checksum_of(kNoiseFile))
    check_sealed_file(folder / kNoiseFile, kNoiseKind, figures.info.checksum_of(kNoiseFile));
  check_sealed_file(folder / kPlaceFile, kPlaceKind, figures.info.checksum_of(kPlaceFile));
  const ObservationSet shown = read_frames(folder, figures.info);
  if (shown != read_landmarks(folder, figures))
    fail(folder / kPointFile, "the sightings that frames/ has, with their descriptors", "others");
  return figures;
}

}  // namespace cairn
