// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cairn/core/error.h"

namespace cairn {

/// Names how descriptors are compared: by the number of different bits, or by the Euclidean distance of their
/// bytes.
enum class Norm { hamming, l2 };

/// Describes the position, size and orientation of a feature.
struct Keypoint {
  float u = 0, v = 0;    ///< pixels, (0,0) is the centre of the first pixel
  float size = 0;        ///< diameter of the described patch, pixels
  float angle_deg = -1;  ///< orientation, [0, 360), clockwise from the x axis; -1 if there is none
  float response = 0;    ///< strength, comparable within one image
  float sigma_px = 1;    ///< standard deviation of u and of v: the pyramid level's scale
};

/// Holds descriptors of one size one after the other, each padded with zeros to a multiple of 8 bytes.
class Descriptors {
 public:
  Descriptors() = default;
  Descriptors(Norm norm, std::size_t bytes, std::size_t count)
      : norm_(norm),
        bytes_(bytes),
        stride_((bytes + 7) / 8 * 8),
        count_(count),
        words_(stride_ / 8 * count) {}

  [[nodiscard]] Norm norm() const { return norm_; }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }    ///< length of one descriptor, without padding
  [[nodiscard]] std::size_t stride() const { return stride_; }  ///< distance of two descriptors, bytes
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::uint8_t* row(std::size_t i) {
    return reinterpret_cast<std::uint8_t*>(words_.data()) + i * stride_;
  }
  [[nodiscard]] const std::uint8_t* row(std::size_t i) const {
    return reinterpret_cast<const std::uint8_t*>(words_.data()) + i * stride_;
  }
  [[nodiscard]] const std::uint64_t* words() const { return words_.data(); }

 private:
  Norm norm_ = Norm::hamming;
  std::size_t bytes_ = 0, stride_ = 0, count_ = 0;
  std::vector<std::uint64_t> words_;
};

/// Returns the descriptors at `rows`, in this order.
[[nodiscard]] Descriptors select(const Descriptors& all, std::span<const std::size_t> rows);

/// Holds the features of one image: row i of `descriptors` describes keypoint i.
struct Features {
  std::vector<Keypoint> keypoints;
  Descriptors descriptors;
};

}  // namespace cairn
