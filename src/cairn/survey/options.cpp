// SPDX-License-Identifier: Apache-2.0
#include "cairn/survey/options.h"

#include <optional>
#include <string>

#include "cairn/core/parameter.h"

namespace cairn {
namespace {

void visit(TrackOptions& tracks, ParameterVisitor& visitor) {
  visitor.parameter(
      {"window", at_least(2, "frames"),
       "Frames for which a landmark may go unseen before it is finished. It bounds the memory."},
      tracks.window);
  visitor.parameter({"pose_frames", from(0, "a number of frames", "none"),
                     "Frames whose poses are adjusted at a time, to given poses and images, and that an "
                     "adjustment knows on either side of them.",
                     "smooth_frames"},
                    tracks.pose_frames);
  visitor.parameter(
      {"max_frames", at_least(3, "frames"), "Length at which a track is closed and a new one begins."},
      tracks.max_frames);
  visitor.parameter({"epipolar_px", above(0, "pixels"),
                     "Largest distance of a match from the epipolar line, times the larger scale of both "
                     "features."},
                    tracks.epipolar_px);
  visitor.parameter({"search_px", above(0, "pixels"),
                     "Search radius around the predicted position, at the finest scale, plus what the depth "
                     "leaves open."},
                    tracks.search_px);
  visitor.parameter({"max_ratio", from_to(0, 1, "a ratio", "off"),
                     "Largest distance of the nearest descriptor relative to that of the second nearest, "
                     "within the search radius."},
                    tracks.max_ratio);
  visitor.parameter(
      {"min_view_change", from(0, "radians"),
       "A frame that changes the view by less since the last one used is passed over: rotation, "
       "plus the distance moved divided by the median depth."},
      tracks.min_view_change);
}

void visit_adjustment(SurveyOptions& survey, ParameterVisitor& visitor) {
  visitor.parameter(
      {"adjust.min_frames", at_least(2, "frames"), "Fewest frames from which a landmark is solved."},
      survey.fit.min_observations);
  visitor.parameter({"adjust.max_error_sigmas", above(0, "standard deviations"),
                     "An observation with a larger error is dropped, the worst one first."},
                    survey.fit.max_error);
  visitor.parameter({"adjust.sigma_px", above(0, "pixels"),
                     "Standard deviation of u and v of a feature of the finest scale; times the scale for "
                     "others."},
                    survey.covariance.sigma_px);
  visitor.parameter({"adjust.pose_errors",
                     {},
                     "Whether the stated standard deviations of the given poses add to the covariance."},
                    survey.covariance.pose_errors);
}

/// Visits the four limits of one quantity; `name` is that of its parameters without the last word.
void visit_limits(ValueLimits& limits, const std::string& name, const char* unit, const std::string& quantity,
                  ParameterVisitor& visitor) {
  const auto visit_limit = [&](const char* which, const std::string& meaning, std::optional<double>& limit) {
    visitor.parameter({(name + which).c_str(), from(0, unit), meaning.c_str()}, limit);
  };
  visit_limit(".min", "Smallest " + quantity + ", for every observation.", limits.min);
  visit_limit(".max", "Largest " + quantity + ", for every observation.", limits.max);
  visit_limit(".max_mean", "Largest mean over the observations of the " + quantity + ".", limits.max_mean);
  visit_limit(".max_std", "Largest standard deviation over the observations of the " + quantity + ".",
              limits.max_std);
}

void visit(CleaningOptions& cleaning, ParameterVisitor& visitor) {
  visitor.parameter({"clean.min_frames", at_least(2, "frames"),
                     "Fewest frames left of a landmark after bad observations were dropped."},
                    cleaning.min_frames);
  visitor.parameter({"clean.max_std_m", above(0, "metres"),
                     "Largest standard deviation of a landmark along its worst direction by its own noise, "
                     "without what its "
                     "observations have in common and what the deviations of the poses add."},
                    cleaning.max_std_m);
  visitor.parameter({"clean.max_rms_px", above(0, "pixels"), "Largest RMS residual of (u, v)."},
                    cleaning.max_rms_px);
  visitor.parameter(
      {"clean.min_ray_angle_deg", from(0, "degrees"),
       "Smallest value of the largest angle between two rays to a landmark; below it, the depth "
       "rests on the disparity alone."},
      cleaning.min_ray_angle_deg);
  visit_limits(cleaning.depth, "clean.depth", "metres", "depth along the optical axis", visitor);
  visit_limits(cleaning.distance, "clean.distance", "metres", "distance from the camera", visitor);
  visit_limits(cleaning.lateral, "clean.lateral", "metres", "distance from the optical axis", visitor);
  visit_limits(cleaning.angle_deg, "clean.angle_deg", "degrees", "angle between ray and optical axis",
               visitor);
  visitor.parameter({"clean.duplicate_sigmas", from(0, "standard deviations"),
                     "Largest difference of two landmarks that are merged, if they look alike and one point "
                     "fits all their observations."},
                    cleaning.duplicate_sigmas);
}

}  // namespace

void visit(SurveyOptions& options, ParameterVisitor& visitor) {
  visit(options.observer, visitor);
  visit(options.tracks, visitor);
  visit_adjustment(options, visitor);
  visit(options.cleaning, visitor);
}

void SurveyOptions::validate() const {
  observer.validate();
  check_ranges(*this);
}

}  // namespace cairn
