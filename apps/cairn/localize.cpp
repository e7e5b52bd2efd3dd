// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/core/stopwatch.h"
#include "cairn/localize/localize_sequence.h"
#include "cairn/map_files/stored_map.h"
#include "cairn/observe/frame_observer.h"
#include "cairn/report/localization_report.h"
#include "commands.h"
#include "common.h"
#include "localize_parameters.h"
#include "localize_pictures.h"
#include "localize_query.h"
#include "map_pictures.h"
#include "parameter_arguments.h"
#include "pose_arguments.h"
#include "recording_checks.h"

namespace cairn::app {
namespace {

constexpr const char* kFollow = "last";  // for --prior: where the image before was found

struct LocalizeArguments {
  CommonOptions common;
  SequenceArguments sequence;
  PoseArguments prior;
  std::string map, output;
  bool mono = false, any_camera = false, draw = false;
};

void declare(CommandLine& app, LocalizeArguments& arguments) {
  app.add_option("MAP", arguments.map, "map folder, or a run with one in its map/").required();
  app.add_option("SEQ", arguments.sequence.folder, "sequence, folder of images or one image").required();
  app.add_option("-o,--output", arguments.output, "run folder; one that cairn wrote is replaced")
      .type_name("RUN")
      .required();
  app.add_option("--prior", arguments.prior.path,
                 "where the images are thought to be: a trajectory in the map's world, or 'last': where the "
                 "image before was found, of a sequence with times")
      .type_name("FILE|last");
  add_pose_time_options(app, arguments.prior);
  app.add_flag("--mono", arguments.mono, "without depth and right images");
  app.add_flag("--any-camera", arguments.any_camera,
               "not needed: the calibration says which camera the images are of");
  app.add_flag("--draw", arguments.draw, "a picture for each image in RUN/pictures");
  add_sequence_options(app, arguments.sequence);
  add_common_options(app, arguments.common, {.config = true, .threads = true, .seed = true});
  add_parameter_help(app,
                     "Example: cairn localize demo/map demo/street -o demo/found\n"
                     "         cairn localize RUN image.png -o found --camera camera.yaml --draw\n",
                     default_rows<LocalizeParameters>);
}

LocalizeParameters gather_parameters(const LocalizeArguments& arguments, const MapInfo& map) {
  LocalizeParameters parameters;
  parameters.sequence = arguments.sequence.options();
  apply_settings(arguments.common, table_of(parameters));
  parameters.localize.seed = arguments.common.seed;
  parameters.validate(map);
  return parameters;
}

int exit_code(const std::vector<LocalizedImage>& images) {
  for (const LocalizedImage& image : images)
    if (image.found.found()) return 0;
  fmt::print(stderr,
             "cairn localize: none of {} images was found in the map.\n  Do they show its place, and is the "
             "calibration theirs?\n",
             images.size());
  return 1;
}

/// Where each image is thought to be, from a file; nothing where none is given.
std::vector<std::optional<WorldFromCamera>> read_priors(const LocalizeArguments& arguments,
                                                        const Sequence& sequence) {
  if (arguments.prior.path.empty() || arguments.prior.path == kFollow) return {};
  return read_reported_poses(sequence, arguments.prior);
}

/// Whether the pose of an image is the prior of the next one: only if they are of one camera on its way.
bool follows(const LocalizeArguments& arguments, const Sequence& sequence, Progress& progress) {
  const bool is_asked = arguments.prior.path == kFollow;
  if (!is_asked || sequence.has_times) return is_asked;
  progress.warn(
      "--prior last is ignored: these images have no times, so each is looked for in the whole map.\n"
      "  If they are a video, state its rate_hz in camera.yaml in their folder.");
  return false;
}

}  // namespace

int run_localize(int argc, char** argv) {
  LocalizeArguments arguments;
  CommandLine app("Finds images in a map: their poses, how sure they are, and whether to trust them.",
                  "localize");
  declare(app, arguments);
  if (const auto code = app.parse(argc, argv)) return *code;

  Stopwatch watch;
  LocalizationSummary summary{arguments.map, arguments.sequence.folder, arguments.output, {}, {}};
  const StoredMap map(arguments.map);
  summary.open_seconds = watch.seconds();
  const LocalizeParameters parameters = gather_parameters(arguments, map.info());
  const Sequence sequence =
      open_query(arguments.sequence.folder, parameters.sequence, map.info(), arguments.mono);
  const QueryCamera camera = query_camera(sequence, map.info());
  print_warnings(sequence.report.warnings);
  const auto progress = make_progress(arguments.common);
  check_recording(sequence, *progress);
  OutputFolder folder(arguments.output, "run");
  const Executor executor(arguments.common.thread_count());
  Executor::Task check = executor.start([&] { map.check(); });  // all of it, beside

  const FrameObserver observer(sequence,
                               observer_options_for(map.info(), parameters.features, parameters.contrast),
                               camera_for_queries(map.info(), sequence.calibration.camera));
  const Localizer localizer(map, camera, parameters.localize);
  const LocalizedSequence found = localize_sequence(
      localizer, sequence, observer,
      {read_priors(arguments, sequence), follows(arguments, sequence, *progress), parameters.localize.trust},
      executor, *progress);
  summary.unreadable = found.unreadable.size();
  check.wait();
  write_found_picture(arguments.map, found.images, folder.work());
  if (arguments.draw) draw_pictures(folder.work() / "pictures", sequence, camera, found.images);

  summary.images = sequence.frames.size();
  summary.stamps = describe_stamps(sequence);
  summary.camera = describe_camera(sequence.calibration.camera, camera);
  summary.stopped = found.images.size() + summary.unreadable < sequence.frames.size();
  summary.threads = executor.threads();
  summary.total_seconds = watch.seconds();
  write_file(folder.work() / "trajectory.txt", format_found_trajectory(found.images, summary));
  write_file(folder.work() / "localization.csv", format_localization_csv(found.images, summary));
  summary.peak_memory_mb = peak_memory_mb();
  const std::string json = format_localization_json(found.images, summary);
  write_file(folder.work() / "run.json", json);
  folder.commit();
  fmt::print("{}", arguments.common.json ? json : format_localization_text(found.images, summary));
  return exit_code(found.images);
}

}  // namespace cairn::app
