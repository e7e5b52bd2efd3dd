// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/pnp_report.h"

#include <nlohmann/json.hpp>
#include <numbers>

#include "cairn/report/json_pieces.h"
#include "cairn/report/text_builder.h"

namespace cairn {
namespace {

/// Returns whether there is a pose to tell: also if steps are left, as who follows them can use the pose so
/// far.
bool has_pose(const PnpReport& report) {
  return failure_of(report).empty() || report.fit.status == PoseStatus::not_converged;
}

void add_trace(const PoseEstimate& fit, TextBuilder& text) {
  text.add("{:>9} {:>18} {:>12} {:>9}\n", "iteration", "cost", "step", "lambda");
  for (std::size_t i = 0; i < fit.trace.size(); ++i) {
    const PoseIteration& row = fit.trace[i];
    text.add("{:>9} {:>18.10g} {:>12.4g} {:>9.2g}{}\n", i, row.cost, row.step, row.lambda,
             row.accepted ? "" : "  rejected");
  }
}

void add_pose(const PoseEstimate& fit, double sigma_px, TextBuilder& text) {
  const Eigen::Matrix3d R = fit.camera_from_world.matrix3();
  for (int i = 0; i < 3; ++i)
    text.add("{:<13} {:12.9f} {:12.9f} {:12.9f} {:14.9f}\n",
             i == 0   ? "world to"
             : i == 1 ? "camera"
                      : "",
             R(i, 0), R(i, 1), R(i, 2), fit.camera_from_world.translation[i]);
  if (fit.status != PoseStatus::ok) return;
  const Vector6d deviation = fit.covariance.diagonal().cwiseSqrt();
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  text.add("std rotation  {:.3g} {:.3g} {:.3g} deg, by the noise of pixels alone\n", kDegrees * deviation[0],
           kDegrees * deviation[1], kDegrees * deviation[2]);
  text.add("std move      {:.3g} {:.3g} {:.3g} m, likewise: the points count as exact\n", deviation[3],
           deviation[4], deviation[5]);
  text.add("variance      {:.4g} times what sigma {} px says; multiply the stds by its root\n",
           fit.variance_factor, sigma_px);
}

Json to_json(const PnpReport& report) {
  const std::string failure = failure_of(report);
  Json json = {{"status", failure.empty() ? "ok" : failure}, {"points", report.points}};
  if (report.ransac) {
    json["inliers"] = report.ransac->inliers;
    json["samples"] = report.ransac->iterations;
    if (!report.ransac->found()) return json;
    json["log10_false_alarms"] = report.ransac->log10_false_alarms;
  }
  if (report.fit.trace.empty()) return json;
  json["iterations"] = report.fit.iterations();
  json["cost"] = report.fit.cost;
  json["rms_px"] = report.fit.rms_px;
  for (const PoseIteration& row : report.fit.trace)
    json["trace"].push_back(
        {{"cost", row.cost}, {"step", row.step}, {"lambda", row.lambda}, {"accepted", row.accepted}});
  if (!has_pose(report)) return json;
  Eigen::Matrix<double, 3, 4> camera_from_world;
  camera_from_world << report.fit.camera_from_world.matrix3(), report.fit.camera_from_world.translation;
  json["camera_from_world"] = rows_of(camera_from_world);
  if (report.fit.status != PoseStatus::ok) return json;
  json["covariance"] = rows_of(report.fit.covariance);
  json["variance_factor"] = report.fit.variance_factor;
  return json;
}

}  // namespace

std::string failure_of(const PnpReport& report) {
  if (report.ransac && !report.ransac->found()) return std::string(to_string(report.ransac->status));
  if (report.fit.status != PoseStatus::ok) return std::string(to_string(report.fit.status));
  if (!report.judged.found()) return std::string(to_string(report.judged.status));
  return "";
}

std::string format_pnp_text(const PnpReport& report, const PnpTextOptions& options) {
  if (report.fit.trace.empty()) return "";
  TextBuilder text;
  if (report.ransac)
    text.add("ransac        {} of {} points agree, {} samples, 10^{:.0f} false alarms expected\n",
             report.ransac->inliers.size(), report.points, report.ransac->iterations,
             report.ransac->log10_false_alarms);
  const PoseEstimate& fit = report.fit;
  if (options.trace) add_trace(fit, text);
  text.add("points        {} used of {}\n", report.used, report.points);
  text.add("iterations    {}, {}\n", fit.iterations(), to_string(fit.status));
  text.add("cost          {:.10g}  half the sum of squares over sigma^2{}\n", fit.cost,
           options.has_kernel ? ", with the kernel" : "");
  text.add("residual      {:.6g} px RMS\n", fit.rms_px);
  if (!report.ransac && fit.status == PoseStatus::ok)
    text.add("agreement     {} of {} points in their pixels, within the 95 % limit of sigma\n",
             report.judged.inliers.size(), report.points);
  if (has_pose(report)) add_pose(fit, options.sigma_px, text);
  return text.take();
}

std::string format_pnp_json(const PnpReport& report) {
  return format_document(to_json(report));
}

}  // namespace cairn
