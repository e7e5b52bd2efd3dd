// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/calibration.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "cairn/core/error.h"
#include "cairn/geometry/unit_rotation.h"
#include "cairn/sequence/calibration_formats.h"
#include "cairn/sequence/yaml_mapping.h"

namespace cairn {
namespace {

CameraModel parse_model(const YamlMapping& mapping) {
  const auto name = mapping.has("model") ? mapping.get<std::string>("model", "a camera model") : "pinhole";
  for (const CameraModel model : {CameraModel::pinhole, CameraModel::radtan, CameraModel::kb4}) {
    if (name == to_string(model)) return model;
  }
  mapping.check(false, "model", "pinhole, radtan or kb4");
  return CameraModel::pinhole;
}

void parse_distortion(const YamlMapping& mapping, Camera& camera) {
  if (!mapping.has("distortion")) {
    mapping.check(camera.model == CameraModel::pinhole, "model", "'distortion' beside radtan or kb4");
    return;
  }
  const auto values = mapping.get<std::vector<double>>("distortion", "a list of numbers");
  const std::size_t count = values.size();
  switch (camera.model) {
    case CameraModel::pinhole:
      mapping.check(count == 0, "distortion", "an empty list (a pinhole has none; say model: radtan)");
      break;
    case CameraModel::radtan:
      mapping.check(count == 4 || count == 5, "distortion", "4 or 5 numbers k1 k2 p1 p2 [k3]");
      break;
    case CameraModel::kb4:
      mapping.check(count == 4, "distortion", "4 numbers k1 k2 k3 k4");
      break;
  }
  for (std::size_t i = 0; i < count; ++i) {
    mapping.check(std::isfinite(values[i]), "distortion", "finite numbers");
    camera.distortion[i] = values[i];
  }
}

int parse_side(const YamlMapping& mapping, const std::string& key) {
  constexpr int kMaxSide = 32768;
  const int pixels = mapping.get<int>(key, "a whole number of pixels");
  mapping.check(pixels > 0 && pixels <= kMaxSide, key, "from 1 to 32768 pixels");
  return pixels;
}

Camera parse_camera(const YamlMapping& mapping) {
  Camera camera;
  camera.model = parse_model(mapping);
  camera.width = parse_side(mapping, "width");
  camera.height = parse_side(mapping, "height");
  camera.fx = mapping.positive("fx");
  camera.fy = mapping.positive("fy");
  camera.cx = mapping.number("cx");
  camera.cy = mapping.number("cy");
  parse_distortion(mapping, camera);
  return camera;
}

const std::vector<std::string> kCameraKeys{"model", "width", "height", "fx", "fy", "cx", "cy", "distortion"};

const std::vector<std::string> kTransformKeys{"translation", "quaternion_xyzw"};

Rigid3 parse_transform(const YamlMapping& mapping) {
  const auto t = mapping.get<std::vector<double>>("translation", "three numbers, metres");
  const auto q = mapping.get<std::vector<double>>("quaternion_xyzw", "four numbers");
  mapping.check(t.size() == 3, "translation", "three numbers, metres");
  mapping.check(q.size() == 4, "quaternion_xyzw", "four numbers");
  Rigid3 transform{Eigen::Quaterniond(q[3], q[0], q[1], q[2]), Eigen::Vector3d(t[0], t[1], t[2])};
  mapping.check(transform.translation.allFinite(), "translation", "finite numbers");
  mapping.check(std::abs(transform.rotation.norm() - 1.0) < 0.01, "quaternion_xyzw",
                "a quaternion of length 1");
  transform.rotation = unit_rotation(transform.rotation);
  return transform;
}

DepthCalibration parse_depth(const YamlMapping& mapping) {
  DepthCalibration depth;
  depth.scale = mapping.positive("scale");
  if (mapping.has("invalid")) {
    depth.invalid = {0};
    for (const int value : mapping.get<std::vector<int>>("invalid", "a list of raw depths")) {
      mapping.check(value >= 0 && value <= std::numeric_limits<std::uint16_t>::max(), "invalid",
                    "raw depths from 0 to 65535");
      if (value != 0) depth.invalid.push_back(static_cast<std::uint16_t>(value));
    }
  }
  if (mapping.has("camera")) depth.camera = parse_camera(mapping.sub("camera", kCameraKeys));
  if (mapping.has("camera_from_depth")) {
    depth.camera_from_depth = parse_transform(mapping.sub("camera_from_depth", kTransformKeys));
  }
  return depth;
}

StereoCorrection parse_correction(const YamlMapping& mapping) {
  constexpr double kLargestPx = 1000;
  StereoCorrection correction;
  const auto read = [&](const std::string& key, auto& terms, const std::string& kind) {
    if (!mapping.has(key)) return;
    const std::vector<double> values = mapping.numbers(key, static_cast<std::size_t>(terms.size()), kind);
    for (std::size_t i = 0; i < values.size(); ++i) {
      mapping.check(std::abs(values[i]) <= kLargestPx, key, "terms of at most 1000 pixels");
      terms[static_cast<Eigen::Index>(i)] = values[i];
    }
  };
  read("rows", correction.rows, "six numbers, pixels");
  read("disparity", correction.disparity, "three numbers, pixels");
  return correction;
}

/// The second camera of a rectified pair, by its distance, or of a raw one.
void parse_right(const YamlMapping& mapping, Calibration& calibration) {
  if (mapping.has("correction"))
    calibration.right_correction = parse_correction(mapping.sub("correction", {"rows", "disparity"}));
  if (!mapping.has("camera")) {
    calibration.baseline = mapping.positive("baseline");
    return;
  }
  mapping.check(!mapping.has("baseline"), "baseline", "either 'baseline' or 'camera'; no value");
  mapping.check(!calibration.depth, "camera", "'baseline' instead, as there is 'depth'; nothing");
  mapping.expect("left_from_right", "where the right camera sits");
  const YamlMapping transform = mapping.sub("left_from_right", kTransformKeys);
  set_raw_stereo({calibration.camera, parse_camera(mapping.sub("camera", kCameraKeys)),
                  LeftFromRight(parse_transform(transform))},
                 {transform.file(), transform.line()}, calibration);
}

Rigid3 parse_body(const YamlMapping& mapping) {
  mapping.expect("body_from_camera", "where the camera sits on the body");
  return parse_transform(mapping.sub("body_from_camera", kTransformKeys));
}

YamlMapping open_own(const std::filesystem::path& path) {
  return {path.string(),
          "calibration",
          load_yaml(path),
          {"camera", "right", "depth", "body", "poses_are", "rate_hz"}};
}

/// All but the cameras of the images.
void parse_depth_and_poses(const YamlMapping& mapping, Calibration& calibration) {
  if (mapping.has("depth")) {
    calibration.depth =
        parse_depth(mapping.sub("depth", {"scale", "invalid", "camera", "camera_from_depth"}));
  }
  if (mapping.has("body"))
    calibration.body_from_camera = parse_body(mapping.sub("body", {"body_from_camera"}));
  if (mapping.has("poses_are")) {
    const auto which = mapping.get<std::string>("poses_are", "camera or depth");
    mapping.check(which == "camera" || which == "depth", "poses_are", "camera or depth");
    calibration.poses_are = which == "depth" ? PosesAre::depth : PosesAre::camera;
    mapping.check(which == "camera" || calibration.depth, "poses_are", "camera, as there is no 'depth',");
  }
  if (mapping.has("rate_hz")) {
    calibration.rate_hz = mapping.positive("rate_hz");
    mapping.check(*calibration.rate_hz <= 1e6, "rate_hz", "at most a million frames per second");
  }
}

std::string format_transform(const Rigid3& transform) {
  const auto& t = transform.translation;
  const auto& q = transform.rotation;
  return fmt::format("{{translation: [{}, {}, {}], quaternion_xyzw: [{}, {}, {}, {}]}}", t.x(), t.y(), t.z(),
                     q.x(), q.y(), q.z(), q.w());
}

std::string format_camera(const Camera& c) {
  const std::size_t count = c.model == CameraModel::pinhole ? 0 : c.model == CameraModel::kb4 ? 4 : 5;
  const std::vector<double> distortion(c.distortion.begin(),
                                       c.distortion.begin() + static_cast<std::ptrdiff_t>(count));
  return fmt::format("{{model: {}, width: {}, height: {}, fx: {}, fy: {}, cx: {}, cy: {}, distortion: [{}]}}",
                     to_string(c.model), c.width, c.height, c.fx, c.fy, c.cx, c.cy,
                     fmt::join(distortion, ", "));
}

std::string format_right(const Calibration& calibration) {
  std::string text = "right:\n";
  if (const auto& raw = calibration.raw_stereo)
    text += fmt::format("  camera: {}\n  left_from_right: {}\n", format_camera(raw->pair.right),
                        format_transform(raw->pair.left_from_right));
  else
    text += fmt::format("  baseline: {}\n", *calibration.baseline);
  if (const auto& correction = calibration.right_correction)
    text += fmt::format("  correction:\n    rows: [{}]\n    disparity: [{}]\n",
                        fmt::join(correction->rows, ", "), fmt::join(correction->disparity, ", "));
  return text;
}

Calibration tum_calibration(double fx, double fy, double cx, double cy,
                            const std::array<double, 5>& distortion) {
  Calibration calibration;
  const bool plain = distortion == std::array<double, 5>{};
  calibration.camera = {
      plain ? CameraModel::pinhole : CameraModel::radtan, 640, 480, fx, fy, cx, cy, distortion};
  calibration.depth = DepthCalibration{5000.0, {0}, std::nullopt, {}};
  return calibration;
}

InputError::Details why_no_pair(RectificationStatus status, const LeftFromRight& left_from_right) {
  const Eigen::Vector3d& t = left_from_right.translation;
  const std::string found = fmt::format("the right one at ({:g}, {:g}, {:g}) m", t.x(), t.y(), t.z());
  if (status == RectificationStatus::no_baseline)
    return {"", 0, "two cameras that are apart", found, "Give the right camera's place, in metres."};
  if (status == RectificationStatus::right_is_left) {
    return {"", 0, "the right camera to the right of the left one", found,
            "Swap the cameras, or invert the transform."};
  }
  const double angle_deg = rotation_angle(left_from_right.rotation) * 180.0 / std::numbers::pi;
  return {
      "", 0, "two cameras beside each other that look the same way",
      fmt::format("no view in common: {}, turned by {:.1f} degrees", found, angle_deg),
      "Check rotation and translation: they move points from the right camera's frame to the left one's."};
}

}  // namespace

void set_raw_stereo(const StereoPair& pair, const SourceLocation& place, Calibration& calibration) {
  const StereoRectification rectification = rectify_stereo(pair);
  if (rectification.status != RectificationStatus::ok) {
    InputError::Details why = why_no_pair(rectification.status, pair.left_from_right);
    why.file = place.file;
    why.line = place.line;
    throw InputError(std::move(why));
  }
  calibration.camera = rectification.camera;
  calibration.baseline = rectification.baseline;
  calibration.raw_stereo = RawStereo{pair, rectification};
}

Rigid3 body_from_loaded_camera(const Calibration& calibration, const Rigid3& body_from_camera) {
  if (!calibration.raw_stereo) return body_from_camera;
  const Rigid3 left_from_rectified{calibration.raw_stereo->rectification.rectified_from_left.conjugate(),
                                   Eigen::Vector3d::Zero()};
  return body_from_camera * left_from_rectified;
}

Calibration read_calibration(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) {
    if (const auto file = find_calibration(path)) return read_calibration(*file);
    throw InputError({path.string(), 0, "a calibration, camera.yaml or one of another program",
                      "a folder without", "Name the file (README, \"Calibration\")."});
  }
  if (auto foreign = read_foreign_calibration(path)) return *std::move(foreign);
  const YamlMapping mapping = open_own(path);
  Calibration calibration;
  mapping.expect("camera", "the colour or left camera");
  calibration.camera = parse_camera(mapping.sub("camera", kCameraKeys));
  parse_depth_and_poses(mapping, calibration);
  if (mapping.has("right"))
    parse_right(mapping.sub("right", {"baseline", "camera", "left_from_right", "correction"}), calibration);
  return calibration;
}

