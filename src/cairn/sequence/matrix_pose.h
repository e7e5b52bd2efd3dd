// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <vector>

#include "cairn/geometry/framed.h"

namespace cairn {

/// Reads a file of four lines of four numbers, a matrix by rows; nullopt where one of them is NaN or
/// infinite. Throws InputError with the line for anything else.
[[nodiscard]] std::optional<Eigen::Matrix4d> read_matrix_file(const std::filesystem::path& path);

/// Reads a file with the 4x4 matrix world_from_camera. Returns nullopt for the matrix of NaN, infinities or
/// zeros by which recordings say that tracking was lost there. Throws InputError for what is no motion.
[[nodiscard]] std::optional<WorldFromCamera> read_matrix_pose(const std::filesystem::path& path);

/// Reads a file with the sixteen numbers of a matrix world_from_camera on each line, by rows; nullopt for a
/// lost one. Throws InputError with the line for what is no motion.
[[nodiscard]] std::vector<std::optional<WorldFromCamera>> read_matrix_lines(
    const std::filesystem::path& path);

}  // namespace cairn
