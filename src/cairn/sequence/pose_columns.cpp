// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/pose_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "cairn/core/text.h"

namespace cairn {
namespace {

struct KnownColumn {
  std::string_view name;
  Quantity quantity;
};

constexpr std::array<KnownColumn, kTableColumns> kKnown{
    {{"time", Quantity::time},        {"frame", Quantity::count},       {"latitude", Quantity::angle},
     {"longitude", Quantity::angle},  {"height", Quantity::length},     {"east", Quantity::length},
     {"north", Quantity::length},     {"up", Quantity::length},         {"roll", Quantity::angle},
     {"pitch", Quantity::angle},      {"heading", Quantity::angle},     {"std_east", Quantity::length},
     {"std_north", Quantity::length}, {"std_up", Quantity::length},     {"std_roll", Quantity::angle},
     {"std_pitch", Quantity::angle},  {"std_heading", Quantity::angle}, {"week", Quantity::count},
     {"x", Quantity::length},         {"y", Quantity::length},          {"z", Quantity::length},
     {"qx", Quantity::none},          {"qy", Quantity::none},           {"qz", Quantity::none},
     {"qw", Quantity::none},          {"std_x", Quantity::length},      {"std_y", Quantity::length},
     {"std_z", Quantity::length},     {"std_rx", Quantity::angle},      {"std_ry", Quantity::angle},
     {"std_rz", Quantity::angle}}};

struct Synonym {
  std::string_view name;
  TableColumn column;
  double factor = 1;
};

constexpr std::array<Synonym, 51> kSynonyms{{{"timestamp", TableColumn::time},
                                             {"timestamps", TableColumn::time},
                                             {"time_stamp", TableColumn::time},
                                             {"stamp", TableColumn::time},
                                             {"t", TableColumn::time},
                                             {"ts", TableColumn::time},
                                             {"utime", TableColumn::time},
                                             {"unixtime", TableColumn::time},
                                             {"unix_time", TableColumn::time},
                                             {"gps_time", TableColumn::time},
                                             {"gpstime", TableColumn::time},
                                             {"header_stamp", TableColumn::time},
                                             {"epoch", TableColumn::time},
                                             {"frame_id", TableColumn::frame},
                                             {"frame_number", TableColumn::frame},
                                             {"frame_no", TableColumn::frame},
                                             {"frame_index", TableColumn::frame},
                                             {"lat", TableColumn::latitude},
                                             {"lon", TableColumn::longitude},
                                             {"long", TableColumn::longitude},
                                             {"lng", TableColumn::longitude},
                                             {"alt", TableColumn::height},
                                             {"altitude", TableColumn::height},
                                             {"ellipsoidal_height", TableColumn::height},
                                             {"ellipsoid_height", TableColumn::height},
                                             {"easting", TableColumn::east},
                                             {"northing", TableColumn::north},
                                             {"elevation", TableColumn::height},
                                             {"down", TableColumn::up, -1},
                                             {"std_down", TableColumn::std_up},
                                             {"std_lat", TableColumn::std_north},
                                             {"std_lon", TableColumn::std_east},
                                             {"std_height", TableColumn::std_up},
                                             {"gps_week", TableColumn::week},
                                             {"gpsweek", TableColumn::week},
                                             {"week_number", TableColumn::week},
                                             {"gps_week_number", TableColumn::week},
                                             {"sow", TableColumn::time},
                                             {"tow", TableColumn::time},
                                             {"gps_sow", TableColumn::time},
                                             {"gps_tow", TableColumn::time},
                                             {"gps_seconds", TableColumn::time},
                                             {"seconds_of_week", TableColumn::time},
                                             {"gps_seconds_of_week", TableColumn::time},
                                             {"time_of_week", TableColumn::time},
                                             {"h_ell", TableColumn::height},
                                             {"height_ellipsoidal", TableColumn::height},
                                             {"sde", TableColumn::std_east},
                                             {"sdn", TableColumn::std_north},
                                             {"sdu", TableColumn::std_up},
                                             {"azimuth", TableColumn::heading}}};

struct KnownUnit {
  std::string_view name;
  ColumnUnit unit;
  Quantity quantity;
  bool is_main = false;  ///< the one that messages name
};

constexpr std::array<KnownUnit, 32> kUnits{{{"s", ColumnUnit::second, Quantity::time, true},
                                            {"sec", ColumnUnit::second, Quantity::time},
                                            {"secs", ColumnUnit::second, Quantity::time},
                                            {"second", ColumnUnit::second, Quantity::time},
                                            {"seconds", ColumnUnit::second, Quantity::time},
                                            {"ms", ColumnUnit::millisecond, Quantity::time, true},
                                            {"msec", ColumnUnit::millisecond, Quantity::time},
                                            {"milliseconds", ColumnUnit::millisecond, Quantity::time},
                                            {"us", ColumnUnit::microsecond, Quantity::time, true},
                                            {"usec", ColumnUnit::microsecond, Quantity::time},
                                            {"microseconds", ColumnUnit::microsecond, Quantity::time},
                                            {"ns", ColumnUnit::nanosecond, Quantity::time, true},
                                            {"nsec", ColumnUnit::nanosecond, Quantity::time},
                                            {"nanoseconds", ColumnUnit::nanosecond, Quantity::time},
                                            {"m", ColumnUnit::metre, Quantity::length, true},
                                            {"meter", ColumnUnit::metre, Quantity::length},
                                            {"meters", ColumnUnit::metre, Quantity::length},
                                            {"metre", ColumnUnit::metre, Quantity::length},
                                            {"metres", ColumnUnit::metre, Quantity::length},
                                            {"cm", ColumnUnit::centimetre, Quantity::length},
                                            {"centimetres", ColumnUnit::centimetre, Quantity::length},
                                            {"centimeters", ColumnUnit::centimetre, Quantity::length},
                                            {"mm", ColumnUnit::millimetre, Quantity::length},
                                            {"millimetres", ColumnUnit::millimetre, Quantity::length},
                                            {"millimeters", ColumnUnit::millimetre, Quantity::length},
                                            {"deg", ColumnUnit::degree, Quantity::angle, true},
                                            {"degs", ColumnUnit::degree, Quantity::angle},
                                            {"degree", ColumnUnit::degree, Quantity::angle},
                                            {"degrees", ColumnUnit::degree, Quantity::angle},
                                            {"rad", ColumnUnit::radian, Quantity::angle, true},
                                            {"rads", ColumnUnit::radian, Quantity::angle},
                                            {"radians", ColumnUnit::radian, Quantity::angle}}};

bool is_unit(std::string_view text) {
  return std::any_of(kUnits.begin(), kUnits.end(),
                     [&](const KnownUnit& known) { return known.name == text; });
}

/// Lower case, one '_' for each run of blanks, points, slashes and hyphens.
std::string plain(std::string_view text) {
  constexpr std::string_view kSeparators = " \t\r-./_%";
  std::string result;
  for (const char c : lower_case(text)) {
    if (kSeparators.find(c) != std::string_view::npos) {
      if (!result.empty() && result.back() != '_') result += '_';
    } else {
      result += c;
    }
  }
  if (result.ends_with('_')) result.pop_back();
  return result;
}

std::vector<std::string_view> words_of(std::string_view name) {
  std::vector<std::string_view> words;
  for (std::size_t begin = 0; begin < name.size();) {
    const std::size_t end = std::min(name.find('_', begin), name.size());
    words.push_back(name.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

template <std::size_t N>
bool has_one_of(const std::vector<std::string_view>& words, const std::array<std::string_view, N>& wanted) {
  return std::any_of(words.begin(), words.end(), [&](std::string_view word) {
    return std::find(wanted.begin(), wanted.end(), word) != wanted.end();
  });
}

enum class PosePart : std::uint8_t { none, position, quaternion };

/// What the words before the axis say: "p_rs_r", "pose_orientation", "quat".
PosePart part_named_by(const std::vector<std::string_view>& words) {
  constexpr std::array<std::string_view, 6> kRotations{"q",           "quat", "quaternion",
                                                       "orientation", "rot",  "rotation"};
  constexpr std::array<std::string_view, 11> kPositions{
      "p", "t", "pos", "position", "trans", "location", "point", "translation", "loc", "coord", "pose"};
  constexpr std::array<std::string_view, 15> kOthers{
      "v",   "vel",   "velocity", "twist", "acc",  "acceleration", "angular", "linear",
      "std", "sigma", "cov",      "var",   "bias", "error",        "rate"};
  if (has_one_of(words, kOthers)) return PosePart::none;
  if (has_one_of(words, kRotations)) return PosePart::quaternion;
  return has_one_of(words, kPositions) ? PosePart::position : PosePart::none;
}

/// "x", "tx", "p_rs_r_x", "translation_x", "qw", "quat_w", "pose_orientation_w".
std::optional<TableColumn> find_pose_column(const std::string& base) {
  constexpr std::string_view kAxes = "xyzw";
  if (base.empty()) return std::nullopt;
  const std::size_t axis = kAxes.find(base.back());
  if (axis == std::string_view::npos) return std::nullopt;
  const bool is_scalar = axis == 3;
  const auto words = words_of(std::string_view(base).substr(0, base.size() - 1));
  const PosePart part = words.empty() ? PosePart::position : part_named_by(words);
  if (part == PosePart::quaternion) return kQuaternion.at(axis);
  if (part == PosePart::position && !is_scalar) return kPosition.at(axis);
  return std::nullopt;
}

/// "east_std_dev", "std_dev_e", "sd_height", "sigma_yaw": one axis and words of a deviation.
std::optional<TableColumn> find_deviation(const std::string& base) {
  constexpr std::array<std::string_view, 8> kDeviations{"std",   "sd",       "stddev",    "stdev",
                                                        "sigma", "standard", "deviation", "dev"};
  constexpr std::array<std::pair<std::string_view, TableColumn>, 14> kAxes{
      {{"east", TableColumn::std_east},
       {"easting", TableColumn::std_east},
       {"lon", TableColumn::std_east},
       {"longitude", TableColumn::std_east},
       {"north", TableColumn::std_north},
       {"northing", TableColumn::std_north},
       {"lat", TableColumn::std_north},
       {"latitude", TableColumn::std_north},
       {"up", TableColumn::std_up},
       {"height", TableColumn::std_up},
       {"altitude", TableColumn::std_up},
       {"roll", TableColumn::std_roll},
       {"pitch", TableColumn::std_pitch},
       {"heading", TableColumn::std_heading}}};
  std::vector<std::string_view> words = words_of(base);
  const auto is_deviation = [&](std::string_view word) {
    return std::find(kDeviations.begin(), kDeviations.end(), word) != kDeviations.end();
  };
  const std::size_t removed = std::erase_if(words, is_deviation);
  if (removed == 0 || words.size() != 1) return std::nullopt;
  const auto* axis = std::find_if(kAxes.begin(), kAxes.end(),
                                  [&](const auto& known) { return known.first == words.front(); });
  return axis == kAxes.end() ? std::nullopt : std::optional(axis->second);
}

}  // namespace

std::string_view to_string(TableColumn column) {
  return kKnown.at(static_cast<std::size_t>(column)).name;
}

Quantity quantity_of(TableColumn column) {
  return kKnown.at(static_cast<std::size_t>(column)).quantity;
}

std::optional<ColumnUnit> find_unit(std::string_view text, Quantity quantity) {
  if (quantity == Quantity::none) return ColumnUnit::none;
  if (text.empty()) {
    return quantity == Quantity::length  ? ColumnUnit::metre
           : quantity == Quantity::angle ? ColumnUnit::degree
                                         : ColumnUnit::none;
  }
  const auto found = std::find_if(kUnits.begin(), kUnits.end(), [&](const KnownUnit& known) {
    return known.quantity == quantity && known.name == text;
  });
  return found == kUnits.end() ? std::nullopt : std::optional(found->unit);
}

std::string unit_choices(Quantity quantity) {
  std::vector<std::string_view> names;
  for (const KnownUnit& known : kUnits)
    if (known.quantity == quantity && known.is_main) names.push_back(known.name);
  return fmt::format("{}", fmt::join(names, " or "));
}

ColumnName split_name(std::string_view written) {
  const std::size_t bracket = written.find_first_of("([");
  if (bracket != std::string_view::npos) {
    const std::string_view rest = written.substr(bracket + 1);
    return {plain(written.substr(0, bracket)), plain(rest.substr(0, rest.find_first_of(")]")))};
  }
  const std::string name = plain(written);
  const std::size_t last = name.rfind('_');
  if (last == std::string::npos || !is_unit(std::string_view(name).substr(last + 1))) return {name, ""};
  return {name.substr(0, last), name.substr(last + 1)};
}

std::optional<ColumnMeaning> find_column(const std::string& base) {
  for (std::size_t i = 0; i < kKnown.size(); ++i)
    if (kKnown[i].name == base) return ColumnMeaning{static_cast<TableColumn>(i)};
  for (const Synonym& synonym : kSynonyms)
    if (synonym.name == base) return ColumnMeaning{synonym.column, synonym.factor};
  if (const auto column = find_deviation(base)) return ColumnMeaning{*column};
  if (const auto column = find_pose_column(base)) return ColumnMeaning{*column};
  return std::nullopt;
}

bool names_rate(const std::string& base) {
  constexpr std::array<std::string_view, 8> kRates{"vel",  "velocity",     "speed",   "accel",
                                                   "rate", "acceleration", "angular", "bias"};
  return has_one_of(words_of(base), kRates);
}

bool is_numbered_quaternion(const std::string& base) {
  if (base.empty() || base.back() < '0' || base.back() > '4') return false;
  return part_named_by(words_of(std::string_view(base).substr(0, base.size() - 1))) == PosePart::quaternion;
}

std::vector<std::string> table_names() {
  std::vector<std::string> names;
  for (const KnownColumn& column : kKnown) {
    const bool is_pose_column = &column - kKnown.data() >= static_cast<std::ptrdiff_t>(TableColumn::x);
    if (!is_pose_column) names.emplace_back(column.name);
  }
  return names;
}

}  // namespace cairn
