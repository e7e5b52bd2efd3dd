// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <chrono>
#include <numbers>
#include <optional>

#include "cairn/core/error.h"
#include "cairn/sequence/attitude.h"
#include "cairn/sequence/formats.h"
#include "cairn/sequence/geodetic.h"
#include "cairn/sequence/pose_collector.h"
#include "cairn/sequence/recorded_poses.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

/// Whole days since 1970 of "2011-09-26"; nothing where that is no date.
std::optional<std::int64_t> parse_days(std::string_view text) {
  std::int64_t year = 0, month = 0, day = 0;
  const bool split = text.size() == 10 && text[4] == '-' && text[7] == '-';
  if (!split || !parse_integer(text.substr(0, 4), year) || !parse_integer(text.substr(5, 2), month) ||
      !parse_integer(text.substr(8, 2), day) || month < 1 || day < 1)
    return std::nullopt;
  const std::chrono::year_month_day date{std::chrono::year(static_cast<int>(year)),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (!date.ok() || year < 1970 || year > 2200) return std::nullopt;
  return std::chrono::sys_days(date).time_since_epoch().count();
}

/// Nanoseconds since midnight of "13:02:25.594360375"; nothing where that is no time of a day.
std::optional<std::int64_t> parse_time_of_day(std::string_view text) {
  std::int64_t hours = 0, minutes = 0, stamp_ns = 0;
  const bool split = text.size() >= 8 && text[2] == ':' && text[5] == ':';
  if (!split || !parse_integer(text.substr(0, 2), hours) || !parse_integer(text.substr(3, 2), minutes) ||
      !parse_stamp(text.substr(6), stamp_ns))
    return std::nullopt;
  constexpr std::int64_t kMinuteNs = 60'000'000'000;
  const auto within = [](std::int64_t value, std::int64_t end) { return value >= 0 && value < end; };
  if (!within(hours, 24) || !within(minutes, 60) || !within(stamp_ns, kMinuteNs + kMinuteNs / 60))
    return std::nullopt;  // a minute may have a leap second
  return (hours * 60 + minutes) * kMinuteNs + stamp_ns;
}

/// Nanoseconds since 1970, UTC.
std::int64_t parse_date(const TextFile& file, const TextLine& line) {
  constexpr std::int64_t kDayNs = 86'400'000'000'000;
  file.expect_fields(line, 2, "date time, 2011-09-26 13:02:25.594360375");
  const auto days = parse_days(line.fields[0]), time_ns = parse_time_of_day(line.fields[1]);
  if (days && time_ns) return *days * kDayNs + *time_ns;
  file.fail(line, "a date and a time, 2011-09-26 13:02:25.594360375",
            fmt::format("'{} {}'", line.fields[0], line.fields[1]), "Correct the line.");
}

/// A value of a packet and what it may be.
struct PacketField {
  std::size_t field;
  std::string_view name, unit;
  double lowest, highest;
};

constexpr double kTurn = 2 * std::numbers::pi;  // degrees would be beyond it
constexpr PacketField kLatitude{0, "lat", "degrees", -90, 90};
constexpr PacketField kLongitude{1, "lon", "degrees", -180, 360};
constexpr PacketField kAltitude{2, "alt", "m", -1e6, 1e6};
constexpr PacketField kRoll{3, "roll", "radians", -kTurn, kTurn};
constexpr PacketField kPitch{4, "pitch", "radians", -kTurn, kTurn};
constexpr PacketField kYaw{5, "yaw", "radians", -kTurn, kTurn};
constexpr PacketField kPlaceAccuracy{23, "pos_accuracy", "m", 0, 1e6};

double parse_field(const TextFile& file, const TextLine& line, const PacketField& field) {
  const double value = file.number(line, field.field, field.name);
  if (value >= field.lowest && value <= field.highest) return value;
  file.fail(line, fmt::format("{} from {:g} to {:g} {}", field.name, field.lowest, field.highest, field.unit),
            fmt::format("{:g}", value),
            "Check the order of the values: lat lon alt roll pitch yaw ... (30).");
}

/// Tells whether the position is NaN, or 0 north and 0 east.
bool lacks_position(const TextFile& file, const TextLine& line) {
  for (std::size_t i = 0; i < 3; ++i)
    if (line.fields[i] == "nan" || line.fields[i] == "NaN" || line.fields[i] == "-nan") return true;
  return is_without_fix({file.number(line, 0, "lat"), file.number(line, 1, "lon"), 0});
}

/// Of body axes forward, left, up in east, north, up; nullopt for a packet without a position.
std::optional<RecordedPose> read_packet(const fs::path& path) {
  const TextFile file(path);
  if (file.lines().size() != 1) {
    throw InputError({path.string(), 0, "one line with 30 values",
                      fmt::format("{} lines", file.lines().size()),
                      "Correct the packet, or leave it and its time out."});
  }
  const TextLine& line = file.lines().front();
  file.expect_fields(line, 30, "lat lon alt roll pitch yaw ... pos_accuracy ... orimode");
  if (lacks_position(file, line)) return std::nullopt;
  const auto value = [&](const PacketField& field) { return parse_field(file, line, field); };
  RecordedPose pose;
  pose.place = {value(kLatitude), value(kLongitude), value(kAltitude)};
  pose.rotation = rotation_of({value(kRoll), value(kPitch), value(kYaw)});
  // said to be of north and east; a packet says none of the height
  pose.place_covariance = covariance_of(Eigen::Vector3d::Constant(value(kPlaceAccuracy)));
  return pose;
}

std::vector<fs::path> packets_in(const fs::path& folder) {
  std::vector<fs::path> packets;
  for (const fs::path& file : files_in(folder)) {
    if (file.extension() == ".txt" && parse_frame_number(file.stem().string())) packets.push_back(file);
  }
  return packets;
}

}  // namespace

bool is_oxts(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_directory(folder / "data", ignored) && fs::exists(folder / "timestamps.txt", ignored);
}

RecordedPoses read_oxts(const fs::path& folder) {
  const TextFile times(folder / "timestamps.txt");
  const std::vector<fs::path> packets = packets_in(folder / "data");
  if (times.lines().size() != packets.size() || packets.empty()) {
    throw InputError({times.path().string(), 0,
                      fmt::format("{} times, one for each packet in data/", packets.size()),
                      fmt::format("{}", times.lines().size()),
                      "Leave out packets without time and times without packet."});
  }
  RecordedPoses recorded;
  recorded.source = folder;
  recorded.format = "OXTS";
  recorded.subject = PoseSubject::body_forward_left_up;
  recorded.geodetic = recorded.has_uncertainty = true;
  PoseCollector collector(recorded);
  for (std::size_t i = 0; i < packets.size(); ++i) {
    const TextLine& line = times.lines()[i];
    const std::int64_t stamp_ns = parse_date(times, line);
    std::optional<RecordedPose> pose = read_packet(packets[i]);
    if (pose) pose->key = stamp_ns;
    pose ? collector.add(times, line, *pose) : collector.leave_out(times, line, stamp_ns);
  }
  collector.finish();
  return recorded;
}

}  // namespace cairn
