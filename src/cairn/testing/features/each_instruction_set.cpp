// SPDX-License-Identifier: Apache-2.0
#include "cairn/testing/features/each_instruction_set.h"

#include <algorithm>

namespace cairn::testkit {

std::string name_of_parameter(const ::testing::TestParamInfo<InstructionSet>& tested) {
  std::string name(name_of(tested.param));
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

}  // namespace cairn::testkit
