// SPDX-License-Identifier: Apache-2.0
#include "cairn/dense/fuse_sequence.h"

#include <fmt/format.h>

#include <exception>
#include <string>

#include "cairn/core/error.h"
#include "cairn/sequence/skipped_frames.h"

namespace cairn {
namespace {

/// A frame reduced to what is fused of it, or why it could not be.
struct ReducedFrame {
  std::optional<VoxelSums> cloud;
  std::optional<OccupancyUpdate> occupancy;
  std::string defect;
  std::exception_ptr failure;  // the defect, to be thrown again
};

ReducedFrame reduce_frame(const FrameLoader& loader, FrameId id, const PixelRays& rays,
                          const Rigid3& world_from_camera, const FusionTargets& targets) {
  ReducedFrame reduced;
  DepthImage depth;
  RgbImage color;
  try {
    depth = loader.load_depth(id);
    color = loader.load_color(id);
  } catch (const InputError& error) {
    reduced.defect = error.what();
    reduced.failure = std::current_exception();
    return reduced;
  }
  if (targets.cloud != nullptr) reduced.cloud = targets.cloud->reduce(depth, color, rays, world_from_camera);
  if (targets.occupancy != nullptr)
    reduced.occupancy = targets.occupancy->scan(depth, color, rays, world_from_camera);
  return reduced;
}

/// The frames that have pose and depth; counts those that have not.
std::vector<FrameId> frames_to_fuse(const Sequence& sequence,
                                    const std::vector<std::optional<WorldFromCamera>>& world_from_camera,
                                    FusionReport& report) {
  std::vector<FrameId> ids;
  for (std::size_t i = 0; i < sequence.frames.size(); ++i) {
    if (!world_from_camera[i]) {
      ++report.without_pose;
    } else if (sequence.frames[i].depth.empty()) {
      ++report.without_depth;
    } else {
      ids.push_back({static_cast<std::int32_t>(i)});
    }
  }
  return ids;
}

void require_depth(const Sequence& sequence) {
  if (sequence.calibration.depth) return;
  throw InputError({sequence.folder.string(), 0, "a sequence with depth images",
                    fmt::format("one without, of format {}", sequence.format),
                    "Fuse an RGB-D sequence, or give its depth in camera.yaml."});
}

void require_frames(const Sequence& sequence, const FusionReport& report) {
  if (report.fused > 0 || report.stopped) return;
  throw InputError({sequence.folder.string(), 0, "a frame with pose, depth and colour",
                    fmt::format("none of {}: {} without pose, {} without depth, {} unreadable", report.frames,
                                report.without_pose, report.without_depth, report.unreadable),
                    "Check the poses and the images."});
}

}  // namespace

FusionReport fuse_sequence(const Sequence& sequence,
                           const std::vector<std::optional<WorldFromCamera>>& world_from_camera,
                           const FusionTargets& targets, const Executor& executor, Progress& progress) {
  require(world_from_camera.size() == sequence.frames.size(), "one element for each frame");
  require_depth(sequence);
  FusionReport report;
  report.frames = static_cast<std::int64_t>(sequence.frames.size());
  const std::vector<FrameId> ids = frames_to_fuse(sequence, world_from_camera, report);
  const auto pose_of = [&](FrameId id) { return *world_from_camera[id.index()]; };
  const FrameLoader loader(sequence);
  const PixelRays rays(sequence.calibration.camera);
  SkippedFrames skipped(progress);
  progress.start("fusing", static_cast<std::int64_t>(ids.size()), "frames");
  executor.ordered_pipeline<ReducedFrame>(
      ids.size(), [&](std::size_t i) { return reduce_frame(loader, ids[i], rays, pose_of(ids[i]), targets); },
      [&](std::size_t i, ReducedFrame&& reduced) {
        if (reduced.failure) {
          skipped.skip(reduced.failure, fmt::format("frame {} left out: {}", ids[i].value, reduced.defect));
        } else {
          skipped.take();
          if (reduced.cloud) targets.cloud->add(*reduced.cloud);
          if (reduced.occupancy) targets.occupancy->apply(*reduced.occupancy);
          ++report.fused;
        }
        progress.update(static_cast<std::int64_t>(i) + 1);
        report.stopped = progress.stop_requested();
        return !report.stopped;
      });
  progress.finish();
  skipped.finish();
  report.unreadable = skipped.count();
  require_frames(sequence, report);
  return report;
}

}  // namespace cairn
