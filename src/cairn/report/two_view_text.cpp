// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "cairn/report/text_builder.h"
#include "cairn/report/two_view_figures.h"
#include "cairn/report/two_view_report.h"

namespace cairn {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr const char* kMotionNames[] = {"R1, t", "R1, -t", "R2, t", "R2, -t"};

std::string row_of(const Eigen::RowVector3d& row) {
  constexpr double kShown = 5e-16;  // what rounding leaves of 0
  std::string text;
  for (const double value : row) text += fmt::format(" {:12.6g}", std::abs(value) < kShown ? 0.0 : value);
  return text;
}

void add_matrix(const std::string& name, const Eigen::Matrix3d& matrix, TextBuilder& text) {
  for (int i = 0; i < 3; ++i) text.add("{:<16}{}\n", i == 0 ? name : "", row_of(matrix.row(i)));
}

void add_vector(const std::string& name, const Eigen::Vector3d& vector, TextBuilder& text) {
  text.add("{:<16}{}\n", name, row_of(vector.transpose()));
}

void add_ransac(const char* name, const RansacResult<Eigen::Matrix3d>& result, std::size_t matches,
                TextBuilder& text) {
  if (!result.found()) {
    text.add("{:<16} none of {} samples: {}\n", name, result.iterations, to_string(result.status));
    return;
  }
  text.add("{:<16} {} of {} matches agree, {} samples, 10^{:.0f} false alarms expected\n", name,
           result.inliers.size(), matches, result.iterations, result.log10_false_alarms);
}

void add_choice(const TwoViewResult& result, TextBuilder& text) {
  text.add("choice           {}: least GRIC of", to_string(result.choice.model));
  for (std::size_t i = 0; i < result.choice.gric.size(); ++i)
    text.add("{} {:.1f} ({})", i == 0 ? "" : ",", result.choice.gric[i],
             to_string(static_cast<TwoViewModel>(i)));
  text.add(", {} matches\n", result.choice.pairs);
}

void add_motions(const TwoViewResult& result, TextBuilder& text) {
  for (std::size_t i = 0; i < result.motions.size(); ++i) {
    const TwoViewMotion& motion = result.motions[i];
    text.add("{:<16} {} of {} matches in front of both cameras{}\n", kMotionNames[i], motion.in_front,
             motion.parted, i == result.motion ? "  <- most" : "");
  }
}

void add_chosen(const TwoViewReport& report, TextBuilder& text) {
  const Rigid3& b_from_a = report.result.b_from_a;
  text.add("motion           point in B = R * point in A + t, t in {}\n",
           report.scale && report.scale->points > 0 ? "metres" : "units of its length");
  add_matrix("R", b_from_a.matrix3(), text);
  add_vector("t", report.unit() * b_from_a.translation, text);
  text.add("{:<16} {:.4f} deg\n", "angle", kDegrees * rotation_angle(b_from_a.rotation));
}

std::string scale_text(const MetricScale& scale) {
  if (scale.points == 0) return "not known: no point has a depth";
  return fmt::format("{:.6g} m between the cameras, median over {} points with depth, spread {:.2g} %",
                     scale.metres_per_unit, scale.points, 100 * scale.relative_mad);
}

}  // namespace

std::string format_two_view_text(const TwoViewReport& report) {
  TextBuilder text;
  const TwoViewResult& result = report.result;
  for (const TimedFeatures* image : {&report.a, &report.b})
    text.add("{}  {} keypoints\n", image->path, image->features.keypoints.size());
  const std::size_t matches = report.pixels_in_a.size();
  text.add("matches          {}, standard deviation of a pixel {} px\n", matches, report.sigma_px);
  add_ransac("essential", result.essential, matches, text);
  add_ransac("homography", result.homography, matches, text);
  if (!result.essential.found() && !result.homography.found()) return text.take();
  add_choice(result, text);
  if (result.essential.found())
    text.append(
        format_decomposition_text(result.essential.model, decompose_essential(result.essential.model)));
  if (result.choice.model == TwoViewModel::homography) add_matrix("H", result.homography.model, text);
  if (result.choice.model != TwoViewModel::rotation) add_motions(result, text);
  add_chosen(report, text);
  if (report.scale) text.add("scale            {}\n", scale_text(*report.scale));
  if (!result.points.empty())
    text.add("points           {}, {:.3g} px RMS\n", result.points.size(), rms_px(report));
  return text.take();
}

std::string format_decomposition_text(const Eigen::Matrix3d& essential, const EssentialDecomposition& parts) {
  TextBuilder text;
  const bool mirrored = parts.factors[0].determinant() < 0;
  add_matrix("E", essential, text);
  add_vector("singular values", parts.singular_values, text);
  add_matrix("U W^T V^T", parts.factors[0], text);
  add_matrix("U W V^T", parts.factors[1], text);
  text.add("determinant      {}\n", mirrored ? "-1: a rotation is the negative of each, as -E is E's equal"
                                             : "1: these are the rotations");
  add_matrix("R1", parts.rotations[0], text);
  add_matrix("R2", parts.rotations[1], text);
  add_vector("t", parts.translation, text);
  add_vector("-t", -parts.translation, text);
  add_matrix("t^R1", skew(parts.translation) * parts.rotations[0], text);
  add_matrix("-t^R2", skew(-parts.translation) * parts.rotations[1], text);
  return text.take();
}

}  // namespace cairn
