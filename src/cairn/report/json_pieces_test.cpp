// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/json_pieces.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace cairn {
namespace {

TEST(JsonPieces, keep_the_order_of_keys_and_end_with_a_line_break) {
  Json json;
  json["b"] = json_of(std::nullopt);
  json["a"] = json_of(Eigen::Vector3d(1, 2.5, -3));
  EXPECT_EQ(format_document(json), "{\n  \"b\": null,\n  \"a\": [\n    1.0,\n    2.5,\n    -3.0\n  ]\n}\n");
}

TEST(JsonPieces, replace_bytes_that_are_not_utf8) {
  EXPECT_EQ(format_document({{"file", "a\xff.png"}}), "{\n  \"file\": \"a\xef\xbf\xbd.png\"\n}\n");
}

TEST(JsonPieces, write_matrices_by_rows_and_rotations_as_x_y_z_w) {
  Eigen::Matrix<double, 2, 3> matrix;
  matrix << 1, 2, 3, 4, 5, 6;
  EXPECT_EQ(rows_of(matrix).dump(), "[[1.0,2.0,3.0],[4.0,5.0,6.0]]");
  Json json;
  add_similarity({2, Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5), {7, 8, 9}}, json);
  EXPECT_EQ(json.dump(), R"({"scale":2.0,"rotation_xyzw":[0.5,-0.5,0.5,0.5],"translation_m":[7.0,8.0,9.0]})");
}

}  // namespace
}  // namespace cairn
