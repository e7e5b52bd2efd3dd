// SPDX-License-Identifier: Apache-2.0
// The TUM RGB-D benchmark's layout (Sturm et al. 2012): rgb.txt and depth.txt list `stamp path`,
// groundtruth.txt the camera's poses. associations.txt, `stamp rgb stamp depth`, stands in where a list is
// missing: it is made from the lists and may hold a part of them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "cairn/core/error.h"
#include "cairn/core/text.h"
#include "cairn/sequence/association.h"
#include "cairn/sequence/formats.h"
#include "cairn/sequence/time_unit.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

struct StampedFile {
  std::int64_t stamp_ns;
  fs::path path;
};

/// The stamps' unit by their size: seconds, unless they were written as whole milli-, micro- or nanoseconds.
TimeUnit unit_of_stamps(const TextFile& file) {
  std::vector<std::string_view> stamps;
  for (const TextLine& line : file.lines()) stamps.push_back(line.fields.front());
  return infer_time_unit(stamps);
}

std::int64_t stamp_in(const TextFile& file, const TextLine& line, std::size_t field, TimeUnit unit) {
  std::int64_t stamp_ns = 0;
  if (!parse_stamp_in(unit, line.fields[field], stamp_ns)) {
    file.fail(line, "a time stamp in seconds", fmt::format("'{}'", line.fields[field]),
              "Correct or delete the line.");
  }
  return stamp_ns;
}

/// The path in a list, relative to the list's folder, without "./".
fs::path file_in(const fs::path& folder, std::string_view path) {
  return folder / fs::path(path).lexically_normal();
}

bool is_in_depth_folder(std::string_view path) {
  return fs::path(path).lexically_normal().string().starts_with("depth");
}

void expect_increasing(const TextFile& file, const TextLine& line, std::int64_t before,
                       std::int64_t stamp_ns) {
  if (stamp_ns > before) return;
  file.fail(line, fmt::format("a time stamp after {}", format_stamp(before)), format_stamp(stamp_ns),
            "Sort the file by time and remove double stamps.");
}

std::vector<StampedFile> read_list(const fs::path& folder, const char* name) {
  const TextFile file(folder / name);
  const TimeUnit unit = unit_of_stamps(file);
  std::vector<StampedFile> files;
  for (const TextLine& line : file.lines()) {
    file.expect_fields(line, 2, "stamp path");
    const std::int64_t stamp_ns = stamp_in(file, line, 0, unit);
    if (!files.empty()) expect_increasing(file, line, files.back().stamp_ns, stamp_ns);
    files.push_back({stamp_ns, file_in(folder, line.fields[1])});
  }
  return files;
}

std::vector<std::int64_t> stamps_of(const std::vector<StampedFile>& files) {
  std::vector<std::int64_t> stamps;
  for (const StampedFile& file : files) stamps.push_back(file.stamp_ns);
  return stamps;
}

bool has_lists(const fs::path& folder) {
  return fs::exists(folder / "rgb.txt") && fs::exists(folder / "depth.txt");
}

std::optional<fs::path> associations_file(const fs::path& folder) {
  for (const char* name : {"associations.txt", "association.txt", "associate.txt"}) {
    if (fs::exists(folder / name)) return folder / name;
  }
  return std::nullopt;
}

void add_frame(Sequence& sequence, const StampedFile& color, const StampedFile& depth) {
  const auto position = static_cast<std::int64_t>(sequence.frames.size());
  sequence.frames.push_back({color.stamp_ns, position, color.path, depth.path, {}});
  const double gap_s = 1e-9 * static_cast<double>(std::abs(color.stamp_ns - depth.stamp_ns));
  sequence.report.max_stamp_gap_s = std::max(sequence.report.max_stamp_gap_s, gap_s);
}

/// False where the lists name more than twice as many colour images: an associations file left over from an
/// excerpt would silently drop most of the recording.
bool covers_the_lists(const fs::path& associations, const fs::path& folder) {
  return 2 * TextFile(associations).lines().size() >= TextFile(folder / "rgb.txt").lines().size();
}

void list_associated(const fs::path& path, Sequence& sequence) {
  const TextFile file(path);
  const fs::path folder = path.parent_path();
  const TimeUnit unit = unit_of_stamps(file);
  for (const TextLine& line : file.lines()) {
    file.expect_fields(line, 4, "stamp rgb stamp depth");
    StampedFile color{stamp_in(file, line, 0, unit), file_in(folder, line.fields[1])};
    StampedFile depth{stamp_in(file, line, 2, unit), file_in(folder, line.fields[3])};
    if (is_in_depth_folder(line.fields[1]) && !is_in_depth_folder(line.fields[3])) std::swap(color, depth);
    if (!sequence.frames.empty())
      expect_increasing(file, line, sequence.frames.back().stamp_ns, color.stamp_ns);
    add_frame(sequence, color, depth);
  }
  const auto count = static_cast<std::int64_t>(sequence.frames.size());
  sequence.report.color_images = sequence.report.depth_images = count;
}

void list_by_time(const fs::path& folder, double max_gap_s, Sequence& sequence) {
  const auto color = read_list(folder, "rgb.txt");
  const auto depth = read_list(folder, "depth.txt");
  const auto pairs = associate_stamps(stamps_of(color), stamps_of(depth), std::llround(max_gap_s * 1e9));
  for (const auto& [i, j] : pairs) add_frame(sequence, color[i], depth[j]);
  sequence.report.color_images = static_cast<std::int64_t>(color.size());
  sequence.report.depth_images = static_cast<std::int64_t>(depth.size());
  if (pairs.empty() && !color.empty() && !depth.empty()) {
    throw InputError({(folder / "depth.txt").string(), 0,
                      fmt::format("depth images within {} s of the colour images", max_gap_s),
                      fmt::format("none; colour begins at {}, depth at {}", format_stamp(color[0].stamp_ns),
                                  format_stamp(depth[0].stamp_ns)),
                      "Check that both lists are of one recording and one clock."});
  }
}

/// The cameras of the benchmark, told by the folder's name (rgbd_dataset_freiburg1_desk, fr1_desk).
std::optional<Calibration> calibration_by_name(const fs::path& folder) {
  const std::string name = fs::weakly_canonical(folder).filename().string();
  for (const char* digit : {"1", "2", "3"}) {
    const bool named = name.find(std::string("freiburg") + digit) != std::string::npos ||
                       name.starts_with(std::string("fr") + digit + "_");
    if (named) return known_calibration(std::string("tum-fr") + digit);
  }
  return std::nullopt;
}

}  // namespace

bool is_tum(const fs::path& folder) {
  return has_lists(folder) || associations_file(folder);
}

void list_tum(const fs::path& folder, const SequenceOptions& options, Sequence& sequence) {
  sequence.format = "TUM";
  const auto associations = associations_file(folder);
  if (associations && (!has_lists(folder) || covers_the_lists(*associations, folder))) {
    list_associated(*associations, sequence);
    sequence.report.associated_by = associations->filename().string();
  } else {
    list_by_time(folder, options.max_stamp_gap_s, sequence);
    sequence.report.associated_by = "time, nearest stamp";
  }
  sequence.report.associated = static_cast<std::int64_t>(sequence.frames.size());
  if (fs::exists(folder / "groundtruth.txt"))
    sequence.truth = read_truth(folder / "groundtruth.txt", false, sequence.report);
  if (const auto calibration = calibration_by_name(folder)) {
    sequence.calibration = *calibration;
    sequence.calibration_source = "the TUM benchmark's camera, by the folder's name";
  }
}

}  // namespace cairn
