// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/pose_table_header.h"

#include <fmt/format.h>

#include <algorithm>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/sequence/table_text.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
}

// ---- finding the line ----

/// Outside of brackets.
bool has_comma(std::string_view line) {
  int depth = 0;
  for (const char c : line) {
    if (c == '(' || c == '[') ++depth;
    if (c == ')' || c == ']') --depth;
    if (c == ',' && depth <= 0) return true;
  }
  return false;
}

/// Splits at commas, or at blanks outside of brackets: "timestamp [ns] tx ty".
std::vector<std::string> split_names(std::string_view line, Separator separator) {
  std::vector<std::string> names;
  if (separator == Separator::commas) {
    for (std::size_t begin = 0; begin <= line.size();) {
      const std::size_t end = std::min(line.find(',', begin), line.size());
      names.emplace_back(trimmed(line.substr(begin, end - begin)));
      begin = end + 1;
    }
    return names;
  }
  int depth = 0;
  bool begins = true;
  for (const char c : line) {
    const bool is_blank = c == ' ' || c == '\t' || c == '\r';
    if (c == '(' || c == '[') begins = begins && names.empty(), ++depth;  // a unit belongs to the name before
    if (is_blank && depth == 0) {
      begins = true;
      continue;
    }
    if (begins) names.emplace_back();
    begins = false;
    if (!is_blank) names.back() += c;
    if ((c == ')' || c == ']') && depth > 0) --depth;
  }
  return names;
}

/// How many of the names mean what.
struct NameCounts {
  int position = 0, quaternion = 0, table = 0;
};

NameCounts count_names(const std::vector<std::string>& names) {
  NameCounts counts;
  for (const std::string& name : names) {
    const std::string base = split_name(name).base;
    const auto meaning = find_column(base);
    if (is_numbered_quaternion(base)) ++counts.quaternion;
    if (!meaning) continue;
    const TableColumn column = meaning->column;
    if (std::find(kQuaternion.begin(), kQuaternion.end(), column) != kQuaternion.end())
      ++counts.quaternion;
    else if (std::find(kPosition.begin(), kPosition.end(), column) != kPosition.end())
      ++counts.position;
    else if (column != TableColumn::time && column != TableColumn::frame && column < TableColumn::x)
      ++counts.table;
  }
  return counts;
}

/// Two names at least: a sentence may hold one by chance.
bool names_columns(const NameCounts& counts) {
  const bool has_quaternion = counts.quaternion > 0 && counts.quaternion + counts.position > 1;
  return has_quaternion || counts.table > 1;
}

bool begins_with_number(std::string_view line) {
  const std::size_t begin = line.find_first_not_of(" \t");
  const std::string_view rest = line.substr(std::min(begin, line.size()));
  double value = 0;
  return parse_number(rest.substr(0, rest.find_first_of(", \t\r;")), value);
}

/// Takes lines from the front of a text.
class LineScanner {
 public:
  explicit LineScanner(std::string_view text) : rest_(text) {
    if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
  }
  [[nodiscard]] bool next() {
    if (rest_.empty()) return false;
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    line = trimmed(rest_.substr(0, end));
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++number;
    return true;
  }
  std::string_view line;
  int number = 0;

 private:
  std::string_view rest_;
};

/// What the lines before the first row of numbers may name.
struct Candidates {
  std::optional<TableHeader> known;             ///< the last line whose names are known
  std::optional<TableHeader> unknown;           ///< the first line without '#' that has commas
  std::optional<TableHeader> without_rotation;  ///< the last line that names a position alone, with commas
};

void consider(std::string_view line, int number, Candidates& candidates) {
  const bool is_comment = line.starts_with('#');
  line = trimmed(line.substr(std::min(line.find_first_not_of("# \t"), line.size())));
  const std::size_t colon = line.find(": ");  // "Format: timestamp tx ty ..."
  if (colon != std::string_view::npos) line = trimmed(line.substr(colon + 1));
  TableHeader header;
  header.line = number;
  header.separator = has_comma(line) ? Separator::commas : Separator::blanks;
  header.names = split_names(line, header.separator);
  header.open_ended = !header.names.empty() && header.names.back() == "...";
  if (header.open_ended) header.names.pop_back();
  const NameCounts counts = count_names(header.names);
  if (names_columns(counts))
    candidates.known = header;
  else if (counts.position == 3 && counts.table == 0 && header.separator == Separator::commas)
    candidates.without_rotation = header;
  else if (!is_comment && header.separator == Separator::commas && !candidates.unknown)
    candidates.unknown = header;
}

