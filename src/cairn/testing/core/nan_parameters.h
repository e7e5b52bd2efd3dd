// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/core/parameter.h"

namespace cairn::testkit {

/// Sets one parameter to not-a-number: the one with this index among those that hold a double.
class NanSetter : public ParameterVisitor {
 public:
  explicit NanSetter(std::size_t index) : index_(index) {}
  void parameter(const Parameter& parameter, double& value) override {
    names.emplace_back(parameter.name);
    if (names.size() == index_ + 1) value = std::numeric_limits<double>::quiet_NaN();
  }
  void parameter(const Parameter& parameter, std::optional<double>& value) override {
    double number = value.value_or(0);
    this->parameter(parameter, number);
    if (std::isnan(number)) value = number;
  }
  void parameter(const Parameter&, int&) override {}
  void parameter(const Parameter&, bool&) override {}
  void parameter(const Parameter&, std::string&) override {}
  void parameter(const Parameter&, std::optional<std::int64_t>&) override {}

  std::vector<std::string> names;  ///< of the parameters that hold a double, in their order

 private:
  std::size_t index_;
};

/// Expects that validate() names each parameter that is not a number, and accepts the defaults. Returns how
/// many were tried.
template <class Options>
std::size_t expect_nan_is_refused() {
  EXPECT_NO_THROW(Options().validate());
  std::size_t count = 1;
  for (std::size_t i = 0; i < count; ++i) {
    Options options;
    NanSetter setter(i);
    visit(options, setter);
    count = setter.names.size();
    try {
      options.validate();
      ADD_FAILURE() << setter.names[i] << " was accepted";
    } catch (const InputError& error) {
      EXPECT_EQ(error.details().file, setter.names[i]);
      EXPECT_EQ(error.details().found, "nan");
    }
  }
  return count;
}

}  // namespace cairn::testkit
