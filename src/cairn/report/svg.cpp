// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/svg.h"

#include <fmt/format.h>

namespace cairn {
namespace {

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else if (c == '>') {
      result += "&gt;";
    } else if (c == '"') {
      result += "&quot;";
    } else if (static_cast<unsigned char>(c) >= 0x20) {  // others are not allowed in XML
      result += c;
    }
  }
  return result;
}

std::string attributes(const SvgStyle& style) {
  std::string text = fmt::format(R"(fill="{}")", style.fill);
  if (style.stroke != "none") {
    text +=
        fmt::format(R"( stroke="{}" stroke-width="{:.2f}" stroke-linecap="round" stroke-linejoin="round")",
                    style.stroke, style.stroke_width);
  }
  return text;
}

std::string_view name_of(SvgAnchor anchor) {
  switch (anchor) {
    case SvgAnchor::middle:
      return "middle";
    case SvgAnchor::end:
      return "end";
    case SvgAnchor::start:
      break;
  }
  return "start";
}

}  // namespace

SvgCanvas::SvgCanvas(double width, double height) : width_(width), height_(height) {}

void SvgCanvas::line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const SvgStyle& style) {
  body_ += fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", from.x(),
                       from.y(), to.x(), to.y(), attributes(style));
}

void SvgCanvas::polyline(std::span<const Eigen::Vector2d> points, const SvgStyle& style) {
  body_ += "<polyline points=\"";
  for (const auto& point : points) body_ += fmt::format("{:.1f},{:.1f} ", point.x(), point.y());
  if (!points.empty()) body_.pop_back();
  body_ += fmt::format("\" {}/>\n", attributes(style));
}

void SvgCanvas::circle(const Eigen::Vector2d& centre, double radius, const SvgStyle& style) {
  body_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" {}/>\n", centre.x(), centre.y(),
                       radius, attributes(style));
}

void SvgCanvas::rectangle(const Eigen::Vector2d& corner, const Eigen::Vector2d& size, const SvgStyle& style) {
  body_ += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" {}/>\n",
                       corner.x(), corner.y(), size.x(), size.y(), attributes(style));
}

void SvgCanvas::text(const Eigen::Vector2d& place, std::string_view text, const SvgText& style) {
  body_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\" fill=\"{}\" text-anchor=\"{}\"",
                       place.x(), place.y(), style.size, style.fill, name_of(style.anchor));
  if (style.bold) body_ += " font-weight=\"600\"";
  if (style.turned_deg != 0) {
    body_ += fmt::format(" transform=\"rotate({} {:.1f} {:.1f})\"", -style.turned_deg, place.x(), place.y());
  }
  body_ += fmt::format(">{}</text>\n", escaped(text));
}

std::string SvgCanvas::finish() const {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"Inter, 'Helvetica Neue', Arial, sans-serif\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n{2}</svg>\n",
      width_, height_, body_);
}

}  // namespace cairn
