// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

#include "cairn/core/file.h"
#include "cairn/image/codec.h"
#include "cairn/matching/matching.h"
#include "cairn/report/feature_picture.h"
#include "cairn/report/features_report.h"
#include "commands.h"
#include "feature_arguments.h"

namespace cairn::app {
namespace {

struct MatchArguments : FeatureArguments {
  std::string first, second, output, draw;
  MatchOptions options;
  bool one_sided = false;
};

void declare(CommandLine& app, MatchArguments& arguments) {
  app.add_option("A", arguments.first, "image: PNG, JPEG, binary PGM or PPM").required();
  app.add_option("B", arguments.second, "image to find A's features in").required();
  add_feature_options(app, arguments);
  add_repeat_option(app, arguments);
  app.add_option(
         "--ratio", arguments.options.max_ratio,
         "believe a match only if it is nearer than this share of the second nearest; 0: no such test")
      .check(number_in(0, 1))
      .type_name("X")
      .show_default();
  app.add_option("--max-distance", arguments.options.max_distance,
                 "bits (ORB) or Euclidean distance of bytes (SIFT) that a match may have (default: any)")
      .check(number_in(0, 1e6))
      .type_name("D");
  app.add_flag("--one-sided", arguments.one_sided, "A's feature need not be the nearest to B's");
  app.add_option("--output", arguments.output, "the matches: u1 v1 u2 v2 distance").type_name("OUT.csv");
  app.add_option("--draw", arguments.draw, "picture of both images with a line for each match")
      .type_name("OUT.png");
  add_common_options(app, arguments.common, {.threads = true, .quiet = false});
  app.footer("Example: cairn match a.png b.png --method sift --ratio 0.8 --draw matches.png");
}

}  // namespace

int run_match(int argc, char** argv) {
  MatchArguments arguments;
  CommandLine app("Finds the features of one image in another.", "match");
  declare(app, arguments);
  if (const auto code = app.parse(argc, argv)) return *code;
  arguments.options.mutual = !arguments.one_sided;
  std::optional<AtomicFile> output;  // before the work: a path that cannot be written is known at once
  if (!arguments.output.empty()) output.emplace(arguments.output);

  const auto extractor = arguments.extractor();
  const Executor executor(arguments.common.thread_count());
  const TimedFeatures a = extract_timed(arguments.first, arguments, *extractor, executor);
  const TimedFeatures b = extract_timed(arguments.second, arguments, *extractor, executor);
  std::vector<Match> matches;
  const double time_ms = median_ms(arguments.repeat, [&] {
    matches = match_descriptors(a.features.descriptors, b.features.descriptors, arguments.options, executor);
  });
  if (!arguments.draw.empty())
    write_png(arguments.draw,
              draw_matches(a.image, a.features.keypoints, b.image, b.features.keypoints, matches));
  const MatchReport report{arguments.method, a, b, matches, time_ms};
  if (output) {
    output->write(format_matches_csv(report));
    output->commit();
  }
  fmt::print("{}", arguments.common.json ? format_match_json(report) : format_match_text(report));
  return 0;
}

}  // namespace cairn::app
