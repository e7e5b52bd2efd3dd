// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/optimize/packed_sightings.h"

namespace cairn {

/// Squared errors of all packed sightings at a point, and room to sort them.
struct SightingErrors {
  std::vector<double> of_pixels;  ///< (u, v) alone, in variances; slot by slot, whole blocks
  std::vector<double> of_all;     ///< with the disparity
  std::vector<double> sorted;

  void make_room(int blocks);
};

/// Initial values of a landmark that `packed` holds, relative to the packed sightings' origin.
class LandmarkStart {
 public:
  LandmarkStart(const Rig& rig, std::span<const PlacedCamera> cameras,
                std::span<const LandmarkSighting> sightings, const PackedSightings& packed)
      : rig_(rig), cameras_(cameras), sightings_(sightings), packed_(packed) {}

  /// By the sighting with the surest disparity; without one, by two rays.
  [[nodiscard]] Eigen::Vector3d quick() const;
  /// Of the points that one sighting and its disparity give, or two rays where it has none, the one with the
  /// least median of the squared errors (Rousseeuw 1984): near the landmark while most sightings are right.
  /// Nothing is dropped yet.
  [[nodiscard]] Eigen::Vector3d robust(const LandmarkKernels& kernels, SightingErrors& errors) const;

 private:
  [[nodiscard]] std::optional<Eigen::Vector3d> candidate(std::size_t sighting) const;
  [[nodiscard]] std::optional<Eigen::Vector3d> intersect(std::size_t a, std::size_t b) const;
  [[nodiscard]] Eigen::Vector3d back_project(const LandmarkSighting& sighting, double depth) const;
  [[nodiscard]] const PlacedCamera& camera_of(const LandmarkSighting& sighting) const {
    return cameras_[static_cast<std::size_t>(sighting.camera)];
  }
  [[nodiscard]] double median_error(const LandmarkKernels& kernels, const Eigen::Vector3d& point,
                                    SightingErrors& errors) const;

  const Rig& rig_;
  std::span<const PlacedCamera> cameras_;
  std::span<const LandmarkSighting> sightings_;
  const PackedSightings& packed_;
};

}  // namespace cairn
