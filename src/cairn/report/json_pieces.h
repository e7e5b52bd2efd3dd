// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "cairn/geometry/alignment.h"

namespace cairn {

/// Holds a JSON document whose keys stay in the order in which they were added.
using Json = nlohmann::ordered_json;

/// Returns the document as text, two blanks deeper for each level, with a line break at the end. Bytes that
/// are not UTF-8, as names of files may have them, become U+FFFD.
[[nodiscard]] std::string format_document(const Json& json);

/// Returns null if there is no value.
[[nodiscard]] Json json_of(const std::optional<double>& value);
/// Returns the vector as an array.
[[nodiscard]] Json json_of(const Eigen::Vector3d& vector);
/// Returns the rotation as an array x, y, z, w.
[[nodiscard]] Json json_of(const Eigen::Quaterniond& rotation);
/// Returns the matrix as an array of its rows, each an array.
[[nodiscard]] Json rows_of(const Eigen::MatrixXd& matrix);
/// Adds the keys scale, rotation_xyzw and translation_m.
void add_similarity(const Similarity3& map, Json& json);

}  // namespace cairn
