// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/pose_table_header.h"

#include <fmt/format.h>

#include <algorithm>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/core/text.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

enum class Quantity { time, count, length, angle };

struct KnownColumn {
  std::string_view name;
  Quantity quantity;
};

constexpr std::array<KnownColumn, kTableColumns> kKnown{{{"time", Quantity::time},
                                                         {"frame", Quantity::count},
                                                         {"latitude", Quantity::angle},
                                                         {"longitude", Quantity::angle},
                                                         {"height", Quantity::length},
                                                         {"east", Quantity::length},
                                                         {"north", Quantity::length},
                                                         {"up", Quantity::length},
                                                         {"roll", Quantity::angle},
                                                         {"pitch", Quantity::angle},
                                                         {"heading", Quantity::angle},
                                                         {"std_east", Quantity::length},
                                                         {"std_north", Quantity::length},
                                                         {"std_up", Quantity::length},
                                                         {"std_roll", Quantity::angle},
                                                         {"std_pitch", Quantity::angle},
                                                         {"std_heading", Quantity::angle}}};

struct KnownUnit {
  std::string_view name;
  ColumnUnit unit;
  Quantity quantity;
};

constexpr std::array<KnownUnit, 5> kUnits{{{"s", ColumnUnit::second, Quantity::time},
                                           {"ns", ColumnUnit::nanosecond, Quantity::time},
                                           {"m", ColumnUnit::metre, Quantity::length},
                                           {"deg", ColumnUnit::degree, Quantity::angle},
                                           {"rad", ColumnUnit::radian, Quantity::angle}}};

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
}

/// A column's name without its unit, in lower case with '_' for blanks.
struct ColumnName {
  std::string base, unit;
};

bool is_unit(std::string_view text) {
  return std::any_of(kUnits.begin(), kUnits.end(),
                     [&](const KnownUnit& known) { return known.name == text; });
}

std::string plain(std::string_view text) {
  std::string result(trimmed(text));
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    if (c == ' ' || c == '-') c = '_';
  }
  return result;
}

/// "Latitude (deg)", "latitude [deg]" and "latitude_deg" are one name.
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

std::optional<TableColumn> find_column(const std::string& base) {
  const std::string_view name = base == "lat"   ? "latitude"
                                : base == "lon" ? "longitude"
                                                : std::string_view(base);
  for (std::size_t i = 0; i < kKnown.size(); ++i) {
    if (kKnown[i].name == name) return static_cast<TableColumn>(i);
  }
  return std::nullopt;
}

[[noreturn]] void fail(const fs::path& path, const TableHeader& header, std::string expected,
                       std::string found, std::string remedy) {
  throw InputError({path.string(), header.line, std::move(expected), std::move(found), std::move(remedy)});
}

std::string default_unit(Quantity quantity) {
  switch (quantity) {
    case Quantity::time:
      return "s";
    case Quantity::length:
      return "m";
    case Quantity::angle:
      return "deg";
    case Quantity::count:
      break;
  }
  return "";
}

ColumnUnit unit_of(const fs::path& path, const TableHeader& header, std::size_t field, const ColumnName& name,
                   Quantity quantity) {
  const std::string text = name.unit.empty() ? default_unit(quantity) : name.unit;
  if (text.empty()) return ColumnUnit::none;
  std::string choices;
  for (const KnownUnit& known : kUnits) {
    if (known.quantity != quantity) continue;
    if (known.name == text) return known.unit;
    choices += fmt::format("{}{}", choices.empty() ? "" : " or ", known.name);
  }
  fail(path, header, fmt::format("'{}' in {}", name.base, choices.empty() ? "no unit" : choices),
       fmt::format("'{}'", header.names[field]), "Convert the column, or mend its name.");
}

/// Whether a name that is not known may be a known one, misspelt, or a standard deviation in other words: to
/// leave it out would change the result without a word.
bool may_be_mistaken(const std::string& base, const std::string& nearest) {
  constexpr std::array<std::string_view, 9> kDeviations{"std", "sd",  "stddev", "sigma",   "rms",
                                                        "acc", "var", "cov",    "accuracy"};
  const std::string words = "_" + base + "_";
  const bool names_deviation = std::any_of(
      kDeviations.begin(), kDeviations.end(),
      [&](std::string_view word) { return words.find(fmt::format("_{}_", word)) != std::string::npos; });
  return names_deviation || 4 * edit_distance(base, nearest) <= std::max(base.size(), nearest.size());
}

