// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/camera_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/core/text.h"

namespace cairn {
namespace {

[[noreturn]] void fail(const std::string& expected, const std::string& text) {
  throw InputError({"--camera", 0, expected, fmt::format("'{}'", text),
                    "Give pixels, and after them the units of depth in a metre if there is depth."});
}

std::vector<double> numbers_of(const std::string& text) {
  std::vector<double> numbers;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    double& number = numbers.emplace_back();
    if (!parse_number(std::string_view(text).substr(begin, end - begin), number)) return {};
    begin = end + 1;
  }
  return numbers;
}

}  // namespace

std::optional<CameraParameters> parse_camera_numbers(const std::string& text) {
  if (text.find(',') == std::string::npos) return std::nullopt;
  const std::vector<double> numbers = numbers_of(text);
  if (numbers.size() != 4 && numbers.size() != 5)
    fail("4 or 5 numbers, fx,fy,cx,cy or fx,fy,cx,cy,scale", text);
  CameraParameters camera{numbers[0], numbers[1], numbers[2], numbers[3], {}};
  if (numbers.size() == 5) camera.scale = numbers[4];
  if (!(numbers[0] > 0 && numbers[1] > 0)) fail("focal lengths above 0", text);
  if (camera.scale && !(*camera.scale > 0)) fail("a scale above 0", text);
  return camera;
}

bool gives_numbers(const std::string& camera) {
  return camera.find(',') != std::string::npos && !std::filesystem::exists(camera);
}

Calibration read_named_calibration(const std::string& camera) {
  if (const auto known = known_calibration(camera)) return *known;
  if (std::filesystem::exists(camera)) return read_calibration(camera);
  const auto numbers = parse_camera_numbers(camera);
  if (!numbers)
    throw InputError({"--camera", 0, "a camera.yaml, or tum-fr1, tum-fr2, tum-fr3, or fx,fy,cx,cy[,scale]",
                      fmt::format("'{}', no such file", camera), "Check the path."});
  Calibration calibration;
  calibration.camera.fx = *numbers->fx;
  calibration.camera.fy = *numbers->fy;
  calibration.camera.cx = *numbers->cx;
  calibration.camera.cy = *numbers->cy;
  if (numbers->scale) calibration.depth.emplace().scale = *numbers->scale;
  return calibration;
}

}  // namespace cairn
