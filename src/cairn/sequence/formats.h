// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "cairn/image/codec.h"
#include "cairn/sequence/sequence.h"

namespace cairn {

/// Tells whether a folder has the TUM layout. Each format has a pair of functions: `is_...` looks at names
/// only; `list_...` fills frames, truth (of the camera that the format's poses belong to, before
/// rectification), report and, unless the user gave one, the format's own calibration if it has one.
[[nodiscard]] bool is_tum(const std::filesystem::path& folder);
/// Lists the frames of a TUM sequence.
void list_tum(const std::filesystem::path& folder, const SequenceOptions& options, Sequence& sequence);

/// Tells whether a folder has the 7-Scenes layout.
[[nodiscard]] bool is_seven_scenes(const std::filesystem::path& folder);
/// Lists the frames of a 7-Scenes sequence.
void list_seven_scenes(const std::filesystem::path& folder, Sequence& sequence);

/// Tells whether a folder has the layout of the KITTI odometry benchmark: grey stereo pairs, with its own
/// calibration.
[[nodiscard]] bool is_kitti(const std::filesystem::path& folder);
/// Lists the stereo pairs of a KITTI sequence.
void list_kitti(const std::filesystem::path& folder, Sequence& sequence);

/// Tells whether a folder has the ASL layout: raw stereo pairs, with its own calibration.
[[nodiscard]] bool is_euroc(const std::filesystem::path& folder);
/// Lists the stereo pairs of an ASL sequence.
void list_euroc(const std::filesystem::path& folder, const SequenceOptions& options, Sequence& sequence);

/// Tells whether a folder holds two series of images, colour and depth or left and right, in two folders or
/// in one, given by the options or of usual names (image_folders.h).
[[nodiscard]] bool is_image_pairs(const std::filesystem::path& folder, const SequenceOptions& options);
/// Lists the frames of two series: their names hold stamps or numbers; poses are in pose/, traj.txt,
/// trajectory.txt (by number) or groundtruth.txt (by time).
void list_image_pairs(const std::filesystem::path& folder, const SequenceOptions& options,
                      Sequence& sequence);

/// Lists the files of a folder in the natural order of their names (2.png before 10.png), without hidden
/// ones.
[[nodiscard]] std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder);
/// Tells whether the extension is one of an image: png, jpg, jpeg, pgm, ppm.
[[nodiscard]] bool is_image_name(const std::filesystem::path& file);
/// Returns the size of a camera's images, of which some may be missing, broken or of another size: that of
/// the first two that agree, else that of the first that can be read. Throws InputError if none can be read.
[[nodiscard]] ImageSize size_of_images(std::span<const std::filesystem::path> images);
/// Parses a number that consists of digits only; returns nullopt otherwise.
[[nodiscard]] std::optional<std::int64_t> parse_frame_number(std::string_view text);
/// Returns the stamp of file number `number` of a format without time, number / rate_hz, nanoseconds. Throws
/// InputError if an int64 cannot hold it.
[[nodiscard]] std::int64_t stamp_of_number(std::int64_t number, double rate_hz);

/// Tells whether the frames' stamps are those of a clock. Otherwise frames and the sequence's own poses have
/// the same stamps, made from numbers.
[[nodiscard]] bool has_clock(const Sequence& sequence);

/// Reads the true poses of a sequence, of any format with stamps (docs/poses.md), as the file states them.
/// Warnings go to the report. Throws InputError for poses without stamps, and for those of a body unless
/// `is_of_body`.
[[nodiscard]] Trajectory read_truth(const std::filesystem::path& path, bool is_of_body,
                                    SequenceReport& report);

/// Tells whether the first column of a TUM trajectory file holds whole numbers only: frame numbers, not
/// seconds.
[[nodiscard]] bool has_frame_numbers(const std::filesystem::path& path);

}  // namespace cairn