std::optional<Calibration> read_calibration_addition(const std::filesystem::path& path) {
  const YAML::Node root = load_yaml(path);
  if (!root.IsMap() || root["camera"] || root["right"] || read_foreign_calibration(path)) return std::nullopt;
  Calibration addition;
  parse_depth_and_poses(open_own(path), addition);
  return addition;
}

void complete_calibration(const Calibration& addition, Calibration& calibration) {
  if (addition.body_from_camera) calibration.body_from_camera = addition.body_from_camera;
  if (addition.rate_hz) calibration.rate_hz = addition.rate_hz;
  if (!addition.depth) return;
  calibration.depth = addition.depth;
  calibration.poses_are = addition.poses_are;
}

std::optional<std::filesystem::path> find_calibration(const std::filesystem::path& folder) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored)) return std::nullopt;
  if (std::filesystem::path own = folder / "camera.yaml"; std::filesystem::exists(own, ignored))
    if (!read_calibration_addition(own)) return own;
  return find_foreign_calibration(folder);
}

std::string format_calibration(const Calibration& calibration) {
  const auto& raw = calibration.raw_stereo;
  std::string text = fmt::format("camera: {}\n", format_camera(raw ? raw->pair.left : calibration.camera));
  if (calibration.baseline) text += format_right(calibration);
  if (calibration.depth) {
    const DepthCalibration& depth = *calibration.depth;
    text +=
        fmt::format("depth:\n  scale: {}\n  invalid: [{}]\n", depth.scale, fmt::join(depth.invalid, ", "));
    if (depth.camera) text += fmt::format("  camera: {}\n", format_camera(*depth.camera));
    if (depth.camera || motion_norm(depth.camera_from_depth) > 0) {
      text += fmt::format("  camera_from_depth: {}\n", format_transform(depth.camera_from_depth));
    }
  }
  if (calibration.body_from_camera)
    text += fmt::format("body:\n  body_from_camera: {}\n", format_transform(*calibration.body_from_camera));
  if (calibration.poses_are == PosesAre::depth) text += "poses_are: depth\n";
  if (calibration.rate_hz) text += fmt::format("rate_hz: {}\n", *calibration.rate_hz);
  return text;
}

std::optional<Calibration> known_calibration(const std::string& name) {
  // Sturm et al. 2012, https://cvg.cit.tum.de/data/datasets/rgbd-dataset/file_formats, "Intrinsic Camera
  // Calibration"
  static const std::map<std::string, Calibration> kKnown{
      {"tum-fr1", tum_calibration(517.3, 516.5, 318.6, 255.3, {0.2624, -0.9531, -0.0054, 0.0026, 1.1633})},
      {"tum-fr2", tum_calibration(520.9, 521.0, 325.1, 249.7, {0.2312, -0.7849, -0.0033, -0.0001, 0.9172})},
      {"tum-fr3", tum_calibration(535.4, 539.2, 320.1, 247.6, {})}};
  const auto found = kKnown.find(name);
  return found == kKnown.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace cairn
