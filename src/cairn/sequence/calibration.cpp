// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/calibration.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/core/text.h"

namespace cairn {
namespace {

/// Reads one YAML mapping with the rules of all our configuration: unknown keys are errors, every error has a
/// line.
class Mapping {
 public:
  Mapping(std::string file, std::string name, const YAML::Node& node, const std::vector<std::string>& known)
      : file_(std::move(file)), name_(std::move(name)), node_(node) {
    if (!node_.IsMap())
      fail(node_, fmt::format("a mapping for '{}'", name_), describe(node_),
           "See the README, \"Calibration\".");
    std::set<std::string> seen;
    for (const auto& item : node_) {
      const std::string key = item.first.IsScalar() ? item.first.Scalar() : "a list or mapping";
      if (std::find(known.begin(), known.end(), key) == known.end()) {
        fail(item.first, fmt::format("a known key in '{}'", name_), fmt::format("'{}'", key),
             fmt::format("Did you mean '{}'?", nearest_name(key, known)));
      }
      if (!seen.insert(key).second)
        fail(item.first, fmt::format("one '{}' in '{}'", key, name_), "two", "Delete one.");
    }
  }

  [[nodiscard]] bool has(const std::string& key) const { return static_cast<bool>(node_[key]); }

  template <class T>
  [[nodiscard]] T get(const std::string& key, const std::string& kind) const {
    const YAML::Node value = node_[key];
    if (!value)
      fail(node_, fmt::format("'{}' in '{}' ({})", key, name_, kind), "none", fmt::format("Add '{}'.", key));
    try {
      return value.as<T>();
    } catch (const YAML::Exception&) {
      fail(value, fmt::format("{} for '{}'", kind, key), describe(value), "Mend the value.");
    }
  }

  [[nodiscard]] double number(const std::string& key) const {
    const auto value = get<double>(key, "a number");
    check(std::isfinite(value), key, "a finite number");
    return value;
  }
  [[nodiscard]] double positive(const std::string& key) const {
    const double value = number(key);
    check(value > 0, key, "a number above 0");
    return value;
  }
  [[nodiscard]] Mapping sub(const std::string& key, const std::vector<std::string>& known) const {
    return {file_, key, node_[key], known};
  }

  void check(bool holds, const std::string& key, const std::string& expected) const {
    const YAML::Node value = node_[key];
    if (!holds) fail(value, fmt::format("{} for '{}'", expected, key), describe(value), "Mend the value.");
  }

 private:
  static std::string describe(const YAML::Node& value) {
    if (value.IsScalar()) return fmt::format("'{}'", value.Scalar());
    if (value.IsSequence()) return fmt::format("a list of {}", value.size());
    return value.IsMap() ? "a mapping" : "nothing";
  }

  [[noreturn]] void fail(const YAML::Node& at, std::string expected, std::string found,
                         std::string remedy) const {
    throw InputError({file_, at.Mark().line + 1, std::move(expected), std::move(found), std::move(remedy)});
  }

