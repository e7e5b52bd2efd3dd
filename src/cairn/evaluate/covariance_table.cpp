// SPDX-License-Identifier: Apache-2.0
#include "cairn/evaluate/covariance_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/core/text.h"
#include "cairn/evaluate/consistency.h"

namespace cairn {
namespace {

using Fields = std::vector<std::string_view>;

constexpr std::array<std::string_view, 6> kAxes = {"rx", "ry", "rz", "x", "y", "z"};
constexpr std::size_t kColumns = 21;

Fields split(std::string_view line) {
  Fields fields;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    fields.push_back(line.substr(begin, end - begin));
    begin = end + 1;
  }
  return fields;
}

/// Parses a table line by line.
class TableReader {
 public:
  TableReader(const std::filesystem::path& path, std::span<const std::string_view> prefixes)
      : prefixes_(prefixes) {
    table_.path = path;
  }

  CovarianceTable read() {
    const std::string text = read_file(table_.path);
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      std::string_view line = std::string_view(text).substr(begin, end - begin);
      if (line.ends_with('\r')) line.remove_suffix(1);
      ++line_;
      if (!line.empty() && line.front() != '#') table_.header_line == 0 ? read_header(line) : read_row(line);
      begin = end + 1;
    }
    if (table_.header_line == 0) fail("a line that names the columns", "none", "Write the file anew.");
    return std::move(table_);
  }

 private:
  [[noreturn]] void fail(std::string expected, std::string found, std::string remedy) const {
    throw InputError({table_.path.string(), line_, std::move(expected), std::move(found), std::move(remedy)});
  }

  void read_header(std::string_view line) {
    table_.header_line = line_;
    for (const std::string_view name : split(line)) names_.emplace_back(name);
    if (!column("stamp_s")) fail("a column stamp_s", "none", "Name the columns in this line.");
    for (const std::string_view prefix : prefixes_) {
      const std::vector<std::string> wanted = covariance_columns(prefix);
      std::vector<std::size_t> found;
      std::string missing;
      for (const std::string& name : wanted)
        column(name) ? found.push_back(*column(name)) : missing.empty() ? void(missing = name) : void();
      if (found.empty()) continue;
      if (!missing.empty())
        fail(fmt::format("{} columns {} to {}", kColumns, wanted.front(), wanted.back()),
             fmt::format("none of the name {}", missing), "Add the column, or leave out all of them.");
      table_.prefixes.emplace_back(prefix);
      columns_.push_back(std::move(found));
    }
  }

  [[nodiscard]] std::optional<std::size_t> column(std::string_view name) const {
    const auto found = std::find(names_.begin(), names_.end(), name);
    return found == names_.end() ? std::nullopt : std::optional<std::size_t>(found - names_.begin());
  }

  /// Returns a field for each column; more of them lie in the column `file`, if there is one.
  [[nodiscard]] Fields fields_of(std::string_view line) const {
    Fields fields = split(line);
    const auto file = column("file");
    if (file && fields.size() > names_.size()) {
      const auto begin = fields.begin() + static_cast<std::ptrdiff_t>(*file) + 1;
      fields.erase(begin, begin + static_cast<std::ptrdiff_t>(fields.size() - names_.size()));
    }
    if (fields.size() != names_.size())
      fail(fmt::format("{} values, one for each column", names_.size()), fmt::format("{}", fields.size()),
           "Correct or delete the line.");
    return fields;
  }

  void read_row(std::string_view line) {
    const Fields fields = fields_of(line);
    CovarianceRow row;
    row.line = line_;
    if (const auto verdict = column("verdict")) {
      const std::string_view word = fields[*verdict];
      if (word == "none") return;
      row.is_weak = word == "weak";
      if (word != "good" && word != "weak")
        fail("the verdict good, weak or none", fmt::format("'{}'", word), "Correct or delete the line.");
    }
    const std::string_view stamp = fields[*column("stamp_s")];
    if (!parse_stamp(stamp, row.stamp_ns))
      fail("seconds in stamp_s", fmt::format("'{}'", stamp), "Correct or delete the line.");
    if (!table_.rows.empty() && row.stamp_ns <= table_.rows.back().stamp_ns)
      fail(fmt::format("a time stamp after {}", format_stamp(table_.rows.back().stamp_ns)),
           format_stamp(row.stamp_ns), "Sort the lines by time, and leave one for each stamp.");
    for (std::size_t set = 0; set < columns_.size(); ++set)
      row.covariances.push_back(read_covariance(fields, set, row));
    table_.rows.push_back(std::move(row));
  }

  [[nodiscard]] std::optional<Matrix6d> read_covariance(const Fields& fields, std::size_t set,
                                                        const CovarianceRow& row) const {
    const std::vector<std::size_t>& columns = columns_[set];
    const auto is_empty = [&](std::size_t column) { return fields[column].empty(); };
    if (std::all_of(columns.begin(), columns.end(), is_empty)) return std::nullopt;
    Matrix6d covariance;
    auto column = columns.begin();
    for (int i = 0; i < 6; ++i)
      for (int k = i; k < 6; ++k, ++column)
        covariance(i, k) = covariance(k, i) = number(fields[*column], names_[*column]);
    if (!covariance.allFinite() || covariance.isZero(0)) return std::nullopt;
    if (is_positive_definite(covariance)) return covariance;
    if (row.is_weak) return std::nullopt;
    fail(fmt::format("a positive definite covariance in {} to {}", names_[columns.front()],
                     names_[columns.back()]),
         "one that is not", "Correct the values, or leave these fields empty if none is known.");
  }

  /// Parses a number, which may be infinite or none.
  [[nodiscard]] double number(std::string_view text, const std::string& name) const {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc() && end == text.data() + text.size()) return value;
    fail(fmt::format("a number for {}", name), fmt::format("'{}'", text), "Correct or delete the line.");
  }

  std::span<const std::string_view> prefixes_;
  CovarianceTable table_;
  int line_ = 0;
  std::vector<std::string> names_;
  std::vector<std::vector<std::size_t>> columns_;  // of each of the table's prefixes
};

}  // namespace

std::vector<std::string> covariance_columns(std::string_view prefix) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < kAxes.size(); ++i)
    for (std::size_t k = i; k < kAxes.size(); ++k)
      names.push_back(fmt::format("{}{}_{}", prefix, kAxes[i], kAxes[k]));
  return names;
}

CovarianceTable read_covariance_table(const std::filesystem::path& path,
                                      std::span<const std::string_view> prefixes) {
  return TableReader(path, prefixes).read();
}

}  // namespace cairn
