// SPDX-License-Identifier: Apache-2.0
#include "fusion.h"

namespace cairn::app {

PosedSequence open_posed_sequence(const SequenceArguments& arguments, const PoseArguments& poses) {
  PosedSequence posed{open_sequence(arguments.folder, arguments.options()), {}};
  print_warnings(posed.sequence.report.warnings);
  posed.world_from_camera = read_reported_poses(posed.sequence, poses);
  return posed;
}

}  // namespace cairn::app
