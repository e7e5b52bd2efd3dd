// SPDX-License-Identifier: Apache-2.0
#include "cairn/core/error.h"

#include <fmt/format.h>

namespace cairn {
namespace {

std::string describe(const InputError::Details& d) {
  const std::string place = d.line > 0 ? fmt::format("{}:{}", d.file, d.line) : d.file;
  const std::string remedy = d.remedy.empty() ? "" : "\n  " + d.remedy;
  return fmt::format("{}: expected {}, found {}.{}", place, d.expected, d.found, remedy);
}

}  // namespace

InputError::InputError(Details details)
    : std::runtime_error(describe(details)), details_(std::move(details)) {}

void require(bool condition, std::string_view requirement, const std::source_location& where) {
  if (condition) return;
  throw PreconditionError(fmt::format("{}:{}: {}: requirement broken: {}", where.file_name(), where.line(),
                                      where.function_name(), requirement));
}

}  // namespace cairn
