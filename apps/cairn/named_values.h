// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "cairn/geometry/robust_kernel.h"

namespace cairn::app {

/// What an option's words stand for.
template <class Value>
using NamedValues = std::map<std::string, Value>;

template <class Value>
[[nodiscard]] std::vector<std::string> names_of(const NamedValues<Value>& values) {
  std::vector<std::string> names;
  for (const auto& entry : values) names.push_back(entry.first);
  return names;
}

inline const NamedValues<RobustKernel> kKernels = {{"none", RobustKernel::none},
                                                   {"huber", RobustKernel::huber},
                                                   {"cauchy", RobustKernel::cauchy},
                                                   {"geman-mcclure", RobustKernel::geman_mcclure}};

}  // namespace cairn::app
