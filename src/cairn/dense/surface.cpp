// SPDX-License-Identifier: Apache-2.0
#include "cairn/dense/surface.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "cairn/core/error.h"
#include "cairn/dense/voxel_index.h"

namespace cairn {
namespace {

/// Sums over points: enough for their mean and covariance.
struct Moments {
  double count = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();

  void add(const Eigen::Vector3d& p) {
    count += 1;
    sum += p;
    squares += p * p.transpose();
  }
  void add(const Moments& other) {
    count += other.count;
    sum += other.sum;
    squares += other.squares;
  }
  [[nodiscard]] Eigen::Matrix3d covariance() const {
    const Eigen::Vector3d mean = sum / count;
    return squares / count - mean * mean.transpose();
  }
};

/// All 63 bits of a voxel's position, as a key of BlockIndex.
BlockKey pack(const VoxelKey& key) {
  return static_cast<BlockKey>(key[2]) << (2 * kVoxelBits) | static_cast<BlockKey>(key[1]) << kVoxelBits |
         key[0];
}

struct Grid {
  BlockIndex index;
  std::vector<VoxelKey> keys;
  std::vector<Moments> moments;

  std::uint32_t cell(const VoxelKey& key) {
    const std::uint32_t number = index.find_or_insert(pack(key));
    if (number == keys.size()) {
      keys.push_back(key);
      moments.emplace_back();
    }
    return number;
  }
  [[nodiscard]] Moments around(std::uint32_t number) const {
    Moments total;
    for (int i = 0; i < 27; ++i) {
      VoxelKey key = keys[number];
      key[0] += static_cast<std::uint32_t>(i % 3 - 1);
      key[1] += static_cast<std::uint32_t>(i / 3 % 3 - 1);
      key[2] += static_cast<std::uint32_t>(i / 9 - 1);
      const std::uint32_t neighbour = index.find(pack(key));
      if (neighbour != BlockIndex::kNone) total.add(moments[neighbour]);
    }
    return total;
  }
};

VoxelKey key_at(const Eigen::Vector3d& point, double cell_size) {
  VoxelKey key;
  for (int axis = 0; axis < 3; ++axis) {
    const auto coordinate = static_cast<std::int32_t>(std::floor(point[axis] / cell_size));
    key[static_cast<std::size_t>(axis)] = static_cast<std::uint32_t>(coordinate + kVoxelOffset);
  }
  return key;
}

/// The direction to the nearest pose that has the point in view; zero where none has.
Eigen::Vector3d towards_viewer(const Eigen::Vector3d& point, const std::vector<Rigid3>& path) {
  constexpr double kCosHalfView = 0.8;  // 37 degrees: the corner of a Kinect's image
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  double nearest = std::numeric_limits<double>::max();
  for (const Rigid3& world_from_camera : path) {
    const Eigen::Vector3d way = world_from_camera.translation - point;
    const double distance = way.norm();
    const double along = -way.dot(world_from_camera.rotation * Eigen::Vector3d::UnitZ());
    if (distance >= nearest || along < kCosHalfView * distance || distance <= 0) continue;
    nearest = distance;
    best = way / distance;
  }
  return best;
}

SurfaceCell make_cell(const Moments& own, const Moments& around, const std::vector<Rigid3>& path) {
  SurfaceCell cell;
  const Eigen::Vector3d centre = own.sum / own.count;
  cell.centre = centre.cast<float>();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(around.covariance());
  Eigen::Vector3d normal = solver.eigenvectors().col(0);
  const Eigen::Vector3d values = solver.eigenvalues();
  if (values[1] > 0) cell.flatness = static_cast<float>(std::clamp(1.0 - values[0] / values[1], 0.0, 1.0));
  const Eigen::Vector3d viewer = towards_viewer(centre, path);
  cell.seen = viewer.squaredNorm() > 0;
  if (normal.dot(viewer) < 0) normal = -normal;
  cell.normal = normal.cast<float>();
  return cell;
}

/// At most 200 poses, evenly from the whole path: enough to know what was seen from where.
std::vector<Rigid3> thin_out(const std::vector<Rigid3>& path) {
  constexpr std::size_t kEnough = 200;
  const std::size_t step = path.size() / kEnough + 1;
  std::vector<Rigid3> few;
  for (std::size_t i = 0; i < path.size(); i += step) few.push_back(path[i]);
  return few;
}

}  // namespace

CloudSurface::CloudSurface(const Cloud& cloud, const std::vector<Rigid3>& path, double cell_size)
    : cell_size_(cell_size) {
  require(cell_size > 0, "cells have a size above 0");
  constexpr double kSpan = 1 << kVoxelBits;
  Grid grid;
  cell_of_point_.reserve(cloud.points.size());
  for (const CloudPoint& p : cloud.points) {
    const Eigen::Vector3d point = Eigen::Vector3f(p.x, p.y, p.z).cast<double>();
    require_on_grid(point, cell_size, cell_size, kSpan);
    const std::uint32_t number = grid.cell(key_at(point, cell_size));
    grid.moments[number].add(point);
    cell_of_point_.push_back(number);
  }
  const std::vector<Rigid3> poses = thin_out(path);
  cells_.reserve(grid.keys.size());
  for (std::uint32_t i = 0; i < grid.keys.size(); ++i)
    cells_.push_back(make_cell(grid.moments[i], grid.around(i), poses));
}

}  // namespace cairn
