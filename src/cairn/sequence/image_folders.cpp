// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/image_folders.h"

#include <fmt/format.h>
#include <glob.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string_view>

#include "cairn/core/error.h"
#include "cairn/core/text.h"
#include "cairn/sequence/formats.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

/// The usual places of two series, relative to the sequence; `*` stands for what tells the files apart.
struct Habit {
  std::string_view first, second;
  bool is_stereo = false;
};

constexpr std::array kHabits{
    Habit{"rgb_index/*", "dep_index/*"},
    Habit{"rgb_png/*", "depth_png/*"},
    Habit{"rgb/*", "depth/*"},
    Habit{"color/*", "depth/*"},
    Habit{"colour/*", "depth/*"},
    Habit{"image/*", "depth/*"},
    Habit{"images/*", "depth/*"},
    Habit{"results/frame*", "results/depth*"},
    Habit{"frame*", "depth*"},
    Habit{"color*", "depth*"},
    Habit{"rgb*", "depth*"},
    Habit{"*color", "*depth"},
    Habit{"*rgb", "*depth"},
    Habit{"left/*", "right/*", true},
    Habit{"left/data/*", "right/data/*", true},
    Habit{"image_left/*", "image_right/*", true},
    Habit{"cam0/*", "cam1/*", true},
    Habit{"cam0/data/*", "cam1/data/*", true},
    Habit{"mav0/cam0/data/*", "mav0/cam1/data/*", true},
    Habit{"image_0/*", "image_1/*", true},
    Habit{"image_2/*", "image_3/*", true},
    Habit{"image_00/data/*", "image_01/data/*", true},
    Habit{"image_02/data/*", "image_03/data/*", true},
    Habit{"infra1/*", "infra2/*", true},
    Habit{"left*", "right*", true},
    Habit{"*left", "*right", true},
    Habit{"cam0*", "cam1*", true},
};

/// Returns the folder of that name, whatever the case of its letters; an empty path if there is none.
fs::path folder_named(const fs::path& parent, const fs::path& name) {
  fs::path found = parent;
  for (const fs::path& part : name) {
    if (!fs::is_directory(found / part)) {
      const auto entries = files_in(found);
      const auto same = std::find_if(entries.begin(), entries.end(), [&](const fs::path& entry) {
        return fs::is_directory(entry) && lower_case(entry.filename().string()) == lower_case(part.string());
      });
      if (same == entries.end()) return {};
      found = *same;
    } else {
      found /= part;
    }
  }
  return found;
}

/// Returns what stands for the `*` of a pattern in a name, without separators at its ends; nothing if the
/// name is of another pattern.
std::optional<std::string> varying_part(const std::string& stem, const std::string& pattern) {
  const std::size_t star = pattern.find('*');
  const std::string before = pattern.substr(0, star), after = pattern.substr(star + 1);
  const std::string lower = lower_case(stem);
  if (stem.size() <= before.size() + after.size() || !lower.starts_with(before) || !lower.ends_with(after))
    return std::nullopt;
  std::string part = stem.substr(before.size(), stem.size() - before.size() - after.size());
  if (before.empty() && after.empty()) return part;
  constexpr std::string_view kSeparators = "_-. ";
  part.erase(0, std::min(part.find_first_not_of(kSeparators), part.size()));
  part.erase(part.find_last_not_of(kSeparators) + 1);
  return part.empty() ? std::nullopt : std::optional(part);
}

std::string place_of_pattern(std::string_view pattern) {
  return std::string(pattern.ends_with("/*") ? pattern.substr(0, pattern.size() - 1) : pattern);
}

/// Lists the images of a usual place; none if it is not there.
ImageSide side_at(const fs::path& folder, std::string_view pattern) {
  const fs::path path(pattern);
  ImageSide side{place_of_pattern(pattern), {}};
  const fs::path place = folder_named(folder, path.parent_path());
  if (place.empty()) return side;
  for (const fs::path& file : files_in(place)) {
    if (!is_image_name(file)) continue;
    const auto name = varying_part(file.stem().string(), path.filename().string());
    if (name) side.files.push_back({file, *name});
  }
  return side;
}

std::string without_dot(const std::string& extension) {
  return extension.starts_with('.') ? extension.substr(1) : extension;
}

bool fits(const fs::path& file, const std::string& extension) {
  return extension.empty() ? is_image_name(file)
                           : file.extension() == fmt::format(".{}", without_dot(extension));
}

/// Returns the last folder that a path names, with or without a slash after it.
fs::path last_folder(const fs::path& path) {
  return path.has_filename() ? path.filename() : path.parent_path().filename();
}

/// Finds a folder that parameters name: in the sequence's folder, else from where the program runs, as old
/// parameter files have it. A file that was written elsewhere names folders that are not here; then the
/// sequence's folder of that name is taken.
fs::path resolve(const fs::path& folder, const std::string& name, const char* key, std::string& warning) {
  fs::path path(name), inside = folder / path, own = folder / last_folder(path);
  if (!path.is_absolute() && fs::exists(inside)) return inside;
  if (fs::exists(path) || !fs::is_directory(own)) return path;
  warning = fmt::format("{} '{}' is no folder here; '{}' is taken instead", key, name, own.string());
  return own;
}

