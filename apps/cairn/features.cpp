// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/image/codec.h"
#include "cairn/report/feature_picture.h"
#include "cairn/report/features_report.h"
#include "cairn/sequence/skipped_frames.h"
#include "commands.h"
#include "feature_arguments.h"

namespace cairn::app {
namespace {

struct FeaturesArguments : FeatureArguments {
  std::vector<std::string> images;
  std::string draw, output;
};

void declare(CommandLine& app, FeaturesArguments& arguments) {
  app.add_option("IMG", arguments.images, "images: PNG, JPEG, binary PGM or PPM").required();
  add_feature_options(app, arguments);
  add_repeat_option(app, arguments);
  app.add_option("--draw", arguments.draw, "picture of one image's keypoints with their scale and angle")
      .type_name("OUT.png");
  app.add_option("--output", arguments.output, "one image's keypoints: u v size angle_deg response")
      .type_name("OUT.csv");
  add_common_options(app, arguments.common, {.threads = true});
  app.footer("Example: cairn features left.png --method sift --count 2000 --draw keypoints.png");
}

void check(const FeaturesArguments& arguments) {
  if (arguments.images.size() == 1) return;
  for (const auto& [option, path] : {std::pair{"--draw", arguments.draw}, {"--output", arguments.output}}) {
    if (path.empty()) continue;
    throw InputError({option, 0, "one image", fmt::format("{} images", arguments.images.size()),
                      "Run the command once for each image that needs it."});
  }
}

void write_outputs(const TimedFeatures& timed, const std::string& picture, std::optional<AtomicFile>& list) {
  if (!picture.empty()) write_png(picture, draw_keypoints(timed.image, timed.features.keypoints));
  if (list) list->write(format_keypoints_csv(timed.features.keypoints));
}

}  // namespace

int run_features(int argc, char** argv) {
  FeaturesArguments arguments;
  CommandLine app("Finds and describes features of images, and says how many and how fast.", "features");
  declare(app, arguments);
  if (const auto code = app.parse(argc, argv)) return *code;
  check(arguments);
  std::optional<AtomicFile> output;  // before the work: a path that cannot be written is known at once
  if (!arguments.output.empty()) output.emplace(arguments.output);

  const auto extractor = arguments.extractor();
  const Executor executor(arguments.common.thread_count());
  const auto progress = make_progress(arguments.common);
  progress->start("features", static_cast<std::int64_t>(arguments.images.size()), "images");
  SkippedFrames skipped(*progress, "image");
  std::vector<FeatureCounts> counts;  // printed after all warnings
  for (std::size_t i = 0; i < arguments.images.size(); ++i) {
    if (progress->stop_requested()) return 1;
    try {
      const TimedFeatures timed = extract_timed(arguments.images[i], arguments, *extractor, executor);
      skipped.take();
      counts.push_back(counts_of(timed));
      if (arguments.images.size() == 1) write_outputs(timed, arguments.draw, output);
    } catch (const InputError&) {
      if (arguments.images.size() == 1) throw;
      skipped.skip(std::current_exception());
    }
    progress->update(static_cast<std::int64_t>(i + 1));
  }
  progress->finish();
  skipped.finish();
  if (output) output->commit();
  fmt::print("{}", arguments.common.json ? format_features_json(arguments.method, counts, skipped.count())
                                         : format_features_text(counts, skipped.count()));
  return 0;
}

}  // namespace cairn::app
