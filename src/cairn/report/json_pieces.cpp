// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/json_pieces.h"

#include <nlohmann/json.hpp>

namespace cairn {

std::string format_document(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json json_of(const std::optional<double>& value) {
  return value ? Json(*value) : nullptr;
}

Json json_of(const Eigen::Vector3d& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

Json json_of(const Eigen::Quaterniond& rotation) {
  return {rotation.x(), rotation.y(), rotation.z(), rotation.w()};
}

Json rows_of(const Eigen::MatrixXd& matrix) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.push_back(matrix(i, j));
    rows.push_back(row);
  }
  return rows;
}

void add_similarity(const Similarity3& map, Json& json) {
  json["scale"] = map.scale;
  json["rotation_xyzw"] = json_of(map.rotation);
  json["translation_m"] = json_of(map.translation);
}

}  // namespace cairn
