// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/stereo_calibration.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cairn/report/json_pieces.h"

namespace cairn {
namespace {

Json rows_json(const RowErrors& rows, bool applied) {
  return {{"pairs", rows.pairs},
          {"matches", rows.matches},
          {"terms_px", std::vector<double>(rows.field.begin(), rows.field.end())},
          {"rms_px", rows.rms_px},
          {"scatter_px", rows.scatter_px},
          {"halves_differ_px", rows.halves_differ_px},
          {"determined", rows.is_determined()},
          {"applied", applied}};
}

Json disparities_json(const DisparityCalibration& found) {
  return {{"disparities", found.disparities},
          {"estimates", found.estimates},
          {"terms_px", std::vector<double>(found.field.begin(), found.field.end())},
          {"sigma_px", std::vector<double>(found.sigma.begin(), found.sigma.end())},
          {"rms_px", found.rms_px},
          {"cost_fall", found.cost_fall},
          {"halves_differ_px", found.halves_differ_px},
          {"determined", found.is_determined()},
          {"applied", found.applied}};
}

const char* state_of(bool is_determined, bool applied) {
  if (applied) return "corrected";
  return is_determined ? "left as they are" : "not determined";
}

std::string describe_rows(const RowErrors& rows, bool aligned) {
  if (rows.pairs == 0) return "rows as stated";
  return fmt::format("rows off by {:.2f} px RMS, {}", rows.rms_px, state_of(rows.is_determined(), aligned));
}

std::string describe_disparities(const DisparityCalibration& found) {
  if (found.estimates == 0) return "disparities not measured";
  return fmt::format("disparities by {:.2f} px RMS ({:+.2f} +- {:.2f} px in the middle), {}", found.rms_px,
                     found.field[0], found.sigma[0], state_of(found.is_determined(), found.applied));
}

}  // namespace

Json to_json(const StereoCalibrationFigures& figures) {
  if (figures.rows.pairs == 0 && figures.disparities.estimates == 0) return nullptr;
  return {{"rows", rows_json(figures.rows, figures.rows_aligned)},
          {"disparities", disparities_json(figures.disparities)}};
}

std::string describe(const StereoCalibrationFigures& figures) {
  const auto& [rows, rows_aligned, disparities] = figures;
  if (rows.pairs == 0 && disparities.estimates == 0) return "";
  return "stereo pair  " + describe_rows(rows, rows_aligned) + "; " + describe_disparities(disparities);
}

}  // namespace cairn
