// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/rgbd_slam.h"

#include <fmt/format.h>

#include <exception>
#include <functional>

#include "cairn/core/error.h"
#include "cairn/core/stopwatch.h"
#include "cairn/slam/observe.h"

namespace cairn {
namespace {

/// A frame on its way from the disk to the tracker.
struct Arrival {
  ObservedFrame observed;
  std::string error;           // not empty: it could not be decoded
  std::exception_ptr failure;  // the same, to be thrown again
  double decode_seconds = 0, feature_seconds = 0;
};

class Frontend {
 public:
  Frontend(const Sequence& sequence, const RgbdSlamOptions& options)
      : camera_(sequence.calibration.camera),
        noise_(options.depth_noise),
        loader_(sequence),
        extractor_(make_extractor(options.features)) {}

  [[nodiscard]] Arrival operator()(std::size_t index) const {
    Arrival arrival;
    Stopwatch watch;
    try {
      const Frame frame = loader_.load({static_cast<std::int32_t>(index)});
      arrival.decode_seconds = watch.lap();
      arrival.observed = observe(frame, camera_, *extractor_, noise_);
      arrival.feature_seconds = watch.lap();
    } catch (const InputError& error) {
      arrival.error = error.what();
      arrival.failure = std::current_exception();
    }
    return arrival;
  }

 private:
  Camera camera_;
  DepthNoise noise_;
  FrameLoader loader_;
  std::unique_ptr<Extractor> extractor_;
};

void require_depth(const Sequence& sequence) {
  if (!sequence.frames.empty() && !sequence.frames.front().depth.empty()) return;
  throw InputError({sequence.folder.string(), 0, "an RGB-D sequence",
                    fmt::format("a {} sequence without depth images", sequence.format),
                    "Without depth there is no scale; record with an RGB-D camera."});
}

PoseGraph graph_of(const KeyframeMap& map, std::vector<PoseGraph::Edge>&& edges) {
  PoseGraph graph;
  for (const Keyframe& keyframe : map.keyframes)
    graph.vertices.push_back({keyframe.id.value, keyframe.world_from_camera});
  graph.edges = std::move(edges);
  if (!graph.vertices.empty()) graph.fixed = {graph.vertices.front().id};
  return graph;
}

void optimize_map(const RgbdSlamOptions& options, RgbdSlamResult& result) {
  result.graph_after = result.graph_before;
  if (options.odometry || result.graph_after.edges.empty()) return;
  PoseGraphOptions graph_options;
  graph_options.kernel = RobustKernel::geman_mcclure;
  graph_options.start = PoseGraphStart::given;
  result.graph_report = optimize_pose_graph(result.graph_after, graph_options);
  for (std::size_t k = 0; k < result.map.keyframes.size(); ++k) {
    result.map.keyframes[k].world_from_camera = result.graph_after.vertices[k].world_from_vertex;
  }
}

void add(const LoopReport& more, LoopReport& sum) {
  sum.tried += more.tried;
  sum.nearby += more.nearby;
  sum.far += more.far;
}

}  // namespace

Trajectory RgbdSlamResult::trajectory() const {
  Trajectory trajectory;
  for (const FrameTrack& track : frames) {
    if (!track.tracked()) continue;
    const Rigid3& world_from_reference =
        map.keyframes[static_cast<std::size_t>(track.reference->value)].world_from_camera;
    trajectory.push_back(
        {track.stamp_ns, WorldFromCamera(world_from_reference * track.reference_from_frame)});
  }
  return trajectory;
}

Trajectory RgbdSlamResult::keyframe_trajectory() const {
  Trajectory trajectory;
  for (const Keyframe& keyframe : map.keyframes)
    trajectory.push_back({keyframe.observed.stamp_ns, WorldFromCamera(keyframe.world_from_camera)});
  return trajectory;
}

RgbdSlamResult run_rgbd_slam(const Sequence& sequence, const RgbdSlamOptions& options,
                             const Executor& executor, Progress& progress) {
  options.validate();
  require_depth(sequence);
  RgbdSlamResult result;
  result.map.rig = rgbd_rig(sequence.calibration.camera, options.depth_noise);
  result.map.descriptor = options.features.descriptor;
  std::vector<PoseGraph::Edge> edges;
  Tracker tracker(options, executor, result.map, edges);
  const Frontend frontend(sequence, options);

  const auto take = [&](std::size_t index, Arrival&& arrival) {
    result.seconds.decode += arrival.decode_seconds;
    result.seconds.features += arrival.feature_seconds;
    if (!arrival.error.empty()) {
      if (result.frames.empty())
        std::rethrow_exception(arrival.failure);  // from the start: not one frame, all
      progress.warn(arrival.error + " The frame is skipped.");
      result.unreadable.push_back(arrival.error);
    } else {
      Stopwatch watch;
      const std::size_t keyframes_before = result.map.keyframes.size();
      result.frames.push_back(tracker.track(std::move(arrival.observed)));
      result.seconds.tracking += watch.lap();
      const bool new_keyframe = result.map.keyframes.size() > keyframes_before;
      if (new_keyframe && options.check_loop_closure && !options.odometry)
        add(close_loops(result.map, options, executor, edges), result.loops);
      result.seconds.loops += watch.lap();
    }
    progress.update(static_cast<std::int64_t>(index) + 1);
    result.stopped = progress.stop_requested() && index + 1 < sequence.frames.size();
    return !result.stopped;
  };
  progress.start("tracking", static_cast<std::int64_t>(sequence.frames.size()), "frames");
  executor.ordered_pipeline<Arrival>(sequence.frames.size(), std::cref(frontend), take);
  progress.finish();

  Stopwatch watch;
  result.graph_before = graph_of(result.map, std::move(edges));
  optimize_map(options, result);
  result.seconds.graph = watch.lap();
  return result;
}

}  // namespace cairn
