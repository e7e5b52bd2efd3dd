// SPDX-License-Identifier: Apache-2.0
#include "cairn/map_files/colmap_features.h"

#include <unistd.h>

#include <cerrno>

#include "cairn/core/error.h"
#include "cairn/core/file.h"

namespace cairn {

RecordedFeatures::RecordedFeatures(const std::filesystem::path& folder)
    : path_(temporary_beside(folder / "features")), file_(std::fopen(path_.c_str(), "w+bx")) {
  if (!file_) fail_writing(path_, "create the file", errno);
  std::error_code error;
  std::filesystem::remove(path_, error);  // it lives as long as it is open, and no longer
}

void RecordedFeatures::add(std::span<const RecordedFeature> features) {
  if (std::fwrite(features.data(), sizeof(RecordedFeature), features.size(), file_.get()) != features.size())
    fail_writing(path_, "write the file", errno);
  begins_.push_back(begins_.back() + features.size());
  is_flushed_ = false;
}

bool RecordedFeatures::has(const ObservationRef& observation) const {
  const auto keyframe = observation.keyframe.index();
  return observation.keyframe.valid() && keyframe + 1 < begins_.size() && observation.feature >= 0 &&
         static_cast<std::uint64_t>(observation.feature) < begins_[keyframe + 1] - begins_[keyframe];
}

RecordedFeature RecordedFeatures::at(const ObservationRef& observation) {
  require(has(observation), "a feature of a keyframe that was added");
  if (!is_flushed_ && std::fflush(file_.get()) != 0) fail_writing(path_, "write the file", errno);
  is_flushed_ = true;
  const std::uint64_t number =
      begins_[observation.keyframe.index()] + static_cast<std::uint64_t>(observation.feature);
  RecordedFeature feature;
  const auto got =
      ::pread(::fileno(file_.get()), &feature, sizeof feature, static_cast<off_t>(number * sizeof feature));
  if (got != static_cast<ssize_t>(sizeof feature)) fail_writing(path_, "read the file back", errno);
  return feature;
}

}  // namespace cairn