  std::string file_, name_;
  YAML::Node node_;
};

CameraModel parse_model(const Mapping& mapping) {
  const auto name = mapping.has("model") ? mapping.get<std::string>("model", "a camera model") : "pinhole";
  for (const CameraModel model : {CameraModel::pinhole, CameraModel::radtan, CameraModel::kb4}) {
    if (name == to_string(model)) return model;
  }
  mapping.check(false, "model", "pinhole, radtan or kb4");
  return CameraModel::pinhole;
}

void parse_distortion(const Mapping& mapping, Camera& camera) {
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

int parse_side(const Mapping& mapping, const std::string& key) {
  constexpr int kMaxSide = 32768;
  const int pixels = mapping.get<int>(key, "a whole number of pixels");
  mapping.check(pixels > 0 && pixels <= kMaxSide, key, "from 1 to 32768 pixels");
  return pixels;
}

Camera parse_camera(const Mapping& mapping) {
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

Rigid3 parse_transform(const Mapping& mapping) {
  const auto t = mapping.get<std::vector<double>>("translation", "three numbers, metres");
  const auto q = mapping.get<std::vector<double>>("quaternion_xyzw", "four numbers");
  mapping.check(t.size() == 3, "translation", "three numbers, metres");
  mapping.check(q.size() == 4, "quaternion_xyzw", "four numbers");
  Rigid3 transform{Eigen::Quaterniond(q[3], q[0], q[1], q[2]), Eigen::Vector3d(t[0], t[1], t[2])};
  mapping.check(transform.translation.allFinite(), "translation", "finite numbers");
  mapping.check(std::abs(transform.rotation.norm() - 1.0) < 0.01, "quaternion_xyzw",
                "a quaternion of length 1");
  transform.rotation.normalize();
  return transform;
}

DepthCalibration parse_depth(const Mapping& mapping) {
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
    depth.camera_from_depth =
        parse_transform(mapping.sub("camera_from_depth", {"translation", "quaternion_xyzw"}));
  }
  return depth;
}

std::string format_camera(const Camera& c) {
  const std::size_t count = c.model == CameraModel::pinhole ? 0 : c.model == CameraModel::kb4 ? 4 : 5;
  const std::vector<double> distortion(c.distortion.begin(),
                                       c.distortion.begin() + static_cast<std::ptrdiff_t>(count));
  return fmt::format("{{model: {}, width: {}, height: {}, fx: {}, fy: {}, cx: {}, cy: {}, distortion: [{}]}}",
                     to_string(c.model), c.width, c.height, c.fx, c.fy, c.cx, c.cy,
                     fmt::join(distortion, ", "));
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

}  // namespace

Calibration read_calibration(const std::filesystem::path& path) {
  YAML::Node root;
  try {
    root = YAML::Load(read_file(path));
  } catch (const YAML::Exception& error) {
    throw InputError({path.string(), error.mark.line + 1, "YAML", error.msg, "Mend the line."});
  }
  if (root.IsNull())
    throw InputError(
        {path.string(), 0, "a calibration", "an empty file", "See the README, \"Calibration\"."});
  const Mapping mapping(path.string(), "calibration", root,
                        {"camera", "right", "depth", "poses_are", "rate_hz"});
  Calibration calibration;
  if (!mapping.has("camera")) (void)mapping.get<std::string>("camera", "the colour or left camera");
  calibration.camera = parse_camera(mapping.sub("camera", kCameraKeys));
  if (mapping.has("right")) calibration.baseline = mapping.sub("right", {"baseline"}).positive("baseline");
  if (mapping.has("depth")) {
    calibration.depth =
        parse_depth(mapping.sub("depth", {"scale", "invalid", "camera", "camera_from_depth"}));
  }
  if (mapping.has("poses_are")) {
    const auto which = mapping.get<std::string>("poses_are", "camera or depth");
    mapping.check(which == "camera" || which == "depth", "poses_are", "camera or depth");
    calibration.poses_are = which == "depth" ? PosesAre::depth : PosesAre::camera;
    mapping.check(which == "camera" || calibration.depth, "poses_are", "camera, as there is no 'depth',");
  }
  if (mapping.has("rate_hz")) {
    calibration.rate_hz = mapping.positive("rate_hz");
    mapping.check(calibration.rate_hz <= 1e6, "rate_hz", "at most a million frames per second");
  }
  return calibration;
}

std::string format_calibration(const Calibration& calibration) {
  std::string text = fmt::format("camera: {}\n", format_camera(calibration.camera));
  if (calibration.baseline) text += fmt::format("right: {{baseline: {}}}\n", *calibration.baseline);
  if (calibration.depth) {
    const DepthCalibration& depth = *calibration.depth;
    text +=
        fmt::format("depth:\n  scale: {}\n  invalid: [{}]\n", depth.scale, fmt::join(depth.invalid, ", "));
    if (depth.camera) text += fmt::format("  camera: {}\n", format_camera(*depth.camera));
    if (depth.camera || motion_norm(depth.camera_from_depth) > 0) {
      const auto& t = depth.camera_from_depth.translation;
      const auto& q = depth.camera_from_depth.rotation;
      text += fmt::format(
          "  camera_from_depth: {{translation: [{}, {}, {}], quaternion_xyzw: [{}, {}, {}, {}]}}\n", t.x(),
          t.y(), t.z(), q.x(), q.y(), q.z(), q.w());
    }
  }
  if (calibration.poses_are == PosesAre::depth) text += "poses_are: depth\n";
  return text + fmt::format("rate_hz: {}\n", calibration.rate_hz);
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
