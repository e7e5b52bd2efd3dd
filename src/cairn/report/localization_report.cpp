// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/localization_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cairn/core/text.h"
#include "cairn/report/json_pieces.h"
#include "cairn/report/localization_figures.h"
#include "cairn/report/text_builder.h"

namespace cairn {
namespace {

constexpr const char* kTimes = "times";

/// Returns a length in centimetres, from a metre on in metres.
std::string format_cm(double metres) {
  return metres < 0.995 ? fmt::format("{:.2g} cm", 100 * metres) : fmt::format("{:.3g} m", metres);
}

/// Adds what is said of poses, if there are any. Without held-out frames the covariance knows noise alone,
/// and the text says so.
void add_precision(const std::vector<LocalizedImage>& images, TextBuilder& text) {
  const auto inliers = median_inliers(images), std_m = median_std_m(images);
  if (!inliers || !std_m) return;
  text.add("inliers      {:.0f} in the median\n", *inliers);
  const std::string protection = format_cm(median_protection_m(images).value_or(0));
  if (const auto absolute_m = median_absolute_std_m(images)) {
    text.add("position     {} within the map (standard deviation), protection level {};\n", format_cm(*std_m),
             protection);
    text.add("             {} in the world of the poses that made it (medians)\n", format_cm(*absolute_m));
    return;
  }
  text.add("position     {} by noise alone (standard deviation), protection level {} (medians);\n",
           format_cm(*std_m), protection);
  text.add("             errors that the whole map has in common are in neither\n");
}

Json to_json(const LocalizedImage& image) {
  const Localization& found = image.found;
  Json json{{"frame", image.position},
            {"stamp_s", format_stamp(image.stamp_ns)},
            {"file", image.file},
            {"verdict", to_string(found.verdict)},
            {"reason", to_string(found.weakness)}};
  if (!found.found()) return json;
  const WorldFromCamera pose = found.camera_from_world.inverse();
  json["position_m"] = json_of(pose.translation);
  json["quaternion_xyzw"] = json_of(pose.rotation);
  json["inliers"] = found.inliers.size();
  json["gdop_m_per_px"] = found.precision.gdop;
  const auto& protection = found.precision.protection;
  json["protection_m"] = {protection[3], protection[4], protection[5]};
  return json;
}

/// Returns the pixel of a point in the image as it is stored; far away if it is not in the image.
Eigen::Vector2d pixel_of(const Camera& camera, const Eigen::Vector3d& point_in_camera) {
  constexpr double kNowhere = -1e4;
  return camera.project(point_in_camera).value_or(Eigen::Vector2d::Constant(kNowhere));
}

}  // namespace

std::string describe_stamps(const Sequence& sequence) {
  if (sequence.has_times) return kTimes;
  if (sequence.format == "images")
    return "positions of the images in their folder, from 0: they have no times";
  return fmt::format("file numbers / {:g}: the images have no times", sequence.calibration.stamp_rate_hz());
}

std::string describe_camera(const Camera& camera, const QueryCamera& observed) {
  std::string size = fmt::format("{}x{} pixels", camera.width, camera.height);
  if (camera.width == observed.width && camera.height == observed.height) return size;
  return fmt::format("{}, scaled to {}x{}: to the map's pixels per radian", size, observed.width,
                     observed.height);
}

std::string format_found_trajectory(const std::vector<LocalizedImage>& images,
                                    const LocalizationSummary& summary) {
  Trajectory trajectory;
  for (const LocalizedImage& image : images)
    if (image.found.found()) trajectory.push_back({image.stamp_ns, image.found.camera_from_world.inverse()});
  std::string text = format_tum_trajectory(trajectory);
  if (summary.stamps == kTimes) return text;
  return fmt::format("# t: {}; localization.csv has the names of the files\n{}", summary.stamps, text);
}

std::string format_localization_json(const std::vector<LocalizedImage>& images,
                                     const LocalizationSummary& summary) {
  const VerdictCounts counts = count_verdicts(images);
  Json json;
  json["cairn"] = CAIRN_VERSION;
  json["map"] = summary.map;
  json["sequence"] = summary.sequence;
  json["stamps"] = summary.stamps;
  json["camera"] = summary.camera;
  json["images"] = {{"total", summary.images},
                    {"good", counts.good},
                    {"weak", counts.weak},
                    {"none", counts.none},
                    {"unreadable", summary.unreadable}};
  json["weak_because"] = Json::object();
  for (const auto& [reason, number] : counts.reasons) json["weak_because"][std::string(reason)] = number;
  json["stopped"] = summary.stopped;
  json["median_inliers"] = json_of(median_inliers(images));
  json["median_std_m"] = json_of(median_std_m(images));
  json["median_absolute_std_m"] = json_of(median_absolute_std_m(images));
  json["median_protection_m"] = json_of(median_protection_m(images));
  json["threads"] = summary.threads;
  json["seconds"] = {{"open", summary.open_seconds}, {"total", summary.total_seconds}};
  json["median_ms"] = {{"features", median_ms(images, &LocalizedImage::feature_seconds)},
                       {"localize", median_ms(images, &LocalizedImage::localize_seconds)}};
  json["peak_memory_mb"] = summary.peak_memory_mb;
  json["results"] = Json::array();
  for (const LocalizedImage& image : images) json["results"].push_back(to_json(image));
  return format_document(json);
}

std::string format_localization_text(const std::vector<LocalizedImage>& images,
                                     const LocalizationSummary& summary) {
  const VerdictCounts counts = count_verdicts(images);
  TextBuilder text;
  text.add("images       {}: {} good, {} weak, {} not found\n", images.size(), counts.good, counts.weak,
           counts.none);
  text.add("camera       {}\n", summary.camera);
  if (summary.stamps != kTimes) text.add("stamps       {}\n", summary.stamps);
  for (const auto& [reason, number] : counts.reasons) text.add("  weak       {}: {}\n", reason, number);
  if (summary.unreadable > 0) text.add("unreadable   {} images, skipped\n", summary.unreadable);
  if (summary.stopped) text.add("stopped      after {} of {} images\n", images.size(), summary.images);
  add_precision(images, text);
  text.add("time         map opened in {:.3f} s; {:.1f} ms features and {:.1f} ms localisation an image\n",
           summary.open_seconds, median_ms(images, &LocalizedImage::feature_seconds),
           median_ms(images, &LocalizedImage::localize_seconds));
  text.add("memory       {:.0f} MB at most\n", summary.peak_memory_mb);
  text.add("picture      {}/{}, the poses in the map from above\n", summary.output, kLandmarkPicture);
  text.add("written to   {}\n", summary.output);
  return text.take();
}

std::vector<FoundPose> found_poses(const std::vector<LocalizedImage>& images) {
  std::vector<FoundPose> found;
  for (const LocalizedImage& image : images)
    if (image.found.found())
      found.push_back({image.found.camera_from_world.inverse(), image.found.verdict == Verdict::good});
  return found;
}

std::vector<DrawnMatch> drawn_matches(const Localization& found, const Camera& camera, const Rig& rig) {
  std::vector<DrawnMatch> matches;
  for (std::size_t i = 0; i < found.matches.size(); ++i) {
    const LandmarkMatch& match = found.matches[i];
    const Eigen::Vector2d seen = pixel_of(camera, rig.point_at(match.seen.u, match.seen.v, 1.0));
    const bool inlier =
        std::binary_search(found.inliers.begin(), found.inliers.end(), static_cast<std::int32_t>(i));
    const Eigen::Vector2d projected =
        found.found() ? pixel_of(camera, found.camera_from_world * match.point_in_world) : seen;
    matches.push_back({seen, projected, inlier});
  }
  return matches;
}

}  // namespace cairn