/// Lists a folder that parameters name.
ImageSide side_in(const fs::path& folder, const std::string& name, const char* key,
                  const std::string& extension) {
  ImageSide side{name, {}};
  const fs::path place = resolve(folder, name, key, side.warning);
  if (!fs::is_directory(place)) {
    throw InputError(
        {place.string(), 0, "a folder with images", "no such folder", "Check rgb_dir and depth_dir."});
  }
  for (const fs::path& file : files_in(place))
    if (fits(file, extension)) side.files.push_back({file, file.stem().string()});
  return side;
}

std::vector<fs::path> files_like(const std::string& pattern) {
  glob_t found{};
  const int status = ::glob(pattern.c_str(), 0, nullptr, &found);
  const std::unique_ptr<glob_t, void (*)(glob_t*)> owner(&found, ::globfree);
  if (status != 0) return {};
  return {found.gl_pathv, found.gl_pathv + found.gl_pathc};
}

/// Lists the images of a pattern of the command line, or those of a folder: in the sequence's folder, else
/// from where the program runs.
ImageSide side_like(const fs::path& folder, const std::string& pattern, const char* option) {
  ImageSide side{pattern, {}};
  for (const std::string& place : {(folder / pattern).string(), pattern}) {
    const auto files = fs::is_directory(place) ? files_in(place) : files_like(place);
    for (const fs::path& file : files)
      if (is_image_name(file)) side.files.push_back({file, file.stem().string()});
    if (!side.files.empty()) return side;
  }
  throw InputError({option, 0, "a pattern or a folder of images, in the sequence's folder or from here",
                    fmt::format("no image like '{}'", pattern),
                    "Put the pattern in quotes, for example 'left/*.png'."});
}

/// Throws InputError if one of two options is given without the other.
bool are_both_given(const std::string& first, const std::string& second, const char* first_name,
                    const char* second_name, const char* remedy) {
  if (first.empty() == second.empty()) return !first.empty();
  const bool lacks_first = first.empty();
  throw InputError({lacks_first ? first_name : second_name, 0,
                    fmt::format("a folder beside {}", lacks_first ? second_name : first_name), "none",
                    remedy});
}

std::optional<ImagePair> named_pair(const fs::path& folder, const SequenceOptions& options) {
  constexpr const char* kBoth = "Give both, or none for the folders' usual names.";
  const bool has_stereo = are_both_given(options.left, options.right, "--left", "--right", kBoth);
  const bool has_depth = are_both_given(options.color, options.depth, "--color", "--depth", kBoth);
  if (has_stereo && has_depth) {
    throw InputError({"--color and --depth", 0, "either these, or --left and --right", "all of them",
                      "A sequence has RGB-D images or stereo pairs: leave two out."});
  }
  if (has_stereo)
    return ImagePair{true, side_like(folder, options.left, "--left"),
                     side_like(folder, options.right, "--right")};
  if (has_depth)
    return ImagePair{false, side_like(folder, options.color, "--color"),
                     side_like(folder, options.depth, "--depth")};
  if (!are_both_given(options.rgb_dir, options.depth_dir, "rgb_dir", "depth_dir", kBoth)) return std::nullopt;
  return ImagePair{false, side_in(folder, options.rgb_dir, "rgb_dir", options.rgb_extension),
                   side_in(folder, options.depth_dir, "depth_dir", options.depth_extension)};
}

std::string count_of_images(const ImageSide& side) {
  return fmt::format("{} image{}", side.files.size(), side.files.size() == 1 ? "" : "s");
}

std::string describe_missing(const fs::path& folder, std::string_view pattern) {
  const fs::path place = folder_named(folder, fs::path(pattern).parent_path());
  if (place.empty()) return fmt::format("{} is missing", place_of_pattern(pattern));
  const auto files = files_in(place);
  if (!pattern.ends_with("/*") || files.empty()) return fmt::format("{} is missing", pattern);
  return fmt::format("{} holds no PNG, JPEG, PGM or PPM image but {}", place_of_pattern(pattern),
                     files.front().filename().string());
}

}  // namespace

std::optional<ImagePair> find_image_pair(const fs::path& folder, const SequenceOptions& options) {
  if (auto named = named_pair(folder, options)) return named;
  for (const Habit& habit : kHabits) {
    ImagePair pair{habit.is_stereo, side_at(folder, habit.first), {}};
    if (pair.first.files.empty()) continue;
    pair.second = side_at(folder, habit.second);
    if (!pair.second.files.empty()) return pair;
  }
  return std::nullopt;
}

std::string describe_nearest_layout(const fs::path& folder) {
  std::string nearest;
  std::size_t most = 0;
  for (const Habit& habit : kHabits) {
    const ImageSide first = side_at(folder, habit.first), second = side_at(folder, habit.second);
    const ImageSide& present = first.files.empty() ? second : first;
    if (present.files.size() <= most) continue;
    most = present.files.size();
    nearest = fmt::format("{} holds {}, {}", present.place, count_of_images(present),
                          describe_missing(folder, first.files.empty() ? habit.first : habit.second));
  }
  if (!nearest.empty()) return nearest;
  const ImageSide all = side_at(folder, "*");
  return all.files.empty() ? "" : fmt::format("{} of one camera", count_of_images(all));
}

}  // namespace cairn
