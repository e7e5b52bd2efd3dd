// SPDX-License-Identifier: Apache-2.0
#include "cairn/dense/point_records.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/testing/core/message_of.h"
#include "cairn/testing/core/temporary_folder.h"

namespace cairn {
namespace {

template <class... Values>
std::string bytes_of(Values... values) {
  std::string bytes;
  const auto append = [&](auto value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
  };
  (append(values), ...);
  return bytes;
}

/// Returns x as it is read from a field of this kind, with a value before it and two behind it.
float x_of(char kind, std::size_t size, const std::string& x) {
  const PointRecords records("cloud", {{"id", 'U', 2, 1}, {"x", kind, size, 1}, {"y"}, {"z"}});
  const std::string bytes = bytes_of(std::uint16_t{7}) + x + bytes_of(2.0F, 3.0F);
  EXPECT_EQ(records.bytes_per_point(), bytes.size());
  const Cloud cloud = records.read_binary({bytes, 1, 1});
  EXPECT_EQ(cloud.points.at(0).y, 2.0F);
  EXPECT_EQ(cloud.points.at(0).z, 3.0F);
  EXPECT_FALSE(cloud.colored);
  return cloud.points.at(0).x;
}

TEST(PointRecords, coordinates_are_read_from_every_type) {
  EXPECT_EQ(x_of('I', 1, bytes_of(std::int8_t{-5})), -5);
  EXPECT_EQ(x_of('U', 1, bytes_of(std::uint8_t{251})), 251);
  EXPECT_EQ(x_of('I', 2, bytes_of(std::int16_t{-500})), -500);
  EXPECT_EQ(x_of('U', 2, bytes_of(std::uint16_t{65000})), 65000);
  EXPECT_EQ(x_of('I', 4, bytes_of(std::int32_t{-70000})), -70000);
  EXPECT_EQ(x_of('U', 4, bytes_of(std::uint32_t{3000000000})), 3e9F);
  EXPECT_EQ(x_of('I', 8, bytes_of(std::int64_t{-5000000000})), -5e9F);
  EXPECT_EQ(x_of('U', 8, bytes_of(std::uint64_t{5000000000})), 5e9F);
  EXPECT_EQ(x_of('F', 4, bytes_of(1.25F)), 1.25F);
  EXPECT_EQ(x_of('F', 8, bytes_of(-1.25)), -1.25F);
}

TEST(PointRecords, a_field_of_several_values_is_skipped_as_a_whole) {
  const PointRecords records("cloud", {{"normal", 'F', 4, 3}, {"x"}, {"y"}, {"z"}});
  EXPECT_EQ(records.bytes_per_point(), 24U);
  const std::vector<CloudPoint> expected = {{1, 2, 3}};
  EXPECT_EQ(records.read_binary({bytes_of(7.F, 8.F, 9.F, 1.F, 2.F, 3.F), 1, 1}).points, expected);
  EXPECT_EQ(records.read_ascii({"7 8 9 1 2 3\n", 1, 1}).points, expected);
}

TEST(PointRecords, two_channels_are_no_colour) {
  const PointRecords records("cloud", {{"x"}, {"y"}, {"z"}, {"red", 'U', 1, 1}, {"green", 'U', 1, 1}});
  const Cloud cloud = records.read_binary({bytes_of(1.F, 2.F, 3.F) + "AB", 1, 1});
  EXPECT_FALSE(cloud.colored);
  EXPECT_EQ(cloud.points, (std::vector<CloudPoint>{{1, 2, 3}}));
}

TEST(PointRecords, points_without_a_measurement_are_left_out) {
  const PointRecords records("cloud", {{"x"}, {"y"}, {"z"}});
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  const std::string bytes = bytes_of(1.F, kNaN, 3.F, 4.F, 5.F, 6.F);
  EXPECT_EQ(records.read_binary({bytes, 2, 1}).points, (std::vector<CloudPoint>{{4, 5, 6}}));
  EXPECT_EQ(records.read_ascii({"1 nan 3\n4 5 6\n", 2, 1}).points, (std::vector<CloudPoint>{{4, 5, 6}}));
}

TEST(PointRecords, the_line_of_a_bad_value_is_named) {
  const PointRecords records("cloud", {{"x"}, {"y"}, {"z"}});
  EXPECT_TRUE(testkit::message_of([&] {
                return records.read_ascii({"1 2 3\n\n4 5 six\n", 2, 11});
              }).starts_with("cloud:13: expected a number for z, found 'six'"));
}

TEST(PointRecords, a_count_beyond_the_data_is_refused_before_memory_is_taken) {
  const PointRecords records("cloud", {{"x"}, {"y"}, {"z"}});
  constexpr std::size_t kHuge = std::size_t{1} << 60;
  EXPECT_THROW((void)records.read_binary({"123456789012", kHuge, 1}), InputError);
  EXPECT_THROW((void)records.read_ascii({"1 2 3\n", kHuge, 1}), InputError);
}

TEST(PointRecords, every_record_is_written_whatever_the_buffer) {
  const testkit::TemporaryFolder folder;
  for (const std::size_t count : {0U, 1U, 4095U, 4096U, 4097U, 8192U}) {
    Cloud cloud;
    std::string expected;
    for (std::size_t i = 0; i < count; ++i) {
      cloud.points.push_back({static_cast<float>(i), 0, 0});
      expected += bytes_of(static_cast<float>(i));
    }
    AtomicFile file(folder / "records");
    write_records(file, cloud, 4,
                  [](const CloudPoint& point, char* record) { std::memcpy(record, &point.x, 4); });
    file.commit();
    EXPECT_TRUE(folder.read("records") == expected) << count;
  }
}

TEST(PointRecords, lines_end_with_or_without_a_carriage_return) {
  std::size_t begin = 0;
  constexpr std::string_view kText = "one\r\n\ntwo";
  EXPECT_EQ(next_line(kText, begin), "one");
  EXPECT_EQ(next_line(kText, begin), "");
  EXPECT_EQ(next_line(kText, begin), "two");
  EXPECT_EQ(begin, kText.size());
  EXPECT_EQ(words_of(" a\tb  c "), (std::vector<std::string_view>{"a", "b", "c"}));
}

}  // namespace
}  // namespace cairn
