// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/core/text.h"
#include "cairn/geometry/camera_pose.h"
#include "cairn/geometry/pnp_ransac.h"
#include "cairn/report/pnp_report.h"
#include "cairn/sequence/camera_numbers.h"
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
  const Camera camera = read_named_calibration(arguments.camera).camera;
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
  const PnpTextOptions told{arguments.trace, arguments.fit.kernel != RobustKernel::none, arguments.sigma_px};
  fmt::print("{}", arguments.common.json ? format_pnp_json(report) : format_pnp_text(report, told));
  const std::string failure = failure_of(report);
  if (failure.empty()) return 0;
  fmt::print(stderr, "cairn: no pose from {} points: {}.\n", report.points, failure);
  return 1;
}

}  // namespace cairn::app
