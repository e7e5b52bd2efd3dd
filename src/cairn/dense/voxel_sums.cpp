// SPDX-License-Identifier: Apache-2.0
#include "cairn/dense/voxel_sums.h"

#include <cmath>

namespace cairn {
namespace {

constexpr int kFractionBits = 10;
constexpr double kFractions = 1 << kFractionBits;
constexpr std::uint32_t kFractionMask = (1U << kFractionBits) - 1;
constexpr std::uint32_t kMaxCount = 1U << 22;  // 2^22 * 1023 still fits 32 bits
constexpr double kSpan = 1 << kVoxelBits;

void add_fixed(VoxelSum& sum, std::uint32_t x, std::uint32_t y, std::uint32_t z, const Rgb8& color) {
  if (sum.count >= kMaxCount) return;
  ++sum.count;
  sum.x += x & kFractionMask;
  sum.y += y & kFractionMask;
  sum.z += z & kFractionMask;
  sum.r += color.r;
  sum.g += color.g;
  sum.b += color.b;
}

void add_sum(VoxelSum& sum, const VoxelSum& other) {
  if (sum.count + other.count > kMaxCount) return;
  sum.count += other.count;
  sum.x += other.x;
  sum.y += other.y;
  sum.z += other.z;
  sum.r += other.r;
  sum.g += other.g;
  sum.b += other.b;
}

}  // namespace

/// The points of one image row on the grid, in fixed point with 10 bits below the voxel.
struct VoxelSums::Row {
  explicit Row(std::size_t width) : x(width), y(width), z(width) {}
  std::vector<std::uint32_t> x, y, z;  // x = kNoPoint where the pixel has none

  static constexpr std::uint32_t kNoPoint = 0xffffffff;

  void fill(const float* depth, const double* ray_x, const double* ray_y, const Rigid3& grid_from_camera,
            const Eigen::Matrix3d& grid_rotation, float min_depth, float max_depth) {
    const Eigen::Matrix3d& r = grid_rotation;
    const Eigen::Vector3d& t = grid_from_camera.translation;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const bool valid = depth[i] > min_depth && depth[i] <= max_depth && !std::isnan(ray_x[i]);
      const double z_in_camera = valid ? static_cast<double>(depth[i]) : 0.0;
      const double rx = valid ? ray_x[i] : 0.0, ry = valid ? ray_y[i] : 0.0;
      const auto on_grid = [&](int axis) {
        const double along = r(axis, 0) * rx + r(axis, 1) * ry + r(axis, 2);
        return static_cast<std::uint32_t>(static_cast<std::int32_t>(along * z_in_camera + t[axis]));
      };
      x[i] = valid ? on_grid(0) : kNoPoint;
      y[i] = on_grid(1);
      z[i] = on_grid(2);
    }
  }
};

VoxelSums::VoxelSums(double voxel_size) : voxel_size_(voxel_size) {
  require(voxel_size > 0, "voxels have a size above 0");
}

VoxelSums::Block& VoxelSums::block(BlockKey key) {
  const std::uint32_t number = index_.find_or_insert(key);
  if (number == blocks_.size()) {
    blocks_.push_back(std::make_unique<Block>());
    blocks_.back()->fill(BlockIndex::kNone);
  }
  return *blocks_[number];
}

VoxelSum& VoxelSums::sum_in(Block& block, std::uint32_t local) {
  std::uint32_t& number = block[local];
  if (number == BlockIndex::kNone) {
    number = static_cast<std::uint32_t>(size_++);
    if (number >> kChunkBits == chunks_.size())
      chunks_.push_back(std::make_unique<VoxelSum[]>(std::size_t{1} << kChunkBits));
  }
  return sum(number);
}

