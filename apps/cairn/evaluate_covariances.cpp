// SPDX-License-Identifier: Apache-2.0
#include "evaluate_covariances.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <utility>

#include "cairn/core/error.h"
#include "cairn/evaluate/covariance_table.h"
#include "cairn/evaluate/pose_consistency.h"

namespace cairn::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLocalizations = "localization.csv";
constexpr const char* kKeyframes = "keyframe_covariances.csv";

/// Returns the file's table with the stamps that its poses have in the comparison; rows of other poses are
/// left out.
CovarianceTable with_stamps_of(CovarianceTable table, const std::vector<std::int64_t>& file_stamps_ns,
                               const Trajectory& estimate) {
  std::map<std::int64_t, std::int64_t> stamp_of;
  for (std::size_t i = 0; i < estimate.size(); ++i) stamp_of[file_stamps_ns[i]] = estimate[i].stamp_ns;
  std::vector<CovarianceRow> rows;
  for (CovarianceRow& row : table.rows) {
    const auto found = stamp_of.find(row.stamp_ns);
    if (found == stamp_of.end()) continue;
    row.stamp_ns = found->second;
    rows.push_back(std::move(row));
  }
  if (rows.empty() && !table.rows.empty())
    throw InputError({table.path.string(), table.rows.front().line, "time stamps of the run's trajectory.txt",
                      "none of them in any line", "Keep the files of a run together."});
  table.rows = std::move(rows);
  return table;
}

std::optional<CovarianceTable> find_table(const fs::path& run, const char* name,
                                          std::span<const std::string_view> prefixes) {
  if (!fs::is_directory(run) || !fs::is_regular_file(run / name)) return std::nullopt;
  return read_covariance_table(run / name, prefixes);
}

}  // namespace

void assess_covariances(const ComparedTrajectories& compared, EvaluationReport& report) {
  for (std::size_t i = 0; i < report.estimates.size(); ++i) {
    EvaluatedTrajectory& evaluated = report.estimates[i];
    if (evaluated.result.status != EvaluationStatus::ok) continue;
    const double scale = evaluated.result.absolute.reference_from_estimate.scale;
    const auto add = [&](const std::optional<CovarianceTable>& read, auto assess) {
      if (!read) return;
      const CovarianceTable table = with_stamps_of(*read, compared.file_stamps_ns[i], evaluated.estimate);
      for (StatedPoses& stated : assess(table, evaluated.result.pairs, scale))
        evaluated.covariances.push_back(std::move(stated));
    };
    add(find_table(evaluated.path, kLocalizations, kLocalizationPrefixes), assess_localizations);
    add(find_table(evaluated.path, kKeyframes, kKeyframePrefixes), assess_keyframes);
  }
}

bool has_covariances(const EvaluationReport& report) {
  return std::any_of(
      report.estimates.begin(), report.estimates.end(), [](const EvaluatedTrajectory& evaluated) {
        return std::any_of(evaluated.covariances.begin(), evaluated.covariances.end(),
                           [](const StatedPoses& stated) { return stated.consistency.has_value(); });
      });
}

void fail_without_covariances(const EvaluationReport& report) {
  const fs::path run = report.estimates.front().path;
  for (const auto& [name, prefix] : {std::pair{kLocalizations, "cov_"}, {kKeyframes, "first_cov_"}}) {
    if (!fs::is_regular_file(run / name)) continue;
    throw InputError(
        {(run / name).string(), 0,
         fmt::format("covariances of poses that pair with REF, in columns {}rx_rx to {}z_z", prefix, prefix),
         "none", "Leave out --plot-coverage, or make the run again."});
  }
  throw InputError({run.string(), 0, "the folder of a run that states covariances of its poses", "none",
                    fmt::format("Name a run of cairn localize (with {}), or of cairn slam (with {}).",
                                kLocalizations, kKeyframes)});
}

}  // namespace cairn::app
