// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/mapper.h"

#include <algorithm>

#include "cairn/core/error.h"
#include "cairn/core/stopwatch.h"
#include "cairn/slam/essential_graph.h"
#include "cairn/slam/mapping.h"
#include "cairn/slam/window.h"

namespace cairn {
namespace {

int points_with_depth(const ObservedFrame& frame) {
  return static_cast<int>(std::count_if(frame.observations.begin(), frame.observations.end(),
                                        [](const Observation& o) { return o.has_disparity(); }));
}

}  // namespace

/// Holds a running adjustment.
struct Mapper::Adjustment {
  Window window;
  BundleReport report;
  double seconds = 0;
  int frames = 0;  // since its start
  std::optional<Executor::Task> task;

  void run() {
    const Stopwatch watch;
    BundleOptions options;
    options.max_iterations = 5;
    report = adjust_bundle(window.problem, options);
    seconds = watch.seconds();
  }
};

Mapper::Mapper(const SlamOptions& options, const Executor& executor, IndexedMap& indexed, StageTimes& times)
    : options_(options), executor_(executor), indexed_(indexed), map_(indexed.edit()), times_(times) {
  for (const Keyframe& keyframe : map_.keyframes()) {
    components_ = std::max(components_, keyframe.component + 1);
    const Rigid3 world_from_parent =
        keyframe.parent.valid() ? map_.world_from_camera(keyframe.parent) : Rigid3{};
    odometry_.push_back({world_from_parent.inverse() * map_.world_from_camera(keyframe.id),
                         edge_information(map_, keyframe.id)});
  }
}

Mapper::~Mapper() = default;

std::optional<KeyframeId> Mapper::begin_component(const ObservedFrame& frame) {
  if (points_with_depth(frame) < options_.min_matches) return std::nullopt;
  if (!map_.keyframes().empty() && ++good_lost_frames_ < options_.lost_frames) return std::nullopt;
  good_lost_frames_ = 0;
  (void)apply_adjustment();
  const KeyframeId id = indexed_.add_keyframe(ObservedFrame(frame), {}, {}, components_++);
  odometry_.push_back({{}, edge_information(map_, id)});
  (void)add_landmarks_by_depth(map_, id);
  return id;
}

KeyframeId Mapper::insert(const ObservedFrame& frame, const FramePose& tracked, KeyframeId parent) {
  const Stopwatch watch;
  require(!adjustment_, "the last adjustment has been taken over");
  const Rigid3 parent_from_new = map_.world_from_camera(parent).inverse() * tracked.world_from_camera;
  const KeyframeId id = add_keyframe(indexed_, frame, tracked, parent, map_.component_of(parent));
  odometry_.push_back({parent_from_new, edge_information(map_, id)});
  (void)add_landmarks_by_depth(map_, id);
  (void)fuse_with_neighbours(map_, id, options_);
  times_.mapping.push_back(watch.seconds());
  return id;
}

void Mapper::start_adjustment(KeyframeId keyframe) {
  require(!adjustment_, "the last adjustment has been taken over");
  (void)cull_keyframes(indexed_, keyframe, options_.mapping);
  adjustment_ = std::make_unique<Adjustment>();
  adjustment_->window = window_around(map_, keyframe, options_.mapping);
  Adjustment* running = adjustment_.get();
  adjustment_->task.emplace(executor_.start([running] { running->run(); }));
}

bool Mapper::apply_adjustment_if_due() {
  if (!adjustment_ || ++adjustment_->frames <= options_.mapping.window_lag) return false;
  return apply_adjustment();
}

bool Mapper::apply_adjustment() {
  if (!adjustment_) return false;
  adjustment_->task->wait();
  cairn::apply_adjustment(adjustment_->window, adjustment_->report, map_);
  times_.window.push_back(adjustment_->seconds);
  adjustment_.reset();
  return true;
}

void Mapper::adjust_whole(std::int32_t component, SharedField field) {
  const Stopwatch watch;
  for (int round = 0; round < 2; ++round) {  // the second without the outliers of the first
    Window whole = whole_component(map_, component);
    BundleOptions options;
    const BundleReport report = adjust_bundle(whole.problem, options, executor_);
    cairn::apply_adjustment(whole, report, map_);
    if (round > 0) keep_covariances(whole, report, field);
  }
  times_.global.push_back(watch.seconds());
}

void Mapper::keep_covariances(const Window& whole, const BundleReport& report, SharedField field) {
  const auto covariances = point_covariances(whole.problem, report.inlier, executor_);
  for (std::size_t p = 0; p < covariances.size(); ++p)
    covariances_[static_cast<std::size_t>(whole.points[p].value)] = covariances[p];
  keep_keyframe_covariances(map_, whole, report.inlier, field, executor_, keyframe_covariances_);
}

/// Moves a component back to where its first keyframe was made: adjustments hold some keyframes of a window
/// fixed, not always the first.
void Mapper::put_back(std::int32_t component) {
  for (const KeyframeId id : map_.keyframe_ids()) {
    if (map_[id].component != component) continue;
    const Rigid3 made = odometry_[static_cast<std::size_t>(id.value)].parent_from_new;
    if (!map_[id].parent.valid())
      move_component(component, component, made * map_[id].world_from_camera.inverse(), map_);
    return;  // the first of the component
  }
}

void Mapper::finish(SharedField field) {
  (void)apply_adjustment();
  if (!options_.odometry) adjust_all(field);
  for (std::int32_t component = 0; component < components_; ++component) put_back(component);
}

void Mapper::adjust_all(SharedField field) {
  covariances_.assign(map_.landmarks().size(), Eigen::Matrix3d::Zero());
  for (std::int32_t component = 0; component < components_; ++component) adjust_whole(component, field);
}

void Mapper::fill_graphs(std::span<const PoseGraph::Edge> loops, PoseGraph& before, PoseGraph& after) const {
  std::vector<Rigid3> by_odometry(map_.keyframes().size());
  for (const Keyframe& keyframe : map_.keyframes()) {
    const auto k = static_cast<std::size_t>(keyframe.id.value);
    by_odometry[k] = odometry_[k].parent_from_new;
    if (keyframe.parent.valid())
      by_odometry[k] = by_odometry[static_cast<std::size_t>(keyframe.parent.value)] * by_odometry[k];
    before.vertices.push_back({keyframe.id.value, by_odometry[k]});
    after.vertices.push_back({keyframe.id.value, map_.world_from_camera(keyframe.id)});
    if (keyframe.parent.valid())
      before.edges.push_back({keyframe.parent.value, keyframe.id.value, odometry_[k].parent_from_new,
                              odometry_[k].information, false});
  }
  before.edges.insert(before.edges.end(), loops.begin(), loops.end());
  if (!before.vertices.empty()) before.fixed = {before.vertices.front().id};
  after.edges = before.edges;
  after.fixed = before.fixed;
  place_edges(after);
}

/// Sets the edges from parents to what the adjustment says of them.
void Mapper::place_edges(PoseGraph& graph) const {
  const auto from_parents = static_cast<std::size_t>(
      std::count_if(map_.keyframes().begin(), map_.keyframes().end(),
                    [](const Keyframe& keyframe) { return keyframe.parent.valid(); }));
  for (std::size_t i = 0; i < from_parents; ++i) {
    PoseGraph::Edge& edge = graph.edges[i];
    const auto k = static_cast<std::size_t>(edge.b);
    if (k >= keyframe_covariances_.size() || !keyframe_covariances_[k].from_parent) continue;
    const auto information = edge_information_of(*keyframe_covariances_[k].from_parent);
    if (!information) continue;
    const auto& vertices = graph.vertices;  // by keyframe
    edge.a_from_b = vertices[static_cast<std::size_t>(edge.a)].world_from_vertex.inverse() *
                    vertices[k].world_from_vertex;
    edge.information = *information;
  }
}

}  // namespace cairn
