// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "cairn/core/executor.h"
#include "cairn/features/extractor.h"
#include "cairn/report/features_report.h"
#include "common.h"

namespace cairn::app {

/// What the commands that extract features of single images have in common.
struct FeatureArguments {
  CommonOptions common;
  std::string method = "ORB";
  int count = FeatureOptions{}.count;
  int repeat = 1;

  [[nodiscard]] std::unique_ptr<Extractor> extractor() const;
};

void add_feature_options(CommandLine& app, FeatureArguments& arguments);
/// For the commands that print times.
void add_repeat_option(CommandLine& app, FeatureArguments& arguments);

/// Reads an image and extracts its features; the time is the median of the repetitions. InputError for an
/// image that cannot be read.
[[nodiscard]] TimedFeatures extract_timed(const std::string& path, const FeatureArguments& arguments,
                                          const Extractor& extractor, const Executor& executor);

/// Milliseconds that `work` takes: the median of `repeat` calls, at least one.
[[nodiscard]] double median_ms(int repeat, const std::function<void()>& work);

}  // namespace cairn::app
