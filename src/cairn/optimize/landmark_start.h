// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/optimize/packed_observations.h"

namespace cairn {

/// Holds the squared errors of all packed observations at a point, and memory to sort them.
struct ObservationErrors {
  std::vector<double> of_pixels;  ///< of (u, v) alone, in variances; slot by slot, whole blocks
  std::vector<double> of_all;     ///< of (u, v, d), in variances; slot by slot, whole blocks
  std::vector<double> sorted;

  /// Enlarges the arrays to hold `blocks` blocks.
  void make_room(int blocks);
};

/// Computes initial values of a landmark that `packed` holds, relative to the packed observations' origin.
class LandmarkStart {
 public:
  LandmarkStart(const Rig& rig, std::span<const PlacedCamera> cameras,
                std::span<const CameraObservation> observations, const PackedObservations& packed)
      : rig_(rig), cameras_(cameras), observations_(observations), packed_(packed) {}

  /// Back-projects the observation with the largest disparity in its standard deviations; without
  /// disparities, intersects two rays.
  [[nodiscard]] Eigen::Vector3d quick() const;
  /// Returns the candidate with the least median of the squared errors (Rousseeuw 1984), near the landmark as
  /// long as most observations are right. Candidates are observations back-projected by their disparity, or
  /// the intersection of two rays if they have none. No observation may have been dropped yet.
  [[nodiscard]] Eigen::Vector3d robust(const LandmarkKernels& kernels, ObservationErrors& errors) const;

 private:
  [[nodiscard]] std::optional<Eigen::Vector3d> candidate(std::size_t observation) const;
  [[nodiscard]] std::optional<Eigen::Vector3d> intersect(std::size_t a, std::size_t b) const;
  [[nodiscard]] Eigen::Vector3d back_project(const CameraObservation& observation, double depth) const;
  [[nodiscard]] const PlacedCamera& camera_of(const CameraObservation& observation) const {
    return cameras_[static_cast<std::size_t>(observation.camera)];
  }
  [[nodiscard]] double median_error(const LandmarkKernels& kernels, const Eigen::Vector3d& point,
                                    ObservationErrors& errors) const;

  const Rig& rig_;
  std::span<const PlacedCamera> cameras_;
  std::span<const CameraObservation> observations_;
  const PackedObservations& packed_;
};

}  // namespace cairn
