// SPDX-License-Identifier: Apache-2.0
#include "feature_arguments.h"

#include <utility>

#include "cairn/core/median.h"
#include "cairn/core/stopwatch.h"
#include "cairn/core/text.h"
#include "cairn/image/codec.h"

namespace cairn::app {

std::unique_ptr<Extractor> FeatureArguments::extractor() const {
  const bool root = lower_case(method) == "rootsift";
  return make_extractor({root ? "SIFT" : method, method, count});
}

void add_feature_options(CommandLine& app, FeatureArguments& arguments) {
  app.add_option("--method", arguments.method, "ORB, SIFT and ROOTSIFT are cairn's own, the others OpenCV's")
      .check(one_of_any_case(descriptor_names()))
      .type_name("NAME")
      .show_default();
  app.add_option("--count", arguments.count, "at most so many features of an image")
      .check(number_in(1, 10'000'000))
      .type_name("N")
      .show_default();
}

void add_repeat_option(CommandLine& app, FeatureArguments& arguments) {
  app.add_option("--repeat", arguments.repeat,
                 "the time is the median of so many runs, decoding not included")
      .check(number_in(1, 1'000'000))
      .type_name("R")
      .show_default();
}

TimedFeatures extract_timed(const std::string& path, const FeatureArguments& arguments,
                            const Extractor& extractor, const Executor& executor) {
  TimedFeatures timed{path, read_gray(path), {}, 0};
  timed.time_ms =
      median_ms(arguments.repeat, [&] { timed.features = extractor.extract(timed.image, executor); });
  return timed;
}

double median_ms(int repeat, const std::function<void()>& work) {
  std::vector<double> times_ms;
  for (int i = 0; i < repeat; ++i) {
    const Stopwatch watch;
    work();
    times_ms.push_back(1e3 * watch.seconds());
  }
  return median(std::move(times_ms));
}

}  // namespace cairn::app
