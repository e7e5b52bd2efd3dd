// SPDX-License-Identifier: Apache-2.0
#include "cairn/core/error.h"
#include "cairn/core/parameter.h"
#include "cairn/observe/observer.h"

namespace cairn {
namespace {

void visit(DepthNoise& depth, ParameterVisitor& visitor) {
  visitor.parameter({"depth.virtual_baseline", above(0, "metres"),
                     "Baseline b by which an RGB-D camera's depth z becomes a disparity fx b / z."},
                    depth.baseline);
  visitor.parameter({"depth.sigma_disparity_px", from(0, "pixels"),
                     "Standard deviation of such a disparity, that of a depth z is sigma z^2 / (fx b); 0: "
                     "estimated from the recording."},
                    depth.stated.sigma_px);
  visitor.parameter({"depth.sigma_m", from(0, "metres"),
                     "Part of a depth's standard deviation that does not depend on z; only with "
                     "depth.sigma_disparity_px above 0."},
                    depth.stated.sigma_m);
  visitor.parameter({"depth.jump_radius_px", from_to(0, 100, "pixels"),
                     "A feature nearer than this to a jump of the depth has no depth; times its scale."},
                    depth.jump_radius);
  visitor.parameter({"depth.jump_sigmas", above(0, "standard deviations"),
                     "Difference of disparities from which on depth jumps; of 0.09 px at least, or as "
                     "much as depth scatters around the feature."},
                    depth.jump_sigmas);
  visitor.parameter({"depth.min", from(0, "metres"), "A smaller depth is no reading."}, depth.min_depth);
  visitor.parameter({"depth.max", above(0, "metres"), "A larger depth is no reading; above depth.min."},
                    depth.max_depth);
}

void visit(StereoNoise& stereo, ParameterVisitor& visitor) {
  visitor.parameter({"stereo.min_depth", above(0, "metres"),
                     "Smallest depth: with the baseline, the largest disparity looked for."},
                    stereo.min_depth);
  visitor.parameter({"stereo.min_correlation", from_to(-1, 1, "a correlation"),
                     "Smallest correlation of the windows around a feature in both images."},
                    stereo.min_correlation);
  visitor.parameter({"stereo.search_images",
                     {},
                     "Whether a left feature without a right one is looked for in the right image itself."},
                    stereo.search_images);
  visitor.parameter({"stereo.min_disparity_sigmas", from(0, "standard deviations"),
                     "A disparity of fewer says nothing of the depth."},
                    stereo.min_disparity_sigmas);
  visitor.parameter({"stereo.sigma_floor_px", from(0, "pixels"),
                     "Standard deviation that every disparity has at least, as the cameras' mount sways."},
                    stereo.sigma_floor_px);
  visitor.parameter(
      {"stereo.self_calibration", any("auto, report or off"),
       "What is done about errors of the pair's calibration that the images show: auto corrects "
       "them where that matters, report only states them, off does not look."},
      stereo.self_calibration);
}

}  // namespace

void visit(ObserverOptions& options, ParameterVisitor& visitor) {
  visit(options.features, visitor);
  visit(options.depth_noise, visitor);
  visit(options.stereo_noise, visitor);
}

void ObserverOptions::validate() const {
  features.validate();
  check_ranges(*this);
  check_parameter(depth_noise.max_depth > depth_noise.min_depth, "depth.max", "metres above depth.min",
                  depth_noise.max_depth);
  check_parameter(depth_noise.stated.sigma_m == 0 || !depth_noise.is_estimated(), "depth.sigma_m",
                  "0 unless depth.sigma_disparity_px is above 0", depth_noise.stated.sigma_m);
  const std::string& choice = stereo_noise.self_calibration;
  if (choice != "auto" && choice != "report" && choice != "off")
    throw InputError(
        {"stereo.self_calibration", 0, "auto, report or off", choice, "Leave it out for the default, auto."});
}

}  // namespace cairn
