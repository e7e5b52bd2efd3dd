// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "cairn/core/error.h"
#include "cairn/core/text.h"
#include "cairn/geometry/camera_pose.h"
#include "cairn/geometry/pnp_ransac.h"
#include "camera_argument.h"
#include "commands.h"
#include "named_values.h"

namespace cairn::app {
namespace {

const NamedValues<PoseMethod> kMethods = {{"lm", PoseMethod::levenberg_marquardt},
                                          {"gauss-newton", PoseMethod::gauss_newton}};

struct PnpArguments {
  CommonOptions common;
  std::string points, pixels, camera, start = "ransac", method = "lm", kernel = "none";
  double sigma_px = 1;
  bool trace = false;
  PoseOptions fit{.kernel = RobustKernel::none};
  RansacOptions ransac;
};

void declare_fit(CommandLine& app, PnpArguments& arguments) {
  app.add_option("--method", arguments.method, "Levenberg-Marquardt or plain Gauss-Newton")
      .check(one_of(names_of(kMethods)))
      .type_name("METHOD")
      .show_default();
  app.add_option("--kernel", arguments.kernel,
                 "what large residuals cost: none, huber, cauchy or geman-mcclure, from weak to strong")
      .check(one_of(names_of(kKernels)))
      .type_name("KERNEL")
      .show_default();
  app.add_option("--kernel-scale", arguments.fit.kernel_scale,
                 "standard deviations at which --kernel sets in")
      .check(number_in(1e-9, 1e9))
      .type_name("S")
      .show_default();
  app.add_option("--iterations", arguments.fit.max_iterations, "at most so many steps")
      .check(number_in(1, 1'000'000))
      .type_name("N")
      .show_default();
  app.add_flag("--trace", arguments.trace, "print the cost after each step");
}

void declare(CommandLine& app, PnpArguments& arguments) {
  app.add_option("POINTS", arguments.points, "points in the world, lines `x y z`, metres").required();
  app.add_option("PIXELS", arguments.pixels, "where the camera sees them, lines `u v`").required();
  add_camera_option(app, arguments.camera).required();
  app.add_option(
         "--start", arguments.start,
         "ransac: P3P in RANSAC, then least squares over its inliers; identity: least squares over all "
         "points from the identity")
      .check(one_of({"ransac", "identity"}))
      .type_name("START")
      .show_default();
  app.add_option("--samples", arguments.ransac.max_iterations, "of RANSAC, at most")
      .check(number_in(1, 10'000'000))
      .type_name("N")
      .show_default();
  app.add_option("--sigma", arguments.sigma_px, "standard deviation of a pixel's column and row, pixels")
      .check(number_in(1e-6, 1e6))
      .type_name("PX")
      .show_default();
  declare_fit(app, arguments);
  add_common_options(app, arguments.common, {.seed = true, .quiet = false});
  app.footer(
      "Example: cairn pnp p3d.txt p2d.txt --camera 520.9,521.0,325.1,249.7 --trace\n"
      "Exit code 1: the points do not determine a pose, or no pose has more of them agree than chance "
      "would.");
}

/// What the two files hold; pixels undistorted.
struct PnpInput {
  Rig rig;
  std::vector<Eigen::Vector3d> points;
  std::vector<Observation> seen;
};

Observation observation_of(const TextFile& file, const TextLine& line, const Camera& camera, const Rig& rig,
                           double sigma_px) {
  const Eigen::Vector2d pixel(file.number(line, 0, "u"), file.number(line, 1, "v"));
  const auto ray = camera.unproject(pixel);
  if (!ray)
    file.fail(line, "a pixel that the camera can undistort", fmt::format("{} {}", pixel.x(), pixel.y()),
              "Check the pixel and the distortion.");
  Observation seen{rig.fx * ray->x() + rig.cx, rig.fy * ray->y() + rig.cy};
  seen.sigma_px = sigma_px;
  return seen;
}

PnpInput read_input(const PnpArguments& arguments) {
  const Camera camera = read_camera_argument(arguments.camera).camera;
  const TextFile points(arguments.points), pixels(arguments.pixels);
  if (points.lines().size() != pixels.lines().size()) {
    throw InputError({arguments.pixels, 0,
                      fmt::format("{} pixels, one for each point", points.lines().size()),
                      fmt::format("{}", pixels.lines().size()), "Give the files of one set of points."});
  }
  constexpr double kUnusedBaseline = 1.0;  // no observation has a disparity
  PnpInput input{{camera.fx, camera.fy, camera.cx, camera.cy, kUnusedBaseline}, {}, {}};
  for (std::size_t i = 0; i < points.lines().size(); ++i) {
    const TextLine &point = points.lines()[i], &pixel = pixels.lines()[i];
    points.expect_fields(point, 3, "x y z");
    pixels.expect_fields(pixel, 2, "u v");
    input.points.emplace_back(points.number(point, 0, "x"), points.number(point, 1, "y"),
                              points.number(point, 2, "z"));
    input.seen.push_back(observation_of(pixels, pixel, camera, input.rig, arguments.sigma_px));
  }
  return input;
}

/// What came out.
struct PnpReport {
  std::size_t points = 0;
  std::optional<PnpResult> ransac;  ///< not with --start identity
  std::size_t used = 0;
  PoseEstimate fit;
  RansacReport judged;  ///< of the fit's pose, by all points; where the fit is ok
};

/// Least squares over all points from the identity, or over the inliers from RANSAC's pose.
PnpReport estimate(const PnpInput& input, const PnpArguments& arguments) {
  PnpReport report;
  report.points = input.points.size();
  PoseOptions options = arguments.fit;
  CameraFromWorld start;
  if (arguments.start == "identity") {
    options.selection = PoseSelection::all;
  } else {
    report.ransac = solve_pnp_ransac(input.rig, input.points, input.seen, arguments.ransac);
    if (!report.ransac->found()) return report;
    options.selection = PoseSelection::inliers;
    start = report.ransac->camera_from_world;
  }
  report.fit = estimate_pose(input.rig, {input.points, input.seen}, start, options);
  report.used = report.ransac ? report.fit.inliers.size() : report.points;
  if (report.fit.status == PoseStatus::ok)
    report.judged = judge_pose(input.rig, input.points, input.seen, report.fit.camera_from_world);
  return report;
}

/// Why there is no pose; empty where there is one.
std::string failure_of(const PnpReport& report) {
  if (report.ransac && !report.ransac->found()) return std::string(to_string(report.ransac->status));
  if (report.fit.status != PoseStatus::ok) return std::string(to_string(report.fit.status));
  if (!report.judged.found()) return std::string(to_string(report.judged.status));
  return "";
}

/// Where steps are left, the pose so far is of use to who follows them; any other failure has none.
bool has_pose(const PnpReport& report) {
  return failure_of(report).empty() || report.fit.status == PoseStatus::not_converged;
}

void print_trace(const PoseEstimate& fit) {
  fmt::print("{:>9} {:>18} {:>12} {:>9}\n", "iteration", "cost", "step", "lambda");
  for (std::size_t i = 0; i < fit.trace.size(); ++i) {
    const PoseIteration& row = fit.trace[i];
    fmt::print("{:>9} {:>18.10g} {:>12.4g} {:>9.2g}{}\n", i, row.cost, row.step, row.lambda,
               row.accepted ? "" : "  rejected");
  }
}

void print_pose(const PnpArguments& arguments, const PoseEstimate& fit) {
  const Eigen::Matrix3d R = fit.camera_from_world.matrix3();
  for (int i = 0; i < 3; ++i)
    fmt::print("{:<13} {:12.9f} {:12.9f} {:12.9f} {:14.9f}\n",
               i == 0   ? "world to"
               : i == 1 ? "camera"
                        : "",
               R(i, 0), R(i, 1), R(i, 2), fit.camera_from_world.translation[i]);
  if (fit.status != PoseStatus::ok) return;
  const Vector6d deviation = fit.covariance.diagonal().cwiseSqrt();
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  fmt::print("std rotation  {:.3g} {:.3g} {:.3g} deg, by the noise of pixels alone\n",
             kDegrees * deviation[0], kDegrees * deviation[1], kDegrees * deviation[2]);
  fmt::print("std move      {:.3g} {:.3g} {:.3g} m, likewise: the points count as exact\n", deviation[3],
             deviation[4], deviation[5]);
  fmt::print("variance      {:.4g} times what sigma {} px says; multiply the stds by its root\n",
             fit.variance_factor, arguments.sigma_px);
}

void print_report(const PnpArguments& arguments, const PnpReport& report) {
  if (report.ransac)
    fmt::print("ransac        {} of {} points agree, {} samples, 10^{:.0f} false alarms expected\n",
               report.ransac->inliers.size(), report.points, report.ransac->iterations,
               report.ransac->log10_false_alarms);
  const PoseEstimate& fit = report.fit;
  if (arguments.trace) print_trace(fit);
  fmt::print("points        {} used of {}\n", report.used, report.points);
  fmt::print("iterations    {}, {}\n", fit.iterations(), to_string(fit.status));
  fmt::print("cost          {:.10g}  half the sum of squares over sigma^2{}\n", fit.cost,
             arguments.kernel == "none" ? "" : ", with the kernel");
  fmt::print("residual      {:.6g} px RMS\n", report.fit.rms_px);
  if (!report.ransac && fit.status == PoseStatus::ok)
    fmt::print("agreement     {} of {} points within the 95 % limit of sigma\n", report.judged.inliers.size(),
               report.points);
  if (has_pose(report)) print_pose(arguments, fit);
}

nlohmann::ordered_json rows_of(const Eigen::MatrixXd& matrix) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    nlohmann::ordered_json row = nlohmann::ordered_json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.push_back(matrix(i, j));
    rows.push_back(row);
  }
  return rows;
}

nlohmann::ordered_json to_json(const PnpReport& report) {
  const std::string failure = failure_of(report);
  nlohmann::ordered_json json = {{"status", failure.empty() ? "ok" : failure}, {"points", report.points}};
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

int run_pnp(int argc, char** argv) {
  PnpArguments arguments;
  CommandLine app("Pose of a camera from points and the pixels that show them.", "pnp");
  declare(app, arguments);
  if (const auto code = app.parse(argc, argv)) return *code;
  arguments.fit.kernel = kKernels.at(arguments.kernel);
  arguments.fit.method = kMethods.at(arguments.method);
  arguments.ransac.seed = arguments.common.seed;

  const PnpReport report = estimate(read_input(arguments), arguments);
  if (arguments.common.json) {
    fmt::print("{}\n", to_json(report).dump(2));
  } else if (!report.fit.trace.empty()) {
    print_report(arguments, report);
  }
  const std::string failure = failure_of(report);
  if (failure.empty()) return 0;
  fmt::print(stderr, "cairn: no pose from {} points: {}.\n", report.points, failure);
  return 1;
}

}  // namespace cairn::app
