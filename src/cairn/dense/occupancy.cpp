// SPDX-License-Identifier: Apache-2.0
#include "cairn/dense/occupancy.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "cairn/core/error.h"
#include "cairn/dense/ray_walk.h"

namespace cairn {
namespace {

constexpr double kOctomapSpan = 1 << 16;  // an OctoMap file has 16 levels
constexpr double kMaxDepth = 100.0;       // metres; a deeper reading of an RGB-D camera is none

float log_odds(double probability) {
  return static_cast<float>(std::log(probability / (1 - probability)));
}

void require_between(const char* field, double value, double low, double high) {
  if (value > low && value < high) return;
  throw InputError({field, 0, fmt::format("a value between {} and {}", low, high), fmt::format("{}", value),
                    "Leave it out for the default."});
}

/// Calls visit(local) for each voxel whose bit is set.
template <class Visit>
void visit_bits(const BlockMask& mask, const Visit& visit) {
  for (std::uint32_t word = 0; word < mask.size(); ++word) {
    for (std::uint64_t bits = mask[word]; bits != 0; bits &= bits - 1)
      visit(word << 6 | static_cast<std::uint32_t>(std::countr_zero(bits)));
  }
}

void add_color(VoxelSum& total, const VoxelSum& sum) {
  if (total.count + sum.count > 1U << 22) return;  // its mean is long settled
  total.count += sum.count;
  total.r += sum.r;
  total.g += sum.g;
  total.b += sum.b;
}

}  // namespace

void visit(OccupancyOptions& options, ParameterVisitor& visitor) {
  visitor.parameter(
      {"octree.resolution", above_up_to(0, 1000, "metres"), "Size of the smallest cubes of the octree."},
      options.resolution);
  visitor.parameter({"octree.max_range", above_up_to(0, 1e4, "metres"),
                     "Distance from the camera up to which points count; farther ones only free the way up "
                     "to there."},
                    options.max_range);
}

void OccupancyOptions::validate() const {
  check_ranges(*this);
  check_parameter(max_range > resolution, "octree.max_range", "metres above octree.resolution", max_range);
  require_between("hit", hit, 0.5, 1);
  require_between("miss", miss, 0, 0.5);
  require_between("clamp_min", clamp_min, 0, 0.5);
  require_between("clamp_max", clamp_max, 0.5, 1);
  require_between("threshold", threshold, clamp_min, clamp_max);
}

OccupancyGrid::OccupancyGrid(const OccupancyOptions& options)
    : options_((options.validate(), options)),
      hit_(log_odds(options.hit)),
      miss_(log_odds(options.miss)),
      clamp_min_(log_odds(options.clamp_min)),
      clamp_max_(log_odds(options.clamp_max)),
      threshold_(log_odds(options.threshold)) {}

OccupancyUpdate OccupancyGrid::scan(const DepthImage& depth, const RgbImage& color, const PixelRays& rays,
                                    const Rigid3& world_from_camera) const {
  require_on_grid(world_from_camera.translation, options_.max_range, options_.resolution, kOctomapSpan);
  VoxelSums ends(options_.resolution);  // one ray for each voxel in which points lie
  ends.add_image(depth, color, rays, world_from_camera, 0, kMaxDepth);
  OccupancyUpdate update;
  const Eigen::Vector3f origin = world_from_camera.translation.cast<float>();
  RayWalk walk(origin, options_.resolution, update);
  ends.visit_sorted([&](const VoxelKey& voxel, const VoxelSum& sum) {
    const Eigen::Vector3f end = walk.centre_of(voxel);
    const Eigen::Vector3f way = end - origin;
    const double length =
        std::sqrt(static_cast<double>(way.x() * way.x() + way.y() * way.y() + way.z() * way.z()));
    if (length <= options_.max_range) {
      walk.pass_to(end);
      const std::uint32_t block = walk.hit(voxel);
      if (!color.empty()) update.colors.push_back({block, local_of(voxel), sum});
    } else {
      walk.pass_to(origin + way / static_cast<float>(length) * static_cast<float>(options_.max_range));
    }
  });
  return update;
}

OccupancyGrid::Block& OccupancyGrid::block(BlockKey key) {
  const std::uint32_t number = index_.find_or_insert(key);
  if (number == blocks_.size()) blocks_.push_back(std::make_unique<Block>());
  return *blocks_[number];
}

void OccupancyGrid::add_to_mask(Block& block, const BlockMask& mask, float log_odds) const {
  visit_bits(mask, [&](std::uint32_t local) {
    block.log_odds[local] = std::clamp(block.log_odds[local] + log_odds, clamp_min_, clamp_max_);
  });
  for (std::size_t word = 0; word < mask.size(); ++word) block.known[word] |= mask[word];
}

void OccupancyGrid::apply(const OccupancyUpdate& update) {
  for (std::uint32_t i = 0; i < update.blocks.size(); ++i) {
    Block& mine = block(update.index.key(i));
    const BlockMask& hit = update.blocks[i].hit;
    BlockMask missed = update.blocks[i].passed;
    for (std::size_t word = 0; word < missed.size(); ++word) missed[word] &= ~hit[word];
    add_to_mask(mine, missed, miss_);
    add_to_mask(mine, hit, hit_);
  }
  for (const auto& [number, local, sum] : update.colors) {
    Block& mine = block(update.index.key(number));
    if (!mine.colors) mine.colors = std::make_unique<Colors>();
    add_color(mine.colors->sums[local], sum);
  }
  colored_ = colored_ || !update.colors.empty();
}

void OccupancyGrid::add_cloud(const Cloud& cloud) {
  VoxelSums sums(options_.resolution);
  for (const CloudPoint& point : cloud.points) {
    const Eigen::Vector3d position = Eigen::Vector3f(point.x, point.y, point.z).cast<double>();
    require_on_grid(position, 0, options_.resolution, kOctomapSpan);
    sums.add_point(position, {point.r, point.g, point.b});
  }
  OccupancyUpdate update;
  RayWalk walk(Eigen::Vector3f::Zero(), options_.resolution, update);
  sums.visit_sorted([&](const VoxelKey& voxel, const VoxelSum& sum) {
    const std::uint32_t number = walk.hit(voxel);
    if (cloud.colored) update.colors.push_back({number, local_of(voxel), sum});
  });
  apply(update);
}

void OccupancyGrid::visit_sorted(const std::function<void(const OccupancyVoxel&)>& visit) const {
  for (const std::uint32_t number : index_.sorted()) {
    const Block& mine = *blocks_[number];
    visit_bits(mine.known, [&](std::uint32_t local) {
      const VoxelKey key = voxel_in_block(index_.key(number), local);
      OccupancyVoxel voxel;
      for (int axis = 0; axis < 3; ++axis)
        voxel.position[axis] = static_cast<std::int32_t>(key[static_cast<std::size_t>(axis)]) - kVoxelOffset;
      voxel.log_odds = mine.log_odds[local];
      voxel.occupied = voxel.log_odds >= threshold_;
      if (mine.colors) voxel.color = mean_color(mine.colors->sums[local]);
      visit(voxel);
    });
  }
}

OccupancyGrid::Counts OccupancyGrid::counts() const {
  Counts counts;
  for (const auto& block : blocks_) {
    visit_bits(block->known, [&](std::uint32_t local) {
      ++(block->log_odds[local] >= threshold_ ? counts.occupied : counts.free);
    });
  }
  return counts;
}

}  // namespace cairn
