// SPDX-License-Identifier: Apache-2.0
// Logs of NovAtel SPAN receivers in ASCII: INSPVAA, INSPVASA and INSPVAXA (OEM7 Commands and Logs Reference).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/geometry/covariance.h"
#include "cairn/sequence/attitude.h"
#include "cairn/sequence/geodetic.h"
#include "cairn/sequence/gps_time.h"
#include "cairn/sequence/pose_collector.h"
#include "cairn/sequence/recorded_poses.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

constexpr double kRadian = std::numbers::pi / 180;
constexpr std::size_t kNone = 99;

/// Where the values of one kind of log stand: in the header before the ';', or in the body behind it.
struct LogLayout {
  std::string_view name;
  std::size_t header_values, body_values;
  std::size_t week, seconds;                                                          ///< in the header
  std::size_t status, place, undulation, angles, place_deviations, angle_deviations;  ///< in the body
};

/// INSPVAX counts heights from mean sea level and states the undulation, the others from the ellipsoid.
constexpr std::array<LogLayout, 3> kLayouts{{{"#INSPVAXA", 10, 23, 5, 6, 0, 2, 5, 9, 12, 18},
                                             {"#INSPVAA", 10, 12, 5, 6, 11, 2, kNone, 8, kNone, kNone},
                                             {"%INSPVASA", 3, 12, 1, 2, 11, 2, kNone, 8, kNone, kNone}}};

/// Computes the 32-bit CRC of a log: polynomial 0xEDB88320, from zero, without a final complement.
std::uint32_t checksum_of(std::string_view text) {
  constexpr std::uint32_t kPolynomial = 0xEDB88320;
  std::uint32_t crc = 0;
  for (const char c : text) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? kPolynomial : 0);
  }
  return crc;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

const LogLayout* layout_of(std::string_view line) {
  const std::string_view name = line.substr(0, line.find(','));
  const auto* found = std::find_if(kLayouts.begin(), kLayouts.end(),
                                   [&](const LogLayout& layout) { return layout.name == name; });
  return found == kLayouts.end() ? nullptr : found;
}

struct LogLine {
  int number = 0;
  std::string_view text;
};

/// Returns the lines of each kind of log, in the order of kLayouts.
std::array<std::vector<LogLine>, kLayouts.size()> logs_in(std::string_view contents) {
  std::array<std::vector<LogLine>, kLayouts.size()> logs;
  int number = 0;
  for (std::string_view line : split(contents, '\n')) {
    ++number;
    while (line.ends_with('\r') || line.ends_with(' ')) line.remove_suffix(1);
    if (const LogLayout* layout = layout_of(line))
      logs.at(static_cast<std::size_t>(layout - kLayouts.data())).push_back({number, line});
  }
  return logs;
}

/// Reads the values of one log; all fields of its header stand before those of its body.
class LogReader {
 public:
  LogReader(const TextFile& file, const LogLayout& layout, const LogLine& log)
      : file_(file), layout_(layout), line_{log.number, {}} {
    const std::string_view text = log.text.substr(0, log.text.find('*'));
    expect_checksum(text, log.text.substr(std::min(text.size() + 1, log.text.size())));
    line_.fields = split(text.substr(0, text.find(';')), ',');
    const std::size_t header = line_.fields.size();
    const auto body = split(text.substr(std::min(text.find(';'), text.size() - 1) + 1), ',');
    line_.fields.insert(line_.fields.end(), body.begin(), body.end());
    if (header == layout.header_values && body.size() == layout.body_values) return;
    fail(fmt::format("{} values, ';' and {} values", layout.header_values, layout.body_values),
         fmt::format("{} and {}", header, body.size()), "Delete the line.");
  }
  [[nodiscard]] const TextLine& line() const { return line_; }

  [[nodiscard]] std::int64_t stamp_ns() const {
    constexpr std::int64_t kWeekNs = 604'800'000'000'000;
    constexpr std::int64_t kLastWeek = 6000;
    const std::int64_t week = file_.integer(line_, layout_.week, "GPS week");
    std::int64_t of_week = 0;
    const std::string_view seconds = line_.fields[layout_.seconds];
    if (week < 1 || week > kLastWeek || !parse_stamp(seconds, of_week) || of_week < 0 || of_week > kWeekNs)
      fail("a GPS week and its seconds", fmt::format("'{},{}'", line_.fields[layout_.week], seconds),
           "Delete the lines from before the receiver knew the time.");
    return utc_from_gps(week, of_week);
  }
  /// Tells whether the status is that of a navigation solution.
  [[nodiscard]] bool has_solution() const {
    constexpr std::array<std::string_view, 4> kSolutions{"INS_SOLUTION_GOOD", "INS_SOLUTION_FREE",
                                                         "INS_HIGH_VARIANCE", "INS_ALIGNMENT_COMPLETE"};
    return std::find(kSolutions.begin(), kSolutions.end(), body(layout_.status)) != kSolutions.end();
  }
  [[nodiscard]] RecordedPose pose() const {
    RecordedPose pose;
    pose.key = stamp_ns();
    pose.place = values(layout_.place, {-90, -180, -1e6}, {90, 360, 1e6});
    if (layout_.undulation != kNone) pose.place.z() += value(layout_.undulation, -1e3, 1e3);
    const Eigen::Vector3d angles = kRadian * values(layout_.angles, {-360, -90, -360}, {360, 90, 360});
    const Attitude ned_from_body{angles[0], angles[1], angles[2]};
    pose.rotation = (enu_from_ned() * rotation_of(ned_from_body)).normalized();
    if (layout_.place_deviations != kNone) set_covariances(ned_from_body, pose);
    return pose;
  }

