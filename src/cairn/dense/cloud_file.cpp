// SPDX-License-Identifier: Apache-2.0
#include "cairn/dense/cloud_file.h"

#include "cairn/core/error.h"
#include "cairn/core/text.h"
#include "cairn/dense/pcd.h"
#include "cairn/dense/ply.h"

namespace cairn {
namespace {

bool ends_in(const std::filesystem::path& path, std::string_view extension) {
  return lower_case(path.extension().string()) == extension;
}

}  // namespace

bool is_cloud_file(const std::filesystem::path& path) {
  return ends_in(path, ".ply") || ends_in(path, ".pcd");
}

void require_cloud_file(const std::filesystem::path& path) {
  if (is_cloud_file(path)) return;
  throw InputError({path.string(), 0, "a file name that ends in .ply or .pcd",
                    path.has_extension() ? "'" + path.extension().string() + "'" : "no extension",
                    "Most programs read .ply; PCL's tools want .pcd."});
}

Cloud read_cloud(const std::filesystem::path& path) {
  require_cloud_file(path);
  return ends_in(path, ".ply") ? read_ply(path) : read_pcd(path);
}

void write_cloud(const std::filesystem::path& path, const Cloud& cloud) {
  require_cloud_file(path);
  ends_in(path, ".ply") ? write_ply(path, cloud) : write_pcd(path, cloud);
}

}  // namespace cairn
