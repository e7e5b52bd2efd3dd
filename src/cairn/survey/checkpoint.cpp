// SPDX-License-Identifier: Apache-2.0
#include "cairn/survey/checkpoint.h"

#include <array>
#include <bit>

#include "cairn/core/append_file.h"
#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/map_files/binary_file.h"

namespace cairn {
namespace {

constexpr BinaryKind kKind{"CAIRNSVY", 6};
constexpr const char* kName = "checkpoint.bin";
constexpr const char* kNextName = "checkpoint.next";

// Each put has a get with the same order of values.

void put(const ObservationRef& observation, ByteWriter& writer) {
  writer.put(observation.keyframe.value);
  writer.put(observation.feature);
}

void get(BinaryReader& reader, ObservationRef& observation) {
  observation.keyframe.value = reader.get<std::int32_t>();
  observation.feature = reader.get<std::int32_t>();
}

template <class Matrix>
void put_matrix(const Matrix& matrix, ByteWriter& writer) {
  for (Eigen::Index i = 0; i < matrix.size(); ++i) writer.put(matrix.data()[i]);
}

template <class Matrix>
void get_matrix(BinaryReader& reader, Matrix& matrix) {
  for (Eigen::Index i = 0; i < matrix.size(); ++i) matrix.data()[i] = reader.get<double>();
}

void put(std::uint32_t value, ByteWriter& writer) {
  writer.put(value);
}

void get(BinaryReader& reader, std::uint32_t& value) {
  value = reader.get<std::uint32_t>();
}

void put(LandmarkId id, ByteWriter& writer) {
  writer.put(id.value);
}

void get(BinaryReader& reader, LandmarkId& id) {
  id.value = reader.get<std::int32_t>();
}

void put(const HeldOutLandmark& landmark, ByteWriter& writer);
void get(BinaryReader& reader, HeldOutLandmark& landmark);
void put(const HeldOutFrame& frame, ByteWriter& writer);
void get(BinaryReader& reader, HeldOutFrame& frame);
void put(const MoveInSigmas& move, ByteWriter& writer);
void get(BinaryReader& reader, MoveInSigmas& move);
void put(const Track& track, ByteWriter& writer);
void get(BinaryReader& reader, Track& track);
void put(const SurveyLandmark& landmark, ByteWriter& writer);
void get(BinaryReader& reader, SurveyLandmark& landmark);
void put(const LandmarkErrors& errors, ByteWriter& writer);
void get(BinaryReader& reader, LandmarkErrors& errors);

template <class Item>
void put(const std::vector<Item>& items, ByteWriter& writer) {
  writer.put(static_cast<std::uint64_t>(items.size()));
  for (const Item& item : items) put(item, writer);
}

template <class Item>
void get(BinaryReader& reader, std::vector<Item>& items) {
  const auto count = reader.get<std::uint64_t>();
  items.clear();
  for (std::uint64_t i = 0; i < count; ++i) get(reader, items.emplace_back());
}

void put(const HeldOutLandmark& landmark, ByteWriter& writer) {
  writer.put(landmark.feature);
  put_matrix(landmark.point_in_world, writer);
  put_matrix(landmark.covariance, writer);
}

void get(BinaryReader& reader, HeldOutLandmark& landmark) {
  landmark.feature = reader.get<std::int32_t>();
  get_matrix(reader, landmark.point_in_world);
  get_matrix(reader, landmark.covariance);
}

void put(const HeldOutFrame& frame, ByteWriter& writer) {
  writer.put(frame.keyframe.value);
  for (const Vector6d* values : {&frame.to_map, &frame.to_given, &frame.formal, &frame.stated})
    put_matrix(*values, writer);
}

void get(BinaryReader& reader, HeldOutFrame& frame) {
  frame.keyframe.value = reader.get<std::int32_t>();
  for (Vector6d* values : {&frame.to_map, &frame.to_given, &frame.formal, &frame.stated})
    get_matrix(reader, *values);
}

void put(const MoveInSigmas& move, ByteWriter& writer) {
  writer.put(move.position);
  writer.put(move.rotation);
}

void get(BinaryReader& reader, MoveInSigmas& move) {
  move.position = reader.get<double>();
  move.rotation = reader.get<double>();
}

void put(const Track& track, ByteWriter& writer) {
  put(track.observations, writer);
  put(track.measured, writer);
  put_matrix(track.point_in_world, writer);
}

void get(BinaryReader& reader, Track& track) {
  get(reader, track.observations);
  get(reader, track.measured);
  get_matrix(reader, track.point_in_world);
}

void put(const ValueRange& range, ByteWriter& writer) {
  for (const double value : {range.mean, range.min, range.max, range.std}) writer.put(value);
}

void get(BinaryReader& reader, ValueRange& range) {
  for (double* value : {&range.mean, &range.min, &range.max, &range.std}) *value = reader.get<double>();
}

void put(const LandmarkIndicators& indicators, ByteWriter& writer) {
  writer.put(indicators.frames);
  writer.put(indicators.rms_px);
  for (const ValueRange* range :
       {&indicators.distance, &indicators.lateral, &indicators.depth, &indicators.angle_deg})
    put(*range, writer);
  writer.put(indicators.max_ray_angle_deg);
}

void get(BinaryReader& reader, LandmarkIndicators& indicators) {
  indicators.frames = reader.get<int>();
  indicators.rms_px = reader.get<double>();
  for (ValueRange* range :
       {&indicators.distance, &indicators.lateral, &indicators.depth, &indicators.angle_deg})
    get(reader, *range);
  indicators.max_ray_angle_deg = reader.get<double>();
}

void put(const Rigid3& transform, ByteWriter& writer) {
  for (const double value : transform.rotation.coeffs()) writer.put(value);
  put_matrix(transform.translation, writer);
}

Rigid3 get_transform(BinaryReader& reader) {
  Rigid3 transform;
  for (double& value : transform.rotation.coeffs()) value = reader.get<double>();
  get_matrix(reader, transform.translation);
  return transform;
}

using ErrorNumbers = std::array<double, sizeof(LandmarkErrors) / sizeof(double)>;

void put(const LandmarkErrors& errors, ByteWriter& writer) {
  for (const double number : std::bit_cast<ErrorNumbers>(errors)) writer.put(number);
}

void get(BinaryReader& reader, LandmarkErrors& errors) {
  ErrorNumbers numbers{};
  for (double& number : numbers) number = reader.get<double>();
  errors = std::bit_cast<LandmarkErrors>(numbers);
}

void put(const LandmarkInformation& information, ByteWriter& writer) {
  put_matrix(information.pixels, writer);
  put_matrix(information.disparities, writer);
  put(information.errors, writer);
}

void get(BinaryReader& reader, LandmarkInformation& information) {
  get_matrix(reader, information.pixels);
  get_matrix(reader, information.disparities);
  get(reader, information.errors);
}

void put(const SurveyLandmark& landmark, ByteWriter& writer) {
  put(landmark.observations, writer);
  put_matrix(landmark.point_in_world, writer);
  put_matrix(landmark.cofactor, writer);
  writer.put(landmark.squared_error_sum);
  writer.put(landmark.redundancy);
  writer.put(landmark.variance_factor);
  put(landmark.information, writer);
  put_matrix(landmark.image_covariance, writer);
  put_matrix(landmark.pose_covariance, writer);
  put(landmark.indicators, writer);
}

void get(BinaryReader& reader, SurveyLandmark& landmark) {
  get(reader, landmark.observations);
  get_matrix(reader, landmark.point_in_world);
  get_matrix(reader, landmark.cofactor);
  landmark.squared_error_sum = reader.get<double>();
  landmark.redundancy = reader.get<int>();
  landmark.variance_factor = reader.get<double>();
  get(reader, landmark.information);
  get_matrix(reader, landmark.image_covariance);
  get_matrix(reader, landmark.pose_covariance);
  get(reader, landmark.indicators);
}

/// Returns the integers of SurveyCounts, in the order in which they are stored.
std::vector<std::int64_t*> fields_of(SurveyCounts& counts) {
  std::vector<std::int64_t*> fields{&counts.frames,
                                    &counts.without_pose,
                                    &counts.stationary,
                                    &counts.unreadable,
                                    &counts.features,
                                    &counts.measured,
                                    &counts.matched,
                                    &counts.tracks,
                                    &counts.too_short,
                                    &counts.inconsistent,
                                    &counts.dropped_observations};
  for (std::int64_t& cleaned : counts.cleaned) fields.push_back(&cleaned);
  for (std::int64_t& beyond : counts.beyond) fields.push_back(&beyond);
  fields.insert(fields.end(),
                {&counts.merged, &counts.landmarks, &counts.observations, &counts.dominated_by_poses});
  return fields;
}

std::array<double*, 4> sums_of(SurveyCounts& counts) {
  return {&counts.moved_squared_m, &counts.turned_squared_rad, &counts.image_variance_m2,
          &counts.pose_variance_m2};
}

void put(const VarianceModel::Sums& sums, ByteWriter& writer) {
  writer.put(sums.count);
  for (const double value : {sums.log, sums.log_squared, sums.noise}) writer.put(value);
}

VarianceModel::Sums get_sums(BinaryReader& reader) {
  VarianceModel::Sums sums;
  sums.count = reader.get<std::int64_t>();
  for (double* value : {&sums.log, &sums.log_squared, &sums.noise}) *value = reader.get<double>();
  return sums;
}

/// Returns the numbers of the noise, in the order in which they are stored.
std::array<double*, 9> fields_of(LandmarkNoise& noise) {
  return {&noise.pixel_scale, &noise.disparity_scale, &noise.own.freedom,
          &noise.own.scale,   &noise.disparities[0],  &noise.disparities[1],
          &noise.pixels[0],   &noise.pixels[1],       &noise.pixels[2]};
}

void put(const LandmarkNoiseModel& model, ByteWriter& writer) {
  put(model.samples(), writer);
  writer.put(model.count());
  LandmarkNoise noise = model.noise();
  for (const double* field : fields_of(noise)) writer.put(*field);
}

LandmarkNoiseModel get_noise(BinaryReader& reader) {
  std::vector<LandmarkErrors> samples;
  get(reader, samples);
  const auto count = reader.get<std::int64_t>();
  LandmarkNoise noise;
  for (double* field : fields_of(noise)) *field = reader.get<double>();
  return {std::move(samples), count, noise};
}

/// Stores a frame without its features and its given pose, which a run that resumes has again.
void put(const SurveyFrame& frame, ByteWriter& writer) {
  writer.put(frame.id.value);
  writer.put(frame.observed.frame.value);
  put(frame.kept, writer);
  put(frame.landmarks, writer);
  put(frame.held_out, writer);
  put(frame.world_from_camera, writer);
  put(frame.odometry, writer);
  writer.put(static_cast<std::uint8_t>(frame.motion ? 1 : 0));
  if (!frame.motion) return;
  put(frame.motion->previous_from_this, writer);
  writer.put(frame.motion->rotation_variance);
  writer.put(frame.motion->translation_variance);
}

SurveyFrame get_frame(BinaryReader& reader) {
  SurveyFrame frame;
  frame.id.value = reader.get<std::int32_t>();
  frame.observed.frame.value = reader.get<std::int32_t>();
  get(reader, frame.kept);
  get(reader, frame.landmarks);
  get(reader, frame.held_out);
  frame.world_from_camera = WorldFromCamera(get_transform(reader));
  frame.camera_from_world = frame.world_from_camera.inverse();
  frame.odometry = WorldFromCamera(get_transform(reader));
  if (reader.get<std::uint8_t>() != 0) {
    frame.motion = VisualMotion{get_transform(reader)};
    frame.motion->rotation_variance = reader.get<double>();
    frame.motion->translation_variance = reader.get<double>();
  }
  return frame;
}

SurveyState get_state(BinaryReader& reader, const ObserveAgain& observe) {
  SurveyState state;
  state.next_in_sequence = reader.get<std::uint64_t>();
  state.next_frame.value = reader.get<std::int32_t>();
  state.next_landmark.value = reader.get<std::int32_t>();
  get(reader, state.tracks);
  get(reader, state.finished);
  state.first_open_pose.value = reader.get<std::int32_t>();
  get(reader, state.moves);
  get(reader, state.held_out);
  get(reader, state.pending);
  state.variance = VarianceModel(get_sums(reader));
  state.noise = get_noise(reader);
  for (std::int64_t* field : fields_of(state.counts)) *field = reader.get<std::int64_t>();
  for (double* sum : sums_of(state.counts)) *sum = reader.get<double>();
  const auto count = reader.get<std::uint64_t>();
  std::vector<SurveyFrame> frames;
  for (std::uint64_t i = 0; i < count; ++i) frames.push_back(get_frame(reader));
  observe(frames);
  for (SurveyFrame& frame : frames) state.frames.push_back(std::move(frame));
  return state;
}

}  // namespace

void write_checkpoint(const std::filesystem::path& folder, std::uint32_t identity, const SurveyState& state,
                      const MapWriterState& map) {
  BinaryWriter writer(kKind);
  writer.put(identity);
  map.put(writer);
  writer.put(static_cast<std::uint64_t>(state.next_in_sequence));
  writer.put(state.next_frame.value);
  writer.put(state.next_landmark.value);
  put(state.tracks, writer);
  put(state.finished, writer);
  writer.put(state.first_open_pose.value);
  put(state.moves, writer);
  put(state.held_out, writer);
  put(state.pending, writer);
  put(state.variance.sums(), writer);
  put(state.noise, writer);
  SurveyCounts counts = state.counts;
  for (const std::int64_t* field : fields_of(counts)) writer.put(*field);
  for (const double* sum : sums_of(counts)) writer.put(*sum);
  writer.put(static_cast<std::uint64_t>(state.frames.size()));
  for (const SurveyFrame& frame : state.frames.all()) put(frame, writer);
  const std::filesystem::path next = folder / kNextName;
  write_file(next, std::move(writer).finish());
  sync_to_disk(next);
  commit_file(next, folder / kName);
  sync_to_disk(folder);
}

std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& folder, std::uint32_t identity,
                                          const ObserveAgain& observe) {
  if (!has_checkpoint(folder)) return std::nullopt;
  try {
    BinaryReader reader(folder / kName, kKind);
    if (reader.get<std::uint32_t>() != identity) return std::nullopt;
    const MapWriterState writer = MapWriterState::get(reader);
    return Checkpoint{get_state(reader, observe), writer};
  } catch (const InputError&) {
    return std::nullopt;
  }
}

bool has_checkpoint(const std::filesystem::path& folder) {
  return std::filesystem::exists(folder / kName);
}

void remove_checkpoint(const std::filesystem::path& folder) {
  std::filesystem::remove(folder / kName);
}

}  // namespace cairn