void refuse_if_mistakable(const fs::path& path, const TableHeader& header, std::size_t field,
                          const std::string& base) {
  std::vector<std::string> known;
  for (const KnownColumn& column : kKnown) known.emplace_back(column.name);
  const std::string nearest = nearest_name(base, known);
  if (!may_be_mistaken(base, nearest)) return;
  fail(path, header, "names of columns as in docs/poses.md", fmt::format("'{}'", header.names[field]),
       fmt::format("Did you mean '{}'? Rename the column, or delete it.", nearest));
}

void place_columns(const fs::path& path, TableHeader& header) {
  for (std::size_t field = 0; field < header.names.size(); ++field) {
    const ColumnName name = split_name(header.names[field]);
    const auto column = find_column(name.base);
    if (!column) {
      refuse_if_mistakable(path, header, field, name.base);
      continue;
    }
    auto& place = header.places.at(static_cast<std::size_t>(*column));
    if (place) {
      fail(path, header, fmt::format("one column '{}'", to_string(*column)),
           fmt::format("'{}' and '{}'", header.names[place->field], header.names[field]), "Delete one.");
    }
    const Quantity quantity = kKnown.at(static_cast<std::size_t>(*column)).quantity;
    place = ColumnPlace{field, unit_of(path, header, field, name, quantity)};
  }
}

bool has_any(const TableHeader& header, const ColumnTriple& triple) {
  return std::any_of(triple.begin(), triple.end(), [&](TableColumn column) { return header.has(column); });
}

[[noreturn]] void fail_missing(const fs::path& path, const TableHeader& header, std::string_view missing) {
  fail(path, header,
       fmt::format(
           "{} among the columns: time (s, ns) or frame; latitude, longitude (deg), height (m) or east, "
           "north, up (m); roll, pitch, heading (deg); perhaps std_east, std_north, std_up (m), std_roll, "
           "std_pitch, std_heading (deg)",
           missing),
       fmt::format("{}", fmt::join(header.names, ", ")), "Add or rename columns (docs/poses.md).");
}

void expect_all(const fs::path& path, const TableHeader& header, const ColumnTriple& triple) {
  for (const TableColumn column : triple) {
    if (!header.has(column)) fail_missing(path, header, fmt::format("'{}'", to_string(column)));
  }
}

void expect_one(const fs::path& path, const TableHeader& header, bool first, bool second,
                std::string_view choices) {
  if (first != second) return;
  if (!first) fail_missing(path, header, choices);
  fail(path, header, fmt::format("either {}", choices), "both", "Delete or rename those that do not count.");
}

}  // namespace

std::string_view to_string(TableColumn column) {
  return kKnown.at(static_cast<std::size_t>(column)).name;
}

std::optional<TableHeader> find_table_header(const fs::path& path) {
  const std::string contents = read_file(path);
  TableHeader header;
  std::string_view rest = contents, line;
  if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);
  for (; !rest.empty() && line.empty(); ++header.line) {
    const std::size_t end = std::min(rest.find('\n'), rest.size() - 1);
    line = trimmed(rest.substr(0, end + 1 - (rest[end] == '\n' ? 1 : 0)));
    rest.remove_prefix(end + 1);
  }
  const bool is_comment = line.starts_with('#');
  if (is_comment) line.remove_prefix(1);
  if (line.find(',') == std::string_view::npos) return std::nullopt;
  bool knows_one = false;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    header.names.emplace_back(trimmed(line.substr(begin, end - begin)));
    knows_one = knows_one || find_column(split_name(header.names.back()).base);
    begin = end + 1;
  }
  double value = 0;
  const bool is_header = knows_one || (!is_comment && !parse_number(header.names[0], value));
  return is_header ? std::optional(header) : std::nullopt;
}

void check_table_header(const fs::path& path, TableHeader& header) {
  place_columns(path, header);
  const bool geodetic = has_any(header, kGeodetic), local = has_any(header, kLocal);
  expect_one(path, header, header.has(TableColumn::time), header.has(TableColumn::frame),
             "'time' or 'frame'");
  expect_one(path, header, geodetic, local, "'latitude', 'longitude', 'height' or 'east', 'north', 'up'");
  expect_all(path, header, geodetic ? kGeodetic : kLocal);
  expect_all(path, header, kAngles);
  for (const ColumnTriple& triple : {kPlaceDeviations, kAngleDeviations}) {
    if (has_any(header, triple)) expect_all(path, header, triple);
  }
}

}  // namespace cairn
