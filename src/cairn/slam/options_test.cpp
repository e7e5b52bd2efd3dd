// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/options.h"

#include <gtest/gtest.h>

#include "cairn/testing/core/nan_parameters.h"

namespace cairn {
namespace {

TEST(SlamOptions, that_are_not_numbers_are_refused_by_name) {
  EXPECT_GT(testkit::expect_nan_is_refused<SlamOptions>(), 20U);
}

}  // namespace
}  // namespace cairn
