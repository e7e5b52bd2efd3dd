// SPDX-License-Identifier: Apache-2.0
#include "cairn/simd/instruction_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "cairn/core/error.h"
#include "cairn/simd/available.h"

namespace cairn {
namespace {

constexpr std::array<std::string_view, 4> kNames{"plain", "sse4.2", "avx2", "avx512"};

std::vector<InstructionSet> detect() {
  std::vector<InstructionSet> sets{InstructionSet::plain};
#ifdef CAIRN_X86_KERNELS
  const bool sse42 = __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("popcnt");
  const bool avx2 = sse42 && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") &&
                    __builtin_cpu_supports("bmi2");
  const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") &&
                      __builtin_cpu_supports("avx512vbmi") && __builtin_cpu_supports("avx512vnni") &&
                      __builtin_cpu_supports("avx512bitalg") && __builtin_cpu_supports("avx512vpopcntdq");
  if (sse42) sets.push_back(InstructionSet::sse42);
  if (avx2) sets.push_back(InstructionSet::avx2);
  if (avx512) sets.push_back(InstructionSet::avx512);
#endif
  return sets;
}

InstructionSet from_environment() {
  const auto& available = available_instruction_sets();
  const char* wanted = std::getenv("CAIRN_SIMD");
  if (wanted == nullptr || *wanted == '\0') return available.back();
  const auto found = std::find_if(available.begin(), available.end(),
                                  [&](InstructionSet set) { return name_of(set) == wanted; });
  if (found != available.end()) return *found;
  std::vector<std::string_view> names;
  for (const InstructionSet set : available) names.push_back(name_of(set));
  throw InputError({"CAIRN_SIMD", 0, fmt::format("one of {}", fmt::join(names, ", ")),
                    fmt::format("'{}'", wanted), "Leave it unset for the best that this processor has."});
}

}  // namespace

std::string_view name_of(InstructionSet set) {
  return kNames[static_cast<std::size_t>(set)];
}

const std::vector<InstructionSet>& available_instruction_sets() {
  static const std::vector<InstructionSet> kAvailable = detect();
  return kAvailable;
}

InstructionSet default_instruction_set() {
  static const InstructionSet kDefault = from_environment();
  return kDefault;
}

}  // namespace cairn
