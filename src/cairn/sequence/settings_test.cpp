// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/settings.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/sequence/setting_table.h"
#include "cairn/testing/core/message_of.h"
#include "cairn/testing/image/recording_folder.h"

namespace cairn {
namespace {

using testkit::message_of;
using testkit::RecordingFolder;

struct Fields {
  double threshold = 1.5;
  int count = 500;
  bool check = true;
  std::string detector = "ORB";
  std::optional<double> fx;
  std::optional<std::int64_t> start;
};

void visit(Fields& fields, ParameterVisitor& visitor) {
  visitor.parameter({"threshold", above(0, "pixels"), "A limit.", "max_norm"}, fields.threshold);
  visitor.parameter({"count", at_least(1, "feature"), "How many."}, fields.count);
  visitor.parameter({"check", {}, "Whether to look.", "check_loop"}, fields.check);
  visitor.retired({"mapping.old", "no", "it improved nothing"});
  visitor.retired({"mapping.size", "3", "nothing has a size"});
  visitor.parameter({"detector", any("a name"), "Which."}, fields.detector);
  visitor.parameter({"camera.fx", above(0, "pixels"), "Focal length."}, fields.fx);
  visitor.parameter({"start_index", any("a file number"), "Where to begin."}, fields.start);
}

SettingTable table_of(Fields& fields) {
  SettingTable table;
  visit(fields, table);
  return table;
}

/// Returns the warning of a setting given by --set.
std::string warning_of(Fields& fields, const std::string& key, const std::string& value) {
  return table_of(fields).apply({key, value, "--set", 0});
}

class SettingsTest : public testing::Test, protected RecordingFolder {
 protected:
  [[nodiscard]] Fields read(const std::string& text) const {
    Fields fields;
    const SettingTable table = table_of(fields);
    for (const Setting& setting : read_settings(write("settings", text))) (void)table.apply(setting);
    return fields;
  }
};

TEST_F(SettingsTest, yaml) {
  const Fields fields = read(
      "# mine\nthreshold: 2.25 # px\ncount: 7\ncheck: no\ndetector: \"a = b\"\ncamera.fx: 518\nstart_index: "
      "-3\n");
  EXPECT_EQ(fields.threshold, 2.25);
  EXPECT_EQ(fields.count, 7);
  EXPECT_FALSE(fields.check);
  EXPECT_EQ(fields.detector, "a = b");
  EXPECT_EQ(fields.fx, 518);
  EXPECT_EQ(fields.start, -3);
}

TEST_F(SettingsTest, yaml_whose_first_value_has_an_equals_sign) {
  EXPECT_EQ(read("detector: \"a=b\"\n").detector, "a=b");
  EXPECT_EQ(read("{detector: a=b}\n").detector, "a=b");
}

TEST_F(SettingsTest, lines_of_key_and_value) {
  const Fields fields = read(
      "# parameters\n\n  # more\nthreshold=2.25;\ncount = 7 # features\r\ncheck=no ; \t\ndetector = a:b\n"
      "camera.fx=518;# px\nstart_index=-3");
  EXPECT_EQ(fields.threshold, 2.25);
  EXPECT_EQ(fields.count, 7);
  EXPECT_FALSE(fields.check);
  EXPECT_EQ(fields.detector, "a:b");
  EXPECT_EQ(fields.fx, 518);
  EXPECT_EQ(fields.start, -3);
}

/// As parameter files of RGB-D SLAM programs have them.
TEST_F(SettingsTest, words_may_follow_the_value_of_a_line) {
  const Fields fields = read(
      "; old style\n// and older\ncount=10 \xE6\x9C\x80\xE5\xB0\x91 features\nthreshold=2.5; px\n"
      "check=yes\xEF\xBC\x8C"
      "always\ndetector=SIFT \xE7\x89\xB9\n");
  EXPECT_EQ(fields.count, 10);
  EXPECT_EQ(fields.threshold, 2.5);
  EXPECT_TRUE(fields.check);
  EXPECT_EQ(fields.detector, "SIFT");
}

TEST_F(SettingsTest, a_second_number_is_no_remark) {
  for (const char* text : {"count=10 20", "count=10; 20", "threshold=1 .5", "threshold=2 -3"})
    EXPECT_THROW((void)read(text), InputError) << text;
  EXPECT_THROW((void)read("count: 10 features"), InputError) << "YAML has comments";
}

TEST_F(SettingsTest, a_folder_may_have_blanks) {
  Fields fields;
  SettingTable table = table_of(fields);
  std::string folder;
  table.parameter({"rgb_dir", any("a folder"), "Where."}, folder);
  for (const Setting& setting : read_settings(write("settings", "rgb_dir=/my pictures/rgb;\n")))
    (void)table.apply(setting);
  EXPECT_EQ(folder, "/my pictures/rgb");
}

TEST_F(SettingsTest, the_first_line_of_opencv_is_no_setting) {
  const Fields fields = read("%YAML:1.0\n# data\ncamera.fx: 517.3\ncount: 500\n");
  EXPECT_EQ(fields.fx, 517.3);
  EXPECT_EQ(message_of([&] { return read("%YAML:1.0\ncoutn: 3"); }).substr(folder_.string().size(), 12),
            "/settings:2:");
}

TEST_F(SettingsTest, byte_order_marks_and_windows_line_ends_do_not_matter) {
  EXPECT_EQ(read("\xEF\xBB\xBF"
                 "count=7\r\n")
                .count,
            7);
  EXPECT_EQ(read("\xEF\xBB\xBF"
                 "count: 7\r\ncheck: off\r\n")
                .count,
            7);
}

TEST_F(SettingsTest, nothing_sets_nothing) {
  for (const char* text : {"", "\n\n", "# only a comment\n", "{}"}) EXPECT_EQ(read(text).count, 500) << text;
}

TEST_F(SettingsTest, truth_has_many_names) {
  for (const char* text : {"yes", "true", "True", "on", "ON", "1"})
    EXPECT_TRUE(read("check: " + std::string(text)).check) << text;
  for (const char* text : {"no", "false", "FALSE", "off", "0"})
    EXPECT_FALSE(read("check=" + std::string(text)).check) << text;
}

TEST_F(SettingsTest, later_lines_go_before_earlier_ones) {
  EXPECT_EQ(read("count=1\ncount=2\n").count, 2);
}

struct Case {
  const char* text;
  int line;
  const char* rest;
};

constexpr Case kBroken[] = {
    {"\ncoutn: 3", 2, "expected the name of a parameter, found 'coutn'.\n  Did you mean 'count'?"},
    {"count=1\ncamera.f=3", 2,
     "expected the name of a parameter, found 'camera.f'.\n  Did you mean 'camera.fx'?"},
    {"count: 3.5", 1, "expected a whole number for 'count', found '3.5'.\n  Correct the value."},
    {"count: 3000000000", 1,
     "expected a whole number for 'count', found '3000000000'.\n  Correct the value."},
    {"count=", 1, "expected a whole number for 'count', found ''.\n  Correct the value."},
    {"threshold: two", 1, "expected a number for 'threshold', found 'two'.\n  Correct the value."},
    {"threshold=nan", 1, "expected a number for 'threshold', found 'nan'.\n  Correct the value."},
    {"threshold=1,5", 1, "expected a number for 'threshold', found '1,5'.\n  Correct the value."},
    {"check=maybe", 1, "expected yes or no for 'check', found 'maybe'.\n  Correct the value."},
    {"start_index=1.0", 1, "expected a whole number for 'start_index', found '1.0'.\n  Correct the value."},
    {"count=1\nnonsense", 2, "expected key=value, found 'nonsense'.\n  Correct or delete the line."},
    {"count=1\n=5", 2, "expected key=value, found '=5'.\n  Correct or delete the line."},
    {"count:\n", 1,
     "expected a plain value for 'count', found a list, a mapping or nothing.\n  Write name: value."},
    {"count: [1]", 1,
     "expected a plain value for 'count', found a list, a mapping or nothing.\n  Write name: value."},
    {"- count", 1,
     "expected a mapping of names to values, found another kind of YAML.\n  Write name: value."},
    {"count: 1\n? [a]\n: 2", 2,
     "expected the name of a parameter, found ''.\n  --help lists all parameters."},
    {"count: 1\n\tcheck: x: y", 2, "expected YAML, or lines key=value, found "},
    {"count: \"1", 1, "expected YAML, or lines key=value, found "},
};

TEST_F(SettingsTest, broken_files_are_refused_by_line) {
  for (const Case& broken : kBroken) {
    const std::string message = message_of([&] { return read(broken.text); });
    const std::string place = (folder_ / "settings").string() + ":" + std::to_string(broken.line) + ": ";
    EXPECT_TRUE(message.starts_with(place + broken.rest)) << message;
  }
}

TEST_F(SettingsTest, a_missing_file_is_refused) {
  EXPECT_EQ(message_of([&] { return read_settings(folder_ / "none.yaml"); }),
            (folder_ / "none.yaml").string() +
                ": expected a readable file, found No such file or directory.\n"
                "  Check the path and its permissions.");
}

TEST(ParseSetting, splits_at_the_first_equals_sign) {
  const Setting setting = parse_setting(" detector = a=b ", "--set");
  EXPECT_EQ(setting.key, "detector");
  EXPECT_EQ(setting.value, "a=b");
  EXPECT_EQ(message_of([] { return parse_setting("detector", "--set"); }),
            "--set: expected key=value, found 'detector'.\n  For example --set min_inliers=30.");
}

TEST(SettingTable, a_refused_value_changes_nothing) {
  Fields fields;
  const SettingTable table = table_of(fields);
  for (const char* key : {"threshold", "count", "check", "camera.fx", "start_index"})
    EXPECT_THROW((void)table.apply({key, "7x", "--set", 0}), InputError);
  EXPECT_EQ(fields.threshold, 1.5);
  EXPECT_EQ(fields.count, 500);
  EXPECT_TRUE(fields.check);
  EXPECT_FALSE(fields.fx);
  EXPECT_FALSE(fields.start);
}

TEST(SettingTable, a_parameter_of_another_program_changes_nothing) {
  SettingTable table;
  table.retired({"visualize", "", "clouds are written, not shown"});
  EXPECT_EQ(table.apply({"visualize", "yes", "p.txt", 4}),
            "p.txt:4: 'visualize' changes nothing: clouds are written, not shown.");
  EXPECT_TRUE(table.knows("visualize"));
  EXPECT_FALSE(table.knows("visualise"));
}

TEST_F(SettingsTest, format_is_read_back) {
  Fields fields{1.0 / 3.0, std::numeric_limits<int>::min(), false, R"(C:\a "b" #c = d: e)", -1e-300, 12};
  const Fields back = read(table_of(fields).format());
  EXPECT_EQ(back.threshold, fields.threshold);
  EXPECT_EQ(back.count, fields.count);
  EXPECT_EQ(back.check, fields.check);
  EXPECT_EQ(back.detector, fields.detector);
  EXPECT_EQ(back.fx, fields.fx);
  EXPECT_EQ(back.start, fields.start);
  Fields defaults;
  EXPECT_FALSE(read(table_of(defaults).format()).fx);
}

TEST(SettingTable, a_former_name_sets_the_field_with_a_warning) {
  Fields fields;
  EXPECT_EQ(warning_of(fields, "threshold", "4"), "");
  EXPECT_EQ(warning_of(fields, "max_norm", "2"),
            "--set: 'max_norm' is now called 'threshold'; both are accepted.");
  EXPECT_EQ(fields.threshold, 2);
  EXPECT_EQ(table_of(fields).apply({"check_loop", "no", "p.yaml", 3}),
            "p.yaml:3: 'check_loop' is now called 'check'; both are accepted.");
  EXPECT_FALSE(fields.check);
  EXPECT_EQ(table_of(fields).format(), "threshold: 2\ncount: 500\ncheck: no\ndetector: \"ORB\"\n");
}

TEST_F(SettingsTest, the_later_one_of_both_names_counts) {
  EXPECT_EQ(read("max_norm: 2\nthreshold: 3\n").threshold, 3);
  EXPECT_EQ(read("threshold: 3\nmax_norm: 2\n").threshold, 2);
}

TEST(SettingTable, a_misspelt_former_name_is_answered_with_the_present_one) {
  Fields fields;
  EXPECT_EQ(message_of([&] { return warning_of(fields, "max_nrm", "2"); }),
            "--set: expected the name of a parameter, found 'max_nrm'.\n  Did you mean 'threshold'?");
}

TEST(SettingTable, a_retired_parameter_is_accepted_if_it_changes_nothing) {
  Fields fields;
  for (const char* no : {"no", "off", "False", "0"})
    EXPECT_EQ(warning_of(fields, "mapping.old", no),
              "--set: 'mapping.old' was removed, as it improved nothing; '" + std::string(no) +
                  "' is accepted and changes nothing.");
  EXPECT_NE(warning_of(fields, "mapping.size", "3"), "");
  for (const char* value : {"yes", "1", "maybe", ""})
    EXPECT_EQ(message_of([&] { return warning_of(fields, "mapping.old", value); }),
              "--set: expected 'no' for 'mapping.old', which was removed, found '" + std::string(value) +
                  "'.\n  Leave it out: it was removed, as it improved nothing.");
  EXPECT_THROW((void)warning_of(fields, "mapping.size", "4"), InputError);
  EXPECT_EQ(table_of(fields).format().find("mapping"), std::string::npos);
}

TEST(SettingTable, rows_say_what_people_need_to_know) {
  Fields fields;
  fields.count = 7;
  const std::vector<ParameterRow> rows = table_of(fields).rows();
  ASSERT_EQ(rows.size(), 6U);
  const auto expect_row = [](const ParameterRow& row, const ParameterRow& expected) {
    EXPECT_EQ(row.name, expected.name);
    EXPECT_EQ(row.value, expected.value);
    EXPECT_EQ(row.accepted, expected.accepted);
    EXPECT_EQ(row.meaning, expected.meaning);
  };
  expect_row(rows[0], {"threshold", "1.5", "pixels above 0", "A limit."});
  expect_row(rows[1], {"count", "7", "at least 1 feature", "How many."});
  expect_row(rows[2], {"check", "yes", "yes or no", "Whether to look."});
  expect_row(rows[3], {"detector", "ORB", "a name", "Which."});
  expect_row(rows[4], {"camera.fx", "", "pixels above 0", "Focal length."});
}

}  // namespace
}  // namespace cairn
