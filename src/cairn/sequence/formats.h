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

/// One pair of functions per format. `is_...` looks at names only; `list_...` fills frames, truth (of the
/// camera that the format's poses belong to, before rectification), report and, unless the user gave one, the
/// format's own calibration if it carries one.
[[nodiscard]] bool is_tum(const std::filesystem::path& folder);
void list_tum(const std::filesystem::path& folder, const SequenceOptions& options, Sequence& sequence);

[[nodiscard]] bool is_seven_scenes(const std::filesystem::path& folder);
void list_seven_scenes(const std::filesystem::path& folder, Sequence& sequence);

/// Grey stereo pairs of the KITTI odometry benchmark; carries its own calibration.
[[nodiscard]] bool is_kitti(const std::filesystem::path& folder);
void list_kitti(const std::filesystem::path& folder, Sequence& sequence);

/// Raw stereo pairs in the ASL layout; carries its own calibration.
[[nodiscard]] bool is_euroc(const std::filesystem::path& folder);
void list_euroc(const std::filesystem::path& folder, const SequenceOptions& options, Sequence& sequence);

/// Files named by their number in two folders, named by the options or by habit (rgb_index and dep_index, rgb
/// and depth, ...); poses in trajectory.txt, by number.
[[nodiscard]] bool is_numbered(const std::filesystem::path& folder, const SequenceOptions& options);
void list_numbered(const std::filesystem::path& folder, const SequenceOptions& options, Sequence& sequence);

/// What lies in a folder in the natural order of the names (2.png before 10.png), hidden files left out.
[[nodiscard]] std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder);
/// By its extension: png, jpg, jpeg, pgm, ppm.
[[nodiscard]] bool is_image_name(const std::filesystem::path& file);
/// The size of a camera's images, of which some may be missing, broken or of another size: that of the first
/// two that agree; where no two do, that of the first that can be read. InputError where none can.
[[nodiscard]] ImageSize size_of_images(std::span<const std::filesystem::path> images);
/// Digits only; nothing otherwise.
[[nodiscard]] std::optional<std::int64_t> parse_frame_number(std::string_view text);
/// Stamp of file number `number` where the format has no time: number / rate_hz. InputError where that is
/// more than an int64 of nanoseconds holds.
[[nodiscard]] std::int64_t stamp_of_number(std::int64_t number, double rate_hz);

/// Whether the frames' stamps are those of a clock. Elsewhere frames and the sequence's own poses have the
/// same stamps, made from numbers.
[[nodiscard]] bool has_clock(const Sequence& sequence);

/// Reads the true poses of a sequence, of any format with stamps (docs/poses.md), as the file states them.
/// Warnings go to the report. InputError for poses without stamps, and for those of a body unless
/// `is_of_body`.
[[nodiscard]] Trajectory read_truth(const std::filesystem::path& path, bool is_of_body,
                                    SequenceReport& report);

/// A TUM trajectory file whose first column holds whole numbers only: frame numbers, not seconds.
[[nodiscard]] bool has_frame_numbers(const std::filesystem::path& path);

}  // namespace cairn
