// SPDX-License-Identifier: Apache-2.0
#include "cairn/map_files/uvlist.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "cairn/core/checksum.h"
#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/testing/core/temporary_folder.h"

namespace cairn {
namespace {

using testkit::TemporaryFolder;

TEST(Uvlist, tells_how_a_landmark_was_seen) {
  const Eigen::Matrix3d covariance = Eigen::Vector3d(0.01, 0.04, 0.25).asDiagonal();
  LandmarkIndicators indicators;
  indicators.frames = 2;
  indicators.rms_px = std::sqrt(2.0);
  indicators.distance = {4.5, 4, 5, 0.5};
  indicators.lateral = {1.5, 0, 3, 1.5};
  indicators.depth = {4, 4, 4, 0};
  indicators.angle_deg = {18.4349488, 0, 36.8698976, 18.4349488};
  EXPECT_EQ(format_uvlist_row(7, {3, 0, 4}, covariance, indicators),
            "7 3 0 4 2 0.1 0.2 0.5 1.41421 4.5 4 5 0.5 1.5 0 3 1.5 4 4 4 0 18.4349 0 36.8699 18.4349\n");
}

TEST(Uvlist, names_its_columns) {
  EXPECT_EQ(uvlist_header(),
            "# id x y z frames std_x std_y std_z rms_px mean_distance min_distance max_distance std_distance "
            "mean_lateral min_lateral max_lateral std_lateral mean_depth min_depth max_depth std_depth "
            "mean_angle_deg min_angle_deg max_angle_deg std_angle_deg\n");
}

std::string row(std::uint32_t number, double std) {
  LandmarkIndicators indicators;
  indicators.frames = static_cast<int>(number) + 3;
  return format_uvlist_row(number, {number / 3.0, -1e-7, 4}, std * std * Eigen::Matrix3d::Identity(),
                           indicators);
}

TEST(Uvlist, comes_back_row_by_row) {
  const TemporaryFolder folder;
  constexpr std::uint32_t kRows = 5000;  // more than is read at once
  std::string text = uvlist_header();
  for (std::uint32_t i = 0; i < kRows; ++i)
    text += row(i, i == 17 ? std::numeric_limits<double>::infinity() : 0.25);
  write_file(folder.path() / "uvlist.txt", text);
  UvlistStream stream(folder.path() / "uvlist.txt", crc32(text));
  for (std::uint32_t i = 0; i < kRows; ++i) {
    const std::vector<double>* values = stream.next();
    ASSERT_NE(values, nullptr);
    EXPECT_EQ(values->at(0), i);
    EXPECT_EQ(values->at(1), i / 3.0);
    EXPECT_EQ(values->at(4), i + 3);
    EXPECT_EQ(values->at(5), i == 17 ? std::numeric_limits<double>::infinity() : 0.25);
  }
  EXPECT_EQ(stream.next(), nullptr);
}

TEST(Uvlist, damage_is_found) {
  const TemporaryFolder folder;
  const std::string good = uvlist_header() + row(0, 0.5) + row(1, 0.5);
  const auto message = [&](const std::string& text) -> std::string {
    write_file(folder.path() / "uvlist.txt", text);
    try {
      UvlistStream stream(folder.path() / "uvlist.txt", crc32(good));
      while (stream.next() != nullptr) continue;
    } catch (const InputError& error) {
      return fmt::format("{}: {}, {}", error.details().line, error.details().expected, error.details().found);
    }
    return "none";
  };
  EXPECT_EQ(message(good), "none");
  EXPECT_EQ(message("# id\n" + row(0, 0.5)),
            "1: " + uvlist_header().substr(0, uvlist_header().size() - 1) + ", another first line");
  EXPECT_EQ(message(uvlist_header() + row(0, 0.5) + "1 2\n"), "3: 25 numbers, 2");
  EXPECT_EQ(message(uvlist_header() + "0 x\n"), "2: a number for 'x', 'x'");
  EXPECT_EQ(message(uvlist_header() + std::string(100'000, '1')), "2: a row of numbers, a longer line");
  const std::string damaged =
      "0: contents that fit their CRC-32 in map.json, others: the file is damaged or was changed";
  EXPECT_EQ(message(uvlist_header() + row(0, 0.5)), damaged);
  EXPECT_EQ(message(good.substr(0, good.size() - 1)), damaged);
  EXPECT_EQ(message(uvlist_header() + row(0, 0.5) + row(1, 0.25)), damaged);
}

}  // namespace
}  // namespace cairn
