// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/matrix_pose.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <string_view>

#include "cairn/core/error.h"
#include "cairn/core/text.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

/// NaN and infinities, as recordings have them where tracking was lost.
bool is_no_number(std::string_view text) {
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  const std::string lower = lower_case(text.substr(0, 3));
  return lower == "nan" || lower == "inf";
}

void expect_four_lines(const TextFile& file) {
  if (file.lines().size() != 4)
    throw InputError({file.path().string(), 0, "4 lines, a 4x4 matrix",
                      fmt::format("{} lines", file.lines().size()), "Correct or delete the file."});
}

/// Reads a number of a matrix; returns false for NaN and infinities.
bool read_element(const TextFile& file, const TextLine& line, std::size_t field, double& value) {
  if (is_no_number(line.fields[field])) return false;
  value = file.number(line, field, "the matrix");
  return true;
}

std::optional<Eigen::Matrix4d> read_matrix(const TextFile& file) {
  expect_four_lines(file);
  bool finite = true;
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
  for (std::size_t i = 0; i < 16; ++i) {
    const TextLine& line = file.lines()[i / 4];
    file.expect_fields(line, 4, "a row of a 4x4 matrix");
    finite = read_element(file, line, i % 4,
                          matrix(static_cast<Eigen::Index>(i / 4), static_cast<Eigen::Index>(i % 4))) &&
             finite;
  }
  return finite ? std::optional(matrix) : std::nullopt;
}

/// Returns the motion of a matrix that stands on the lines `first` to `last`; nullopt for a lost one.
std::optional<WorldFromCamera> motion_of(const TextFile& file, const TextLine& first, const TextLine& last,
                                         const Eigen::Matrix4d& matrix) {
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
  if (rotation.isZero(0)) return std::nullopt;
  constexpr double kMaxDeviation = 0.05;
  const double deviation = (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm();
  if (!(deviation < kMaxDeviation) || rotation.determinant() < 0) {
    file.fail(first, "a rotation in the first three rows and columns",
              fmt::format("a matrix with determinant {:.4g}, {:.2g} from orthogonal", rotation.determinant(),
                          deviation),
              "Check that it is world_from_camera, or delete the file.");
  }
  if (!(matrix.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).isZero(1e-6)) {
    file.fail(last, "a last row 0 0 0 1", "another",
              "Check that the matrix is written by rows, the translation in the last column.");
  }
  return WorldFromCamera({Eigen::Quaterniond(rotation).normalized(), matrix.topRightCorner<3, 1>()});
}

}  // namespace

std::optional<Eigen::Matrix4d> read_matrix_file(const fs::path& path) {
  return read_matrix(TextFile(path));
}

std::optional<WorldFromCamera> read_matrix_pose(const fs::path& path) {
  const TextFile file(path);
  const auto matrix = read_matrix(file);
  return matrix ? motion_of(file, file.lines().front(), file.lines().back(), *matrix) : std::nullopt;
}

std::vector<std::optional<WorldFromCamera>> read_matrix_lines(const fs::path& path) {
  const TextFile file(path);
  std::vector<std::optional<WorldFromCamera>> poses;
  for (const TextLine& line : file.lines()) {
    file.expect_fields(line, 16, "a 4x4 matrix by rows");
    bool finite = true;
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
    for (std::size_t i = 0; i < 16; ++i)
      finite = read_element(file, line, i,
                            matrix(static_cast<Eigen::Index>(i / 4), static_cast<Eigen::Index>(i % 4))) &&
               finite;
    poses.push_back(finite ? motion_of(file, line, line, matrix) : std::nullopt);
  }
  return poses;
}

}  // namespace cairn
