// SPDX-License-Identifier: Apache-2.0
#include "cairn/core/parameter.h"
#include "cairn/sequence/sequence.h"

namespace cairn {
namespace {

constexpr const char* kRemedy = "Correct the value.";

void visit(CameraParameters& camera, ParameterVisitor& visitor) {
  visitor.parameter({"camera.fx", above(0, "pixels"),
                     "Focal length along rows; overrides the calibration. All five make one.", "", kRemedy},
                    camera.fx);
  visitor.parameter({"camera.fy", above(0, "pixels"),
                     "Focal length along columns; overrides the calibration.", "", kRemedy},
                    camera.fy);
  visitor.parameter(
      {"camera.cx", any("pixels"), "Column of the principal point; overrides the calibration.", "", kRemedy},
      camera.cx);
  visitor.parameter(
      {"camera.cy", any("pixels"), "Row of the principal point; overrides the calibration.", "", kRemedy},
      camera.cy);
  visitor.parameter({"camera.scale", above(0, "units per metre"),
                     "Scale of the depth images; overrides the calibration.", "camera.depth_scale", kRemedy},
                    camera.scale);
}

void visit_files(SequenceOptions& options, ParameterVisitor& visitor) {
  visitor.parameter({"start_index", any("a file number"), "First file, itself included."},
                    options.start_index);
  visitor.parameter({"end_index", any("a file number"),
                     "First file that is left out, as in the RGB-D tutorial: the last one is end_index - 1."},
                    options.end_index);
  visitor.parameter({"rgb_dir", any("a folder"),
                     "Numbered colour images, relative to the sequence or to where cairn runs."},
                    options.rgb_dir);
  visitor.parameter({"rgb_extension", any("a file extension"), "Extension of these colour images."},
                    options.rgb_extension);
  visitor.parameter({"depth_dir", any("a folder"),
                     "Numbered depth images, relative to the sequence or to where cairn runs."},
                    options.depth_dir);
  visitor.parameter({"depth_extension", any("a file extension"), "Extension of these depth images."},
                    options.depth_extension);
}

}  // namespace

void visit(SequenceOptions& options, ParameterVisitor& visitor) {
  visit(options.camera_parameters, visitor);
  visit_files(options, visitor);
  visitor.parameter(
      {"max_stamp_gap_s", from_to(0, 1e6, "seconds"),
       "TUM, EuRoC: largest difference between the stamps of colour and depth, or of left and right.", "",
       kRemedy},
      options.max_stamp_gap_s);
}

}  // namespace cairn
