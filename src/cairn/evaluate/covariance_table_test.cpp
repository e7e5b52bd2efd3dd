// SPDX-License-Identifier: Apache-2.0
#include "cairn/evaluate/covariance_table.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "cairn/testing/core/message_of.h"
#include "cairn/testing/core/temporary_folder.h"

namespace cairn {
namespace {

/// Names of the 21 columns, each after a comma.
std::string columns(const std::string& prefix) {
  const char* const axes[] = {"rx", "ry", "rz", "x", "y", "z"};
  std::string text;
  for (int i = 0; i < 6; ++i)
    for (int k = i; k < 6; ++k) text += fmt::format(",{}{}_{}", prefix, axes[i], axes[k]);
  return text;
}

/// Values of the 21 columns: variances 1 to 6, `coupling` between rx and ry.
std::string values(double coupling = 0) {
  std::string text;
  for (int i = 0; i < 6; ++i)
    for (int k = i; k < 6; ++k)
      text += fmt::format(",{}", i == k ? i + 1.0 : i == 0 && k == 1 ? coupling : 0.0);
  return text;
}

const std::string kEmpty(21, ',');

class CovarianceTableTest : public testing::Test {
 protected:
  [[nodiscard]] CovarianceTable read(const std::string& text) const {
    return read_covariance_table(folder_.write("table.csv", text), kLocalizationPrefixes);
  }
  [[nodiscard]] std::string message(const std::string& text) const {
    return testkit::message_of([&] { return read(text); });
  }

  testkit::TemporaryFolder folder_;
};

TEST_F(CovarianceTableTest, ReadsLocalizations) {
  const CovarianceTable table =
      read("# comment\nframe,stamp_s,file,verdict" + columns("cov_") + "\n" + "4,1.500000000,a.png,good" +
           values(0.5) + "\n" + "5,2.500000000,b,1#.png,weak" + values(2) + "\n" +  // is indefinite
           "6,3.500000000,c.png,none" + kEmpty + "\r\n" + "7,4.500000000,d.png,good" + kEmpty + "\n");
  EXPECT_EQ(table.header_line, 2);
  ASSERT_EQ(table.prefixes, std::vector<std::string>{"cov_"});
  ASSERT_EQ(table.rows.size(), 3U);
  EXPECT_EQ(table.rows[0].stamp_ns, 1'500'000'000);
  EXPECT_EQ(table.rows[0].line, 3);
  EXPECT_FALSE(table.rows[0].is_weak);
  Matrix6d expected = Vector6d(1, 2, 3, 4, 5, 6).asDiagonal();
  expected(0, 1) = expected(1, 0) = 0.5;
  EXPECT_EQ(table.rows[0].covariances[0], expected);
  EXPECT_TRUE(table.rows[1].is_weak);
  EXPECT_FALSE(table.rows[1].covariances[0]);
  EXPECT_EQ(table.rows[2].stamp_ns, 4'500'000'000);
  EXPECT_FALSE(table.rows[2].covariances[0]);
}

TEST_F(CovarianceTableTest, ReadsBothSetsInTheirOrder) {
  const CovarianceTable table =
      read("stamp_s" + columns("cov_") + columns("abs_cov_") + "\n1" + values(0.5) + values(0.25) + "\n");
  ASSERT_EQ(table.prefixes, (std::vector<std::string>{"abs_cov_", "cov_"}));
  ASSERT_EQ(table.rows.size(), 1U);
  EXPECT_EQ((*table.rows[0].covariances[0])(0, 1), 0.25);
  EXPECT_EQ((*table.rows[0].covariances[1])(0, 1), 0.5);
}

TEST_F(CovarianceTableTest, TakesZerosAndInfinitiesForNotStated) {
  std::string zeros, infinite;
  for (int i = 0; i < 21; ++i) zeros += ",0", infinite += i == 0 ? ",inf" : ",nan";
  const CovarianceTable table = read("stamp_s" + columns("cov_") + "\n1" + zeros + "\n2" + infinite + "\n");
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_FALSE(table.rows[0].covariances[0]);
  EXPECT_FALSE(table.rows[1].covariances[0]);
}

TEST_F(CovarianceTableTest, HasNoSetWithoutColumns) {
  EXPECT_TRUE(read("stamp_s,std_x_m\n1,0.1\n").prefixes.empty());
}

TEST_F(CovarianceTableTest, SaysWhatIsWrong) {
  const std::string head = "stamp_s" + columns("cov_") + "\n";
  EXPECT_NE(message("# nothing\n").find("table.csv:1: expected a line that names the columns"),
            std::string::npos);
  EXPECT_NE(message("t\n1\n").find(":1: expected a column stamp_s"), std::string::npos);
  EXPECT_NE(message("stamp_s,cov_rx_rx\n1,1\n")
                .find(":1: expected 21 columns cov_rx_rx to cov_z_z, found none "
                      "of the name cov_rx_ry"),
            std::string::npos);
  EXPECT_NE(message(head + "1,2\n").find(":2: expected 22 values, one for each column, found 2"),
            std::string::npos);
  EXPECT_NE(message(head + "x" + values() + "\n").find(":2: expected seconds in stamp_s, found 'x'"),
            std::string::npos);
  EXPECT_NE(message(head + "1,q" + values().substr(2) + "\n")
                .find(":2: expected a number for cov_rx_rx, found 'q'"),
            std::string::npos);
  EXPECT_NE(
      message(head + "1," + values().substr(2) + "\n").find("expected a number for cov_rx_rx, found ''"),
      std::string::npos);
  EXPECT_NE(
      message(head + "2" + values() + "\n2" + values() + "\n").find(":3: expected a time stamp after 2.0"),
      std::string::npos);
  EXPECT_NE(message(head + "1" + values(2) + "\n")
                .find(":2: expected a positive definite covariance in cov_rx_rx to cov_z_z"),
            std::string::npos);
  EXPECT_NE(
      message("stamp_s,verdict\n1,fine\n").find(":2: expected the verdict good, weak or none, found 'fine'"),
      std::string::npos);
}

}  // namespace
}  // namespace cairn
