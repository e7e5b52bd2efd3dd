// SPDX-License-Identifier: Apache-2.0
#include "cairn/core/parameter.h"

#include <fmt/format.h>

#include <cmath>

#include "cairn/core/error.h"

namespace cairn {
namespace {

void check(const Parameter& parameter, double value) {
  if (parameter.range.contains(value)) return;
  throw InputError(
      {parameter.name, 0, parameter.range.describe(), fmt::format("{}", value), parameter.remedy});
}

}  // namespace

bool Range::contains(double value) const {
  return std::isfinite(value) && (excludes_minimum ? value > minimum : value >= minimum) && value <= maximum;
}

std::string Range::describe() const {
  if (std::isinf(minimum)) return unit;
  if (counts_from_minimum) return fmt::format("at least {} {}", minimum, unit);
  std::string text = fmt::format("{} {} {}", unit, excludes_minimum ? "above" : "from", minimum);
  if (*minimum_means != '\0') text += fmt::format(" ({})", minimum_means);
  if (std::isinf(maximum)) return text;
  return fmt::format("{}{} {}", text, excludes_minimum ? ", up to" : " to", maximum);
}

Range any(const char* unit) {
  return {.unit = unit};
}

Range above(double minimum, const char* unit) {
  return {.minimum = minimum, .unit = unit, .excludes_minimum = true};
}

Range above_up_to(double minimum, double maximum, const char* unit) {
  return {.minimum = minimum, .maximum = maximum, .unit = unit, .excludes_minimum = true};
}

Range from(double minimum, const char* unit, const char* minimum_means) {
  return {.minimum = minimum, .unit = unit, .minimum_means = minimum_means};
}

Range from_to(double minimum, double maximum, const char* unit, const char* minimum_means) {
  return {.minimum = minimum, .maximum = maximum, .unit = unit, .minimum_means = minimum_means};
}

Range at_least(double minimum, const char* unit) {
  return {.minimum = minimum, .unit = unit, .counts_from_minimum = true};
}

void RangeCheck::parameter(const Parameter& parameter, double& value) {
  check(parameter, value);
}

void RangeCheck::parameter(const Parameter& parameter, int& value) {
  check(parameter, value);
}

void RangeCheck::parameter(const Parameter&, bool&) {}

void RangeCheck::parameter(const Parameter&, std::string&) {}

void RangeCheck::parameter(const Parameter& parameter, std::optional<double>& value) {
  if (value) check(parameter, *value);
}

void RangeCheck::parameter(const Parameter& parameter, std::optional<std::int64_t>& value) {
  if (value) check(parameter, static_cast<double>(*value));
}

void check_parameter(bool holds, const char* name, const char* expected, double found) {
  if (!holds)
    throw InputError({name, 0, expected, fmt::format("{}", found), "Leave it out for the default."});
}

}  // namespace cairn
