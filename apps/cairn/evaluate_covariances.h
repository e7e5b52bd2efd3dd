// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cairn/report/evaluation_report.h"
#include "compared_trajectories.h"

namespace cairn::app {

/// Assesses the covariances that the runs among the estimates state of their poses: localization.csv of cairn
/// localize, keyframe_covariances.csv of cairn slam. Does nothing for estimates without alignment or such a
/// file. InputError for a defect in these files.
void assess_covariances(const ComparedTrajectories& compared, EvaluationReport& report);

/// Tells whether a covariance of an estimate was assessed.
[[nodiscard]] bool has_covariances(const EvaluationReport& report);

/// Throws InputError that says which covariances a file has to state, because no estimate states any that
/// pairs with a pose of the reference.
[[noreturn]] void fail_without_covariances(const EvaluationReport& report);

}  // namespace cairn::app
