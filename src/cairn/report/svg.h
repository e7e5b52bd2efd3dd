// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <string_view>

namespace cairn {

/// How a line or an area looks; colours as CSS writes them ("#334155", "none").
struct SvgStyle {
  std::string stroke = "none";
  std::string fill = "none";
  double stroke_width = 1;  ///< pixels
};

enum class SvgAnchor { start, middle, end };

struct SvgText {
  double size = 13;  ///< pixels
  std::string fill = "#334155";
  SvgAnchor anchor = SvgAnchor::start;
  bool bold = false;
  double turned_deg = 0;  ///< counter-clockwise about its place
};

/// A picture in the making; places are pixels from the upper left corner. Coordinates are written to a tenth
/// of a pixel.
class SvgCanvas {
 public:
  SvgCanvas(double width, double height);

  void line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const SvgStyle& style);
  void polyline(std::span<const Eigen::Vector2d> points, const SvgStyle& style);
  void circle(const Eigen::Vector2d& centre, double radius, const SvgStyle& style);
  void rectangle(const Eigen::Vector2d& corner, const Eigen::Vector2d& size, const SvgStyle& style);
  void text(const Eigen::Vector2d& place, std::string_view text, const SvgText& style);

  /// The whole file.
  [[nodiscard]] std::string finish() const;

 private:
  double width_, height_;
  std::string body_;
};

}  // namespace cairn
