// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <map>

#include "cairn/core/error.h"
#include "cairn/core/text.h"
#include "cairn/sequence/formats.h"
#include "cairn/sequence/trajectory_file.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

struct FolderPair {
  std::string color, depth;
};

const std::array<FolderPair, 5> kHabits{{{"rgb_index", "dep_index"},
                                         {"rgb_png", "depth_png"},
                                         {"rgb", "depth"},
                                         {"color", "depth"},
                                         {"image", "depth"}}};

/// The last folder that a path names, with or without a slash after it.
fs::path last_folder(const fs::path& path) {
  return path.has_filename() ? path.filename() : path.parent_path().filename();
}

/// In the sequence's folder, else from where the program runs, as old parameter files have it. A file that
/// was written elsewhere names folders that are not here; then the sequence's folder of that name is taken.
fs::path resolve(const fs::path& folder, const std::string& name, const char* key, SequenceReport& report) {
  fs::path path(name), inside = folder / path, own = folder / last_folder(path);
  if (!path.is_absolute() && fs::exists(inside)) return inside;
  if (fs::exists(path) || !fs::is_directory(own)) return path;
  report.warnings.push_back(
      fmt::format("{} '{}' is no folder here; '{}' is taken instead", key, name, own.string()));
  return own;
}

std::string without_dot(const std::string& extension) {
  return extension.starts_with('.') ? extension.substr(1) : extension;
}

bool fits(const fs::path& file, const std::string& extension) {
  return extension.empty() ? is_image_name(file)
                           : file.extension() == fmt::format(".{}", without_dot(extension));
}

/// Files <number>.<extension> by number; any image where no extension is given.
std::map<std::int64_t, fs::path> numbered_files(const fs::path& folder, const std::string& extension) {
  if (!fs::is_directory(folder)) {
    throw InputError({folder.string(), 0, "a folder with numbered images", "no such folder",
                      "Check rgb_dir and depth_dir."});
  }
  std::map<std::int64_t, fs::path> files;
  for (const fs::path& file : files_in(folder)) {
    const auto number = parse_frame_number(file.stem().string());
    if (number && fits(file, extension)) files.emplace(*number, file);
  }
  return files;
}

bool has_numbered_files(const fs::path& folder) {
  return fs::is_directory(folder) && !numbered_files(folder, "").empty();
}

std::optional<FolderPair> folders(const fs::path& folder, const SequenceOptions& options) {
  if (options.rgb_dir.empty() != options.depth_dir.empty()) {
    throw InputError({options.rgb_dir.empty() ? "rgb_dir" : "depth_dir", 0,
                      fmt::format("a folder beside {}", options.rgb_dir.empty() ? "depth_dir" : "rgb_dir"),
                      "none", "Give both, or none for the folders' usual names."});
  }
  if (!options.rgb_dir.empty()) return FolderPair{options.rgb_dir, options.depth_dir};
  for (const FolderPair& habit : kHabits) {
    if (has_numbered_files(folder / habit.color) && has_numbered_files(folder / habit.depth)) return habit;
  }
  return std::nullopt;
}

void read_numbered_truth(const fs::path& path, Sequence& sequence) {
  if (!fs::exists(path) || !has_frame_numbers(path)) return;
  TrajectoryFile file = read_trajectory_file(path, {.may_have_numbers = true});
  if (file.key != PoseKey::number) return;
  for (StampedPose& pose : file.poses)
    pose.stamp_ns = stamp_of_number(pose.stamp_ns, sequence.calibration.stamp_rate_hz());
  sequence.truth = std::move(file.poses);
  sequence.report.warnings.insert(sequence.report.warnings.end(), file.warnings.begin(), file.warnings.end());
}

}  // namespace

bool is_numbered(const fs::path& folder, const SequenceOptions& options) {
  return folders(folder, options).has_value();
}

void list_numbered(const fs::path& folder, const SequenceOptions& options, Sequence& sequence) {
  sequence.format = "numbered";
  sequence.has_times = sequence.calibration.rate_hz.has_value();
  const FolderPair names = folders(folder, options).value();
  const auto color =
      numbered_files(resolve(folder, names.color, "rgb_dir", sequence.report), options.rgb_extension);
  const auto depth =
      numbered_files(resolve(folder, names.depth, "depth_dir", sequence.report), options.depth_extension);
  for (const auto& [number, path] : color) {
    const auto partner = depth.find(number);
    if (partner == depth.end()) continue;
    sequence.frames.push_back(
        {stamp_of_number(number, sequence.calibration.stamp_rate_hz()), number, path, partner->second, {}});
  }
  sequence.report.color_images = static_cast<std::int64_t>(color.size());
  sequence.report.depth_images = static_cast<std::int64_t>(depth.size());
  sequence.report.associated = static_cast<std::int64_t>(sequence.frames.size());
  read_numbered_truth(folder / "trajectory.txt", sequence);
}

}  // namespace cairn
