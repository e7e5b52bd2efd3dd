// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/svg.h"

#include <gtest/gtest.h>

#include <array>

namespace cairn {
namespace {

TEST(SvgCanvas, WritesShapes) {
  SvgCanvas canvas(20, 10);
  canvas.line({0, 1}, {2, 3.25}, {"#ff0000", "none", 2});
  canvas.polyline(std::array{Eigen::Vector2d(1, 2), Eigen::Vector2d(3, 4)}, {"#00ff00", "none", 1});
  canvas.circle({5, 5}, 2, {"none", "#0000ff", 1});
  const std::string svg = canvas.finish();
  EXPECT_TRUE(svg.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"20\" height=\"10\""));
  EXPECT_NE(svg.find("<line x1=\"0.0\" y1=\"1.0\" x2=\"2.0\" y2=\"3.2\" fill=\"none\" stroke=\"#ff0000\""),
            std::string::npos);
  EXPECT_NE(svg.find("<polyline points=\"1.0,2.0 3.0,4.0\""), std::string::npos);
  EXPECT_NE(svg.find("<circle cx=\"5.0\" cy=\"5.0\" r=\"2.0\" fill=\"#0000ff\"/>"), std::string::npos);
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
}

TEST(SvgCanvas, EscapesText) {
  SvgCanvas canvas(20, 10);
  canvas.text({0, 0}, "a<b & \"c\"\x01", {});
  EXPECT_NE(canvas.finish().find(">a&lt;b &amp; &quot;c&quot;</text>"), std::string::npos);
}

}  // namespace
}  // namespace cairn