 private:
  /// The angles' axes are those of the body that the receiver states: x right, y forward, z up. Roll turns
  /// about y and pitch about x, right-handed, so that both have the senses of the axes forward, right, down.
  void set_covariances(const Attitude& ned_from_body, RecordedPose& pose) const {
    const Eigen::Vector3d place =
        values(layout_.place_deviations, Eigen::Vector3d::Zero(), Eigen::Vector3d::Constant(1e6));
    pose.place_covariance = covariance_of({place[1], place[0], place[2]});  // stated as north, east, up
    const Eigen::Vector3d angles =
        values(layout_.angle_deviations, Eigen::Vector3d::Zero(), Eigen::Vector3d::Constant(360));
    const Eigen::Matrix3d turn = enu_from_ned().toRotationMatrix() * turn_by_angles(ned_from_body);
    pose.rotation_covariance = propagate_covariance(turn, covariance_of(kRadian * angles));
  }
  void expect_checksum(std::string_view text, std::string_view written) const {
    const std::string expected = fmt::format("{:08x}", checksum_of(text.substr(1)));
    if (lower_case(written) != expected)
      fail(fmt::format("the checksum {}", expected), fmt::format("'{}'", written),
           "The line was damaged: delete it.");
  }
  [[nodiscard]] std::string_view body(std::size_t field) const {
    return line_.fields[layout_.header_values + field];
  }
  [[nodiscard]] double value(std::size_t field, double lowest, double highest) const {
    const double value = file_.number(line_, layout_.header_values + field, "value");
    if (value >= lowest && value <= highest) return value;
    fail(fmt::format("a value from {:g} to {:g}", lowest, highest), fmt::format("{:g}", value),
         "Delete the line.");
  }
  [[nodiscard]] Eigen::Vector3d values(std::size_t field, const Eigen::Vector3d& lowest,
                                       const Eigen::Vector3d& highest) const {
    return {value(field, lowest[0], highest[0]), value(field + 1, lowest[1], highest[1]),
            value(field + 2, lowest[2], highest[2])};
  }
  [[noreturn]] void fail(std::string expected, std::string found, std::string remedy) const {
    file_.fail(line_, std::move(expected), std::move(found), std::move(remedy));
  }

  const TextFile& file_;
  const LogLayout& layout_;
  TextLine line_;
};

}  // namespace

bool is_novatel(const fs::path& path) {
  constexpr std::size_t kHead = 1 << 16;  // other logs may come first
  const std::string contents = read_file(path).substr(0, kHead);
  const auto logs = logs_in(contents);
  return std::any_of(logs.begin(), logs.end(), [](const auto& lines) { return !lines.empty(); });
}

RecordedPoses read_novatel(const fs::path& path) {
  const std::string contents = read_file(path);
  const auto logs = logs_in(contents);
  const auto* most = std::max_element(logs.begin(), logs.end(),
                                      [](const auto& a, const auto& b) { return a.size() < b.size(); });
  const LogLayout& layout = kLayouts.at(static_cast<std::size_t>(most - logs.data()));
  RecordedPoses recorded;
  recorded.source = path;
  recorded.format = "NovAtel";
  recorded.subject = PoseSubject::body_forward_right_down;
  recorded.geodetic = true;
  recorded.has_uncertainty = layout.place_deviations != kNone;
  const TextFile file(path);
  PoseCollector collector(recorded);
  for (const LogLine& log : *most) {
    const LogReader reader(file, layout, log);
    reader.has_solution() ? collector.add(file, reader.line(), reader.pose())
                          : collector.leave_out(file, reader.line(), reader.stamp_ns());
  }
  collector.finish();
  const int leap = leap_seconds_at(recorded.poses.front().key);
  recorded.warnings.push_back(fmt::format(
      "{}: GPS time less {} leap seconds is UTC; if the frames have GPS time, add --pose-offset {}. Heights "
      "are above the ellipsoid{}.",
      path.string(), leap, leap,
      layout.undulation == kNone ? "" : ", those above the geoid plus the undulation"));
  return recorded;
}

}  // namespace cairn
