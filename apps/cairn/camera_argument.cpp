// SPDX-License-Identifier: Apache-2.0
#include "camera_argument.h"

#include <fmt/format.h>

#include <algorithm>

#include "cairn/core/error.h"
#include "cairn/core/text.h"

namespace cairn::app {
Option add_camera_option(CommandLine& app, std::string& camera) {
  return app
      .add_option("--camera", camera,
                  "camera.yaml or the calibration of another program (OpenCV, ROS, Kalibr, COLMAP, "
                  "RealSense, Open3D), or tum-fr1, tum-fr2, tum-fr3, or a pinhole camera's numbers")
      .type_name("FILE|NAME|fx,fy,cx,cy[,scale]");
}

std::vector<double> parse_number_list(const std::string& text, std::size_t count, const std::string& option,
                                      const std::string& layout) {
  std::string spaced = text;
  std::replace(spaced.begin(), spaced.end(), ',', ' ');
  std::vector<double> numbers;
  bool all_numbers = true;
  for (std::size_t begin = spaced.find_first_not_of(' '); begin != std::string::npos;) {
    const std::size_t end = std::min(spaced.find(' ', begin), spaced.size());
    double value = 0;
    all_numbers = parse_number(std::string_view(spaced).substr(begin, end - begin), value) && all_numbers;
    numbers.push_back(value);
    begin = spaced.find_first_not_of(' ', end);
  }
  if (!all_numbers || numbers.size() != count) {
    throw InputError({option, 0, fmt::format("{} numbers, {}", count, layout), fmt::format("'{}'", text),
                      "Separate them by commas, without blanks."});
  }
  return numbers;
}

}  // namespace cairn::app
