// SPDX-License-Identifier: Apache-2.0
#include "cairn/map_files/map_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "cairn/core/error.h"
#include "cairn/core/text.h"
#include "cairn/geometry/unit_rotation.h"
#include "cairn/map_files/frame_file.h"
#include "cairn/map_files/held_out_file.h"
#include "cairn/map_files/landmark_files.h"
#include "cairn/map_files/place_file.h"
#include "cairn/map_files/uvlist.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

constexpr const char* kAppendFolder = "spool";
constexpr std::array<const char*, MapWriterState::kAppendFiles> kAppendNames{"points", "sightings", "table",
                                                                             "poses",  "keyframes", "noise"};

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) fail_writing(folder, "make the folder", error.value());
}

/// Returns a line in the TUM format with all digits.
std::string format_pose(std::int64_t stamp_ns, const WorldFromCamera& world_from_camera) {
  const Eigen::Vector3d& t = world_from_camera.translation;
  const Eigen::Quaterniond q = unit_rotation(world_from_camera.rotation);
  return fmt::format("{} {} {} {} {} {} {} {}\n", format_stamp(stamp_ns), t.x(), t.y(), t.z(), q.x(), q.y(),
                     q.z(), q.w());
}

void check(const FinishedLandmark& landmark, const DescriptorKind& kind) {
  const std::vector<ObservationRef>& observations = landmark.observations;
  require(!observations.empty() && landmark.keypoints.size() == observations.size() &&
              landmark.descriptors.count() == observations.size(),
          "a landmark has sightings, each with a keypoint and a descriptor");
  require(landmark.descriptors.norm() == kind.norm && landmark.descriptors.bytes() == kind.bytes,
          "all descriptors of a map are of one kind");
  require(observations.front().keyframe.valid() &&
              std::is_sorted(
                  observations.begin(), observations.end(),
                  [](const ObservationRef& a, const ObservationRef& b) { return a.keyframe <= b.keyframe; }),
          "a landmark is seen once in a keyframe, and these increase");
}

}  // namespace

void MapWriterState::put(ByteWriter& writer) const {
  for (const AppendFileState& append_file : append_files) {
    writer.put(append_file.bytes);
    writer.put(append_file.checksum);
  }
  writer.put(frames);
  writer.put(landmarks);
  writer.put(features);
  writer.put(observations);
  writer.put(with_noise);
}

MapWriterState MapWriterState::get(BinaryReader& reader) {
  MapWriterState state;
  for (AppendFileState& append_file : state.append_files) {
    append_file.bytes = reader.get<std::uint64_t>();
    append_file.checksum = reader.get<std::uint32_t>();
  }
  state.frames = reader.get<std::int32_t>();
  state.landmarks = reader.get<std::uint32_t>();
  state.features = reader.get<std::uint64_t>();
  state.observations = reader.get<std::uint64_t>();
  state.with_noise = reader.get<std::uint32_t>();
  return state;
}

MapWriter::MapWriter(const fs::path& folder, const MapHeader& header) : folder_(folder), header_(header) {
  require(is_known_descriptor(header.descriptor.name), "a map's descriptor is one of descriptor_names()");
  open_append_files(nullptr);
  remove_frames_from(0);
}

MapWriter::MapWriter(const fs::path& folder, const MapHeader& header, const MapWriterState& state)
    : folder_(folder),
      header_(header),
      frames_(state.frames),
      landmarks_(state.landmarks),
      features_(state.features),
      observations_(state.observations),
      with_noise_(state.with_noise) {
  require(is_known_descriptor(header.descriptor.name), "a map's descriptor is one of descriptor_names()");
  open_append_files(&state);
  remove_frames_from(state.frames);
}

MapWriter::~MapWriter() = default;

void MapWriter::open_append_files(const MapWriterState* state) {
  make_folder(folder_ / kAppendFolder);
  make_folder(folder_ / "frames");
  for (std::size_t i = 0; i < append_files_.size(); ++i) {
    const fs::path path = folder_ / kAppendFolder / kAppendNames[i];
    append_files_[i] = state == nullptr ? std::make_unique<AppendFile>(path)
                                        : std::make_unique<AppendFile>(path, state->append_files[i]);
  }
}

/// Removes the files of frames from `first` on, also those that a crash left half written.
void MapWriter::remove_frames_from(std::int32_t first) const {
  std::vector<fs::path> kept;
  for (std::int32_t i = 0; i < first; ++i)
    kept.push_back(folder_ / frame_file_name({i}, header_.descriptor.name));
  std::sort(kept.begin(), kept.end());
  std::vector<fs::path> others;
  for (const auto& entry : fs::directory_iterator(folder_ / "frames"))
    if (!std::binary_search(kept.begin(), kept.end(), entry.path())) others.push_back(entry.path());
  for (const fs::path& other : others) {
    std::error_code error;
    fs::remove(other, error);
    if (error) fail_writing(other, "remove the file", error.value());
  }
}