void VoxelSums::add_row(const Row& row, const Rgb8* color) {
  VoxelKey last_voxel{};
  BlockKey last_key = 0;
  Block* last_block = nullptr;
  VoxelSum* last_sum = nullptr;
  for (std::size_t i = 0; i < row.x.size(); ++i) {
    if (row.x[i] == Row::kNoPoint) continue;
    const VoxelKey voxel = {row.x[i] >> kFractionBits, row.y[i] >> kFractionBits, row.z[i] >> kFractionBits};
    if (last_sum == nullptr || voxel != last_voxel) {
      const BlockKey key = block_of(voxel);
      if (last_block == nullptr || key != last_key) last_block = &block(key);
      last_sum = &sum_in(*last_block, local_of(voxel));
      last_voxel = voxel;
      last_key = key;
    }
    add_fixed(*last_sum, row.x[i], row.y[i], row.z[i], color != nullptr ? color[i] : Rgb8{});
  }
}

void VoxelSums::add_image(const DepthImage& depth, const RgbImage& color, const PixelRays& rays,
                          const Rigid3& world_from_camera, double min_depth, double max_depth) {
  require(depth.width() == rays.width() && depth.height() == rays.height(),
          "the depth image has the camera's size");
  require(color.empty() || (color.width() == depth.width() && color.height() == depth.height()),
          "colour and depth have one size");
  require_on_grid(world_from_camera.translation, max_depth * rays.max_length(), voxel_size_, kSpan);
  const double scale = kFractions / voxel_size_;
  Rigid3 grid_from_camera = world_from_camera;
  grid_from_camera.translation =
      (world_from_camera.translation * scale).array() + kFractions * static_cast<double>(kVoxelOffset);
  const Eigen::Matrix3d rotation = world_from_camera.matrix3() * scale;
  Row row(static_cast<std::size_t>(depth.width()));
  for (int v = 0; v < depth.height(); ++v) {
    row.fill(depth.row(v), rays.x_row(v), rays.y_row(v), grid_from_camera, rotation,
             static_cast<float>(min_depth), static_cast<float>(max_depth));
    add_row(row, color.empty() ? nullptr : color.row(v));
  }
}

void VoxelSums::add_point(const Eigen::Vector3d& point_in_world, const Rgb8& color) {
  require_on_grid(point_in_world, 0, voxel_size_, kSpan);
  const Eigen::Vector3d scaled = point_in_world * (kFractions / voxel_size_);
  std::array<std::uint32_t, 3> fixed;
  VoxelKey voxel;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    fixed[i] = static_cast<std::uint32_t>(
        static_cast<std::int64_t>(scaled[axis] + kFractions * static_cast<double>(kVoxelOffset)));
    voxel[i] = fixed[i] >> kFractionBits;
  }
  add_fixed(sum_in(block(block_of(voxel)), local_of(voxel)), fixed[0], fixed[1], fixed[2], color);
}

void VoxelSums::add(const VoxelSums& other) {
  require(voxel_size_ == other.voxel_size_, "grids that are added have one voxel size");
  for (std::uint32_t number = 0; number < other.blocks_.size(); ++number) {
    Block& mine = block(other.index_.key(number));
    const Block& theirs = *other.blocks_[number];
    for (std::uint32_t local = 0; local < kVoxelsPerBlock; ++local)
      if (theirs[local] != BlockIndex::kNone) add_sum(sum_in(mine, local), other.sum(theirs[local]));
  }
}

Eigen::Vector3d VoxelSums::mean(const VoxelKey& key, const VoxelSum& sum) const {
  const double count = sum.count;
  const Eigen::Vector3d corner(static_cast<double>(key[0]) - kVoxelOffset,
                               static_cast<double>(key[1]) - kVoxelOffset,
                               static_cast<double>(key[2]) - kVoxelOffset);
  const Eigen::Vector3d offset(sum.x / count, sum.y / count, sum.z / count);
  return voxel_size_ *
         (corner.array() + (offset.array() + 0.5) / kFractions).matrix();  // 0.5: the truncation
}

Rgb8 mean_color(const VoxelSum& sum) {
  if (sum.count == 0) return {};
  const auto channel = [&](std::uint32_t total) {
    return static_cast<std::uint8_t>((total + sum.count / 2) / sum.count);
  };
  return {channel(sum.r), channel(sum.g), channel(sum.b)};
}

}  // namespace cairn
