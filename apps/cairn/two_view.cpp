// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/two_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/dense/ply.h"
#include "cairn/image/codec.h"
#include "cairn/image/registration.h"
#include "cairn/matching/matching.h"
#include "cairn/observe/depth_scale.h"
#include "cairn/report/two_view_report.h"
#include "cairn/sequence/camera_numbers.h"
#include "camera_argument.h"
#include "commands.h"
#include "feature_arguments.h"

namespace cairn::app {
namespace {

struct TwoViewArguments : FeatureArguments {
  std::string first, second, camera, essential, depth, output;
  double depth_scale = 0;
  double sigma_px = 1;
  double max_ratio = 0.8;
  TwoViewOptions options;
};

void declare_inputs(CommandLine& app, TwoViewArguments& arguments) {
  Option first = app.add_option("A", arguments.first, "image: PNG, JPEG, binary PGM or PPM");
  Option second = app.add_option("B", arguments.second, "image of the same scene from another place");
  first.needs(second);
  const Option camera = add_camera_option(app, arguments.camera);
  second.needs(camera);
  app.add_option("--essential", arguments.essential,
                 "take this matrix apart, row by row, instead of that of two images")
      .type_name("e1,...,e9")
      .excludes(first);
  const Option depth =
      app.add_option("--depth", arguments.depth, "depth image registered to A, for the scale")
          .type_name("A_DEPTH")
          .needs(first);
  app.add_option("--depth-scale", arguments.depth_scale, "its units per metre (default: the camera's)")
      .check(number_in(1e-9, 1e9))
      .type_name("N")
      .needs(depth);
}

void declare(CommandLine& app, TwoViewArguments& arguments) {
  declare_inputs(app, arguments);
  add_feature_options(app, arguments);
  app.add_option(
         "--ratio", arguments.max_ratio,
         "believe a match only if it is nearer than this share of the second nearest; 0: no such test")
      .check(number_in(0, 1))
      .type_name("X")
      .show_default();
  app.add_option(
         "--sigma", arguments.sigma_px,
         "standard deviation of a matched pixel's column and row, pixels: decides which matches agree")
      .check(number_in(1e-3, 1e3))
      .type_name("PX")
      .show_default();
  app.add_option("--iterations", arguments.options.ransac.max_iterations, "at most so many samples")
      .check(number_in(1, 10'000'000))
      .type_name("N")
      .show_default();
  app.add_option("--output", arguments.output, "the points, in A's camera").type_name("OUT.csv|OUT.ply");
  add_common_options(app, arguments.common, {.threads = true, .seed = true, .quiet = false});
  app.footer(
      "Example: cairn two-view a.png b.png --camera tum-fr1 --depth a_depth.png --output points.csv\n"
      "Exit code 1: the images do not determine the motion, and the output says why.");
}

/// Pixels of matches and what the camera makes of them; those that it cannot undistort are left out.
struct MatchedPixels {
  std::vector<Eigen::Vector2d> a, b, rays_a, rays_b;
};

MatchedPixels match_pixels(const TimedFeatures& a, const TimedFeatures& b, const Camera& camera,
                           const TwoViewArguments& arguments, const Executor& executor) {
  MatchOptions options;
  options.max_ratio = arguments.max_ratio;
  options.mutual = true;
  MatchedPixels pixels;
  for (const Match& match :
       match_descriptors(a.features.descriptors, b.features.descriptors, options, executor)) {
    const Keypoint& from = a.features.keypoints[static_cast<std::size_t>(match.query)];
    const Keypoint& to = b.features.keypoints[static_cast<std::size_t>(match.train)];
    const Eigen::Vector2d p(from.u, from.v), q(to.u, to.v);
    const auto ray_a = camera.unproject(p), ray_b = camera.unproject(q);
    if (!ray_a || !ray_b) continue;
    pixels.a.push_back(p);
    pixels.b.push_back(q);
    pixels.rays_a.push_back(*ray_a);
    pixels.rays_b.push_back(*ray_b);
  }
  return pixels;
}

/// InputError where the image's size is not that of A, and where nobody says how depth is stored.
RawDepthImage read_depth_of(const TwoViewArguments& arguments, const GrayImage& a, double units_per_metre) {
  if (!(units_per_metre > 0)) {
    throw InputError({"--depth-scale", 0, "units per metre of the depth image", "none, and none in --camera",
                      "Give 1000 for millimetres, 5000 for the TUM benchmark."});
  }
  RawDepthImage depth = read_depth(arguments.depth);
  if (depth.width() != a.width() || depth.height() != a.height()) {
    throw InputError({arguments.depth, 0, fmt::format("{}x{} pixels, as A has", a.width(), a.height()),
                      fmt::format("{}x{}", depth.width(), depth.height()),
                      "Give the depth image that is registered to A."});
  }
  return depth;
}

void warn_of_scale(const RawDepthImage& depth, double units, const std::vector<std::uint16_t>& invalid) {
  const DepthImage metres = depth_in_metres(depth, units, invalid);
  const auto figures = depth_figures({metres.data(), metres.data() + metres.size()});
  const auto doubt =
      figures ? doubt_depth_scale(*figures, units, "--depth-scale, or that of the camera") : std::nullopt;
  if (doubt) fmt::print(stderr, "cairn: {}\n", *doubt);
}

MetricScale scale_of(const TwoViewArguments& arguments, const Calibration& calibration,
                     const TwoViewReport& report) {
  const double given = arguments.depth_scale;
  const double units = given > 0 ? given : calibration.depth ? calibration.depth->scale : 0.0;
  const RawDepthImage depth = read_depth_of(arguments, report.a.image, units);
  const std::vector<std::uint16_t> invalid =
      calibration.depth ? calibration.depth->invalid : std::vector<std::uint16_t>{0};
  warn_of_scale(depth, units, invalid);
  std::vector<double> depths_m;
  for (const TwoViewPoint& point : report.result.points) {
    const Eigen::Vector2d& pixel = report.pixels_in_a[static_cast<std::size_t>(point.pair)];
    const std::uint16_t raw =
        depth(static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y())));
    const bool known = std::find(invalid.begin(), invalid.end(), raw) == invalid.end();
    depths_m.push_back(known ? raw / units : 0.0);
  }
  return metric_scale(report.result.points, depths_m);
}

