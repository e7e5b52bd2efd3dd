// SPDX-License-Identifier: Apache-2.0
// Private to this room: vertices of PLY whose properties have lists among them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cairn/dense/point_records.h"

namespace cairn {

/// Describes a property of a PLY element: one value or, if `length` is set, a list of values behind their
/// number.
struct PlyProperty {
  PointField value;
  std::optional<PointField> length;  ///< the type of the number of values
};

/// Returns the vertices without the values of their lists, binary little endian: records of the other
/// properties. Throws InputError if the data is shorter than announced or a list has a length below 0.
[[nodiscard]] std::string binary_without_lists(const std::filesystem::path& path,
                                               const std::vector<PlyProperty>& properties,
                                               const PointData& data);

/// Returns the vertices without the values of their lists, as text: each line stays one, so that its number
/// is that of the file. What the other values are is left to whoever reads them. Throws InputError, with the
/// line, if a line has fewer or more values than its lists say.
[[nodiscard]] std::string text_without_lists(const std::filesystem::path& path,
                                             const std::vector<PlyProperty>& properties,
                                             const PointData& data);

}  // namespace cairn