// ---- what the names mean ----

[[noreturn]] void fail(const fs::path& path, const TableHeader& header, std::string expected,
                       std::string found, std::string remedy) {
  throw InputError({path.string(), header.line, std::move(expected), std::move(found), std::move(remedy)});
}

ColumnUnit unit_of(const fs::path& path, const TableHeader& header, std::size_t field, const ColumnName& name,
                   Quantity quantity) {
  if (const auto unit = find_unit(name.unit, quantity)) return *unit;
  const std::string choices = unit_choices(quantity);
  fail(path, header, fmt::format("'{}' in {}", name.base, choices.empty() ? "no unit" : choices),
       fmt::format("'{}'", header.names[field]), "Convert the column, or correct its name.");
}

/// Tells whether an unknown name may be a misspelt known one, or a standard deviation in other words: to
/// leave it out would silently change the result.
bool may_be_mistaken(const std::string& base, const std::string& nearest) {
  constexpr std::array<std::string_view, 9> kDeviations{"std", "sd",  "stddev", "sigma",   "rms",
                                                        "acc", "var", "cov",    "accuracy"};
  if (names_rate(base)) return false;
  const std::string words = "_" + base + "_";
  const bool names_deviation = std::any_of(
      kDeviations.begin(), kDeviations.end(),
      [&](std::string_view word) { return words.find(fmt::format("_{}_", word)) != std::string::npos; });
  return names_deviation || 4 * edit_distance(base, nearest) <= std::max(base.size(), nearest.size());
}

void refuse_if_mistakable(const fs::path& path, const TableHeader& header, std::size_t field,
                          const std::string& base) {
  const std::string nearest = nearest_name(base, table_names());
  if (!may_be_mistaken(base, nearest)) return;
  fail(path, header, "names of columns as in docs/poses.md", fmt::format("'{}'", header.names[field]),
       fmt::format("Did you mean '{}'? Rename the column, or delete it.", nearest));
}

void place_column(const fs::path& path, std::size_t field, const ColumnName& name,
                  const ColumnMeaning& meaning, TableHeader& header) {
  auto& place = header.places.at(static_cast<std::size_t>(meaning.column));
  if (place) {
    fail(path, header, fmt::format("one column '{}'", to_string(meaning.column)),
         fmt::format("'{}' and '{}'", header.names[place->field], header.names[field]), "Delete one.");
  }
  const ColumnUnit unit = unit_of(path, header, field, name, quantity_of(meaning.column));
  place = ColumnSource{field, unit, meaning.factor};
}

bool has_any(const TableHeader& header, const ColumnTriple& triple) {
  return std::any_of(triple.begin(), triple.end(), [&](TableColumn column) { return header.has(column); });
}

[[noreturn]] void fail_missing(const fs::path& path, const TableHeader& header, std::string_view missing) {
  fail(path, header,
       fmt::format(
           "{} among the columns: time (s, ns) or frame; latitude, longitude (deg), height (m) or east, "
           "north, up (m); roll, pitch, heading (deg), or for all of these x, y, z (m), qx, qy, qz, qw; "
           "perhaps "
           "std_east, std_north, std_up (m), std_roll, std_pitch, std_heading (deg), with quaternions std_x, "
           "std_y, std_z (m), std_rx, std_ry, std_rz (deg)",
           missing),
       fmt::format("{}", fmt::join(header.names, ", ")), "Add or rename columns (docs/poses.md).");
}

template <std::size_t N>
void expect_all(const fs::path& path, const TableHeader& header, const std::array<TableColumn, N>& columns) {
  for (const TableColumn column : columns) {
    if (!header.has(column)) fail_missing(path, header, fmt::format("'{}'", to_string(column)));
  }
}

void expect_one(const fs::path& path, const TableHeader& header, bool first, bool second,
                std::string_view choices) {
  if (first != second) return;
  if (!first) fail_missing(path, header, choices);
  fail(path, header, fmt::format("either {}", choices), "both", "Delete or rename those that do not count.");
}