void MapWriter::add_frame(const ObservedFrame& observed, std::span<const LandmarkId> landmarks,
                          const WorldFromCamera& world_from_camera, std::int32_t component) {
  const KeyframeId number{frames_};
  const std::string bytes = format_frame_file(number, observed, landmarks, header_.descriptor);
  unsaved_.push_back(folder_ / frame_file_name(number, header_.descriptor.name));
  write_file(unsaved_.back(), bytes);
  const KeyframeEntry entry{observed.frame, observed.stamp_ns, component, stored_checksum(bytes)};
  append_file(Part::keyframes).append(format_keyframe_entry(number, entry, header_.descriptor.name));
  append_file(Part::poses).append(format_pose(observed.stamp_ns, world_from_camera));
  features_ += observed.observations.size();
  ++frames_;
}

void MapWriter::add_landmark(const FinishedLandmark& landmark) {
  check(landmark, header_.descriptor);
  const auto count = static_cast<std::uint32_t>(landmark.observations.size());
  ByteWriter point, rows;
  put_landmark(landmarks_, {landmark.point_in_world, landmark.covariance, observations_, count}, point);
  for (std::size_t i = 0; i < count; ++i)
    put_observation(landmark.observations[i], landmark.keypoints[i], landmark.descriptors.row(i),
                    header_.descriptor, rows);
  append_file(Part::points).append(point.bytes());
  append_file(Part::observations).append(rows.bytes());
  append_file(Part::table)
      .append(
          format_uvlist_row(landmarks_, landmark.point_in_world, landmark.covariance, landmark.indicators));
  if (landmark.noise_covariance) {
    ByteWriter noise;
    put_noise(*landmark.noise_covariance, noise);
    append_file(Part::noise).append(noise.bytes());
    ++with_noise_;
  }
  observations_ += count;
  ++landmarks_;
}

MapWriterState MapWriter::save() {
  for (const fs::path& frame : unsaved_) sync_to_disk(frame);
  unsaved_.clear();
  for (const char* name : {"frames", kAppendFolder}) sync_to_disk(folder_ / name);
  MapWriterState state{{}, frames_, landmarks_, features_, observations_, with_noise_};
  for (std::size_t i = 0; i < append_files_.size(); ++i) state.append_files[i] = append_files_[i]->sync();
  return state;
}

void MapWriter::write_binary(const char* name, const BinaryWriter& begin, Part part, MapInfo& info) {
  BinaryFileWriter file(folder_ / name, begin);
  append_file(part).read([&](std::string_view piece) { file.write(piece); });
  info.checksums[name] = file.finish();
}

void MapWriter::write_text(const char* name, std::string_view begin, Part part, MapInfo& info) {
  AtomicFile file(folder_ / name);
  Crc32 checksum;
  const auto write = [&](std::string_view piece) {
    file.write(piece);
    checksum.add(piece);
  };
  write(begin);
  append_file(part).read(write);
  file.commit();
  info.checksums[name] = checksum.value();
}

void MapWriter::write_info(const MapInfo& info) {
  AtomicFile file(folder_ / kMapInfoFile);
  Crc32 checksum;
  const auto write = [&](std::string_view piece) {
    file.write(piece);
    checksum.add(piece);
  };
  write(format_map_info_begin(info, static_cast<std::size_t>(frames_)));
  append_file(Part::keyframes).read(write);
  write(format_map_info_end(info));
  file.write(format_map_info_seal(checksum.value()));
  file.commit();
}

void MapWriter::finish(std::span<const HeldOutFrame> held_out) {
  require(frames_ > 0, "a map to write has keyframes");
  MapInfo info{header_, {}, landmarks_, features_, observations_, {}};
  write_binary(kPointFile, begin_point_file(landmarks_, observations_), Part::points, info);
  write_binary(kDescriptorFile, begin_descriptor_file(header_.descriptor, observations_), Part::observations,
               info);
  if (with_noise_ > 0 && with_noise_ == landmarks_)
    write_binary(kNoiseFile, begin_noise_file(landmarks_), Part::noise, info);
  write_text(kPosesFile, "# t tx ty tz qx qy qz qw  (seconds, metres; world_from_camera)\n", Part::poses,
             info);
  write_text(kUvlistFile, uvlist_header(), Part::table, info);
  if (!held_out.empty()) {
    const std::string text = format_held_out(held_out);
    write_file(folder_ / kHeldOutFile, text);
    info.checksums[kHeldOutFile] = crc32(text);
  }
  info.checksums[kPlaceFile] = write_place_file(folder_, info, folder_ / kAppendFolder);
  write_info(info);  // last: it says that all others are there
}

void MapWriter::discard_append_files(const fs::path& folder) {
  std::error_code error;
  fs::remove_all(folder / kAppendFolder, error);
  if (error) fail_writing(folder / kAppendFolder, "remove the folder", error.value());
}

}  // namespace cairn