bool is_ply(const std::string& path) {
  return std::filesystem::path(path).extension() == ".ply";
}

int decompose_given(const TwoViewArguments& arguments) {
  const std::vector<double> e = parse_number_list(arguments.essential, 9, "--essential", "row by row");
  const Eigen::Matrix3d essential = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(e.data());
  if (!(essential.norm() > 0))
    throw InputError({"--essential", 0, "a matrix that is not zero", "zeros", "Give E = t^R."});
  const EssentialDecomposition parts = decompose_essential(essential);
  fmt::print("{}", arguments.common.json ? format_decomposition_json(essential, parts)
                                         : format_decomposition_text(essential, parts));
  constexpr double kNoEssentialMatrix = 0.01;
  const double distance = relative_distance(essential, parts);
  if (distance <= kNoEssentialMatrix) return 0;
  fmt::print(
      stderr,
      "cairn: this is no essential matrix: its singular values are not s, s, 0. What is printed belongs "
      "to the nearest one, {:.2g} % away.\n",
      100 * distance);
  return 1;
}

int reconstruct(TwoViewArguments& arguments) {
  if (arguments.second.empty()) {
    throw InputError({"A and B", 0, "two images and --camera, or --essential", "none",
                      "'cairn two-view --help' has an example."});
  }
  const Calibration calibration = read_named_calibration(arguments.camera);
  const Executor executor(arguments.common.thread_count());
  const auto extractor = arguments.extractor();
  const TimedFeatures a = extract_timed(arguments.first, arguments, *extractor, executor);
  const TimedFeatures b = extract_timed(arguments.second, arguments, *extractor, executor);
  MatchedPixels pixels = match_pixels(a, b, calibration.camera, arguments, executor);

  const double focal_px = std::sqrt(calibration.camera.fx * calibration.camera.fy);
  arguments.options.ransac.seed = arguments.common.seed;
  TwoViewReport report{a, b, std::move(pixels.a), std::move(pixels.b), arguments.sigma_px, focal_px, {}, {}};
  report.result =
      reconstruct_two_views(pixels.rays_a, pixels.rays_b, arguments.sigma_px / focal_px, arguments.options);
  if (!arguments.depth.empty()) report.scale = scale_of(arguments, calibration, report);
  fmt::print("{}", arguments.common.json ? format_two_view_json(report) : format_two_view_text(report));
  if (report.result.status != TwoViewStatus::ok) {
    fmt::print(stderr, "cairn: no motion between {} and {}: {}.\n", arguments.first, arguments.second,
               to_string(report.result.status));
    return 1;
  }
  if (is_ply(arguments.output)) {
    write_ply(arguments.output, cloud_of(report));
  } else if (!arguments.output.empty()) {
    write_file(arguments.output, format_points_csv(report));
  }
  return 0;
}

}  // namespace

int run_two_view(int argc, char** argv) {
  TwoViewArguments arguments;
  CommandLine app("Motion of the camera between two images, and the points that both see.", "two-view");
  declare(app, arguments);
  if (const auto code = app.parse(argc, argv)) return *code;
  return arguments.essential.empty() ? reconstruct(arguments) : decompose_given(arguments);
}

}  // namespace cairn::app
