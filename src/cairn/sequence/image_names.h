// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace cairn {

/// Names a file of a series by the part of its name that tells it from its neighbours: of `left_0012.png`
/// among `left_*`, "0012".
struct SeriesFile {
  std::filesystem::path path;
  std::string name;
};

/// Says what distinguishes the files of a series.
enum class SeriesKey { stamp, number, name };

/// Holds one file of a series and its key: nanoseconds, a number, or the position in natural order.
struct KeyedFile {
  std::int64_t key = 0;
  SeriesFile file;
};

/// Holds a series in the order of its keys, which increase strictly.
struct KeyedSeries {
  SeriesKey kind = SeriesKey::name;
  std::vector<KeyedFile> files;
};

/// Reads the keys of a series from the names: the first number in them that increases from each file to the
/// next, in natural order. Numbers of the size of times since 1970 are stamps in seconds, milliseconds,
/// microseconds or nanoseconds; so are those with a fraction, and whole ones 1e5 or more apart (nanoseconds).
/// Files of the other pattern than most, and all but the first with one name, are left out. Without such a
/// number, the name itself is the key.
[[nodiscard]] KeyedSeries read_series(std::span<const SeriesFile> files);

}  // namespace cairn