/// "height" beside east and north is "up": a local world has no ellipsoid.
void take_height_for_up(TableHeader& header) {
  auto& height = header.places.at(static_cast<std::size_t>(TableColumn::height));
  auto& up = header.places.at(static_cast<std::size_t>(TableColumn::up));
  const bool geodetic = header.has(TableColumn::latitude) || header.has(TableColumn::longitude);
  const bool local = header.has(TableColumn::east) || header.has(TableColumn::north);
  if (height && !up && !geodetic && local) up.swap(height);
}

/// "yaw" beside latitude and longitude is the heading: surveyors' programs write it clockwise from north. In
/// a local world it may as well be counted from x, so that it stays unknown there.
void take_yaw_for_heading(const fs::path& path, TableHeader& header) {
  if (header.has(TableColumn::heading) || !header.has(TableColumn::latitude)) return;
  for (std::size_t field = 0; field < header.names.size(); ++field) {
    const ColumnName name = split_name(header.names[field]);
    if (name.base != "yaw") continue;
    place_column(path, field, name, {TableColumn::heading}, header);
    header.heading_by_yaw = true;
  }
}

}  // namespace

std::optional<TableHeader> find_table_header(const fs::path& path) {
  constexpr int kLongestHead = 200;  // lines; no file names its columns further down
  const std::string contents = plain_table_text(read_file(path));
  LineScanner scanner(contents);
  Candidates candidates;
  while (scanner.number < kLongestHead && scanner.next()) {
    if (scanner.line.empty()) continue;
    if (!begins_with_number(scanner.line)) {
      consider(scanner.line, scanner.number, candidates);
      continue;
    }
    const auto values = static_cast<std::size_t>(std::count(scanner.line.begin(), scanner.line.end(), ','));
    if (candidates.unknown && candidates.unknown->names.size() <= values) candidates.unknown.reset();
    const auto& places = candidates.without_rotation;
    if (!candidates.known && places && places->names.size() == values + 1) return places;
    break;
  }
  return candidates.known ? candidates.known : candidates.unknown;
}

bool names_quaternions(const TableHeader& header) {
  const NameCounts counts = count_names(header.names);
  return counts.quaternion > 0 || (counts.position == 3 && counts.table == 0);
}

void check_table_header(const fs::path& path, TableHeader& header) {
  for (std::size_t field = 0; field < header.names.size(); ++field) {
    const ColumnName name = split_name(header.names[field]);
    if (const auto meaning = find_column(name.base); meaning && meaning->column < TableColumn::std_x)
      place_column(path, field, name, *meaning, header);
    else
      refuse_if_mistakable(path, header, field, name.base);
  }
  take_yaw_for_heading(path, header);
  take_height_for_up(header);
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

void check_quaternion_header(const fs::path& path, TableHeader& header) {
  std::vector<std::string> numbered;
  for (std::size_t field = 0; field < header.names.size(); ++field) {
    const ColumnName name = split_name(header.names[field]);
    if (is_numbered_quaternion(name.base)) numbered.push_back(header.names[field]);
    const auto meaning = find_column(name.base);
    const bool is_wanted =
        meaning && (meaning->column <= TableColumn::frame || meaning->column >= TableColumn::x);
    if (is_wanted) place_column(path, field, name, *meaning, header);
  }
  if (!numbered.empty()) {
    fail(path, header, "the quaternion's columns by the names qx, qy, qz, qw",
         fmt::format("{}", fmt::join(numbered, ", ")),
         "Rename them: numbers do not say which one is the scalar part, qw.");
  }
  auto& frame = header.places.at(static_cast<std::size_t>(TableColumn::frame));
  if (header.has(TableColumn::time)) frame.reset();  // the time says more
  if (!frame && !header.has(TableColumn::time)) fail_missing(path, header, "'time' or 'frame'");
  expect_all(path, header, kPosition);
  expect_all(path, header, kQuaternion);
  for (const ColumnTriple& triple : {kPositionDeviations, kRotationDeviations}) {
    if (has_any(header, triple)) expect_all(path, header, triple);
  }
}

}  // namespace cairn
