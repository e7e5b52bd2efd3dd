// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "cairn/simd/available.h"

namespace cairn::testkit {

/// Runs a test once for each instruction set of this machine.
class EachInstructionSet : public ::testing::TestWithParam<InstructionSet> {};

/// Returns the name of the instruction set as GoogleTest allows it.
[[nodiscard]] std::string name_of_parameter(const ::testing::TestParamInfo<InstructionSet>& tested);

}  // namespace cairn::testkit
