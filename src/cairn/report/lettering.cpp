// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/lettering.h"

#include <algorithm>
#include <array>
#include <optional>

#include "cairn/core/error.h"
#include "cairn/report/raster.h"

namespace cairn {
namespace {

/// Strokes of a glyph: corners as two digits, column and row, on a grid where the baseline is row 2, digits
/// end at row 8, small letters at row 6, and descenders at row 0. '|' lifts the pen.
struct Glyph {
  char letter;
  std::string_view strokes;
};

constexpr int kBaseline = 2;
constexpr double kGridHeight = 6;  // of a digit
constexpr double kGap = 2;         // columns between two glyphs
constexpr double kBlank = 2.5;     // columns of a blank

constexpr std::array kGlyphs = {
    Glyph{'0', "12 03 07 18 38 47 43 32 12"},
    Glyph{'1', "06 28 22"},
    Glyph{'2', "07 18 38 47 46 02 42"},
    Glyph{'3', "07 18 38 47 46 35 44 43 32 12 03|15 35"},
    Glyph{'4', "32 38 04 44"},
    Glyph{'5', "48 08 05 15 36 45 43 32 12 03"},
    Glyph{'6', "47 38 18 07 03 12 32 43 44 35 15 04"},
    Glyph{'7', "08 48 12"},
    Glyph{'8', "15 06 07 18 38 47 46 35 15 04 03 12 32 43 44 35"},
    Glyph{'9', "03 12 32 43 47 38 18 07 06 15 35 46"},
    Glyph{'a', "46 42|45 36 16 05 03 12 32 43"},
    Glyph{'b', "08 02|05 16 36 45 43 32 12 03"},
    Glyph{'c', "45 36 16 05 03 12 32 43"},
    Glyph{'d', "48 42|45 36 16 05 03 12 32 43"},
    Glyph{'e', "04 44 45 36 16 05 03 12 32 43"},
    Glyph{'f', "38 28 17 12|06 26"},
    Glyph{'g', "46 41 30 10 01|45 36 16 05 03 12 32 43"},
    Glyph{'h', "08 02|05 16 36 45 42"},
    Glyph{'i', "06 02|08 08"},
    Glyph{'j', "16 11 00|18 18"},
    Glyph{'k', "08 02|36 04 32"},
    Glyph{'l', "08 02"},
    Glyph{'m', "06 02|05 16 26 35 32|35 46 56 65 62"},
    Glyph{'n', "06 02|05 16 36 45 42"},
    Glyph{'o', "12 03 05 16 36 45 43 32 12"},
    Glyph{'p', "06 00|05 16 36 45 43 32 12 03"},
    Glyph{'q', "46 40|45 36 16 05 03 12 32 43"},
    Glyph{'r', "06 02|05 16 36"},
    Glyph{'s', "45 36 16 05 14 34 43 32 12 03"},
    Glyph{'t', "18 13 22 32|06 36"},
    Glyph{'u', "06 03 12 32 43|46 42"},
    Glyph{'v', "06 22 46"},
    Glyph{'w', "06 12 36 52 66"},
    Glyph{'x', "06 42|02 46"},
    Glyph{'y', "06 22|46 10"},
    Glyph{'z', "06 46 02 42"},
    Glyph{'E', "48 08 02 42|05 35"},
    Glyph{'N', "02 08 42 48"},
    Glyph{'.', "02 02"},
    Glyph{',', "12 01"},
    Glyph{':', "03 03|06 06"},
    Glyph{'-', "05 35"},
    Glyph{'<', "37 05 33"},
    Glyph{'>', "07 35 03"},
};

std::string_view strokes_of(char letter) {
  const auto* glyph =
      std::find_if(kGlyphs.begin(), kGlyphs.end(), [&](const Glyph& g) { return g.letter == letter; });
  require(glyph != kGlyphs.end(), "a letter that can be drawn");
  return glyph->strokes;
}

double column(char digit) {
  return static_cast<double>(digit - '0');
}

/// Returns how many columns a glyph covers.
double width_of(std::string_view strokes) {
  double width = 0;
  for (std::size_t i = 0; i + 1 < strokes.size(); i += 3) width = std::max(width, column(strokes[i]));
  return width;
}

void draw_glyph(RgbImage& image, const Eigen::Vector2d& place, std::string_view strokes, double unit,
                const Lettering& lettering) {
  const double width = unit * (lettering.bold ? 1.15 : 0.8);
  std::optional<Eigen::Vector2d> before;
  for (std::size_t i = 0; i + 1 < strokes.size(); i += 3) {
    const Eigen::Vector2d corner =
        place + unit * Eigen::Vector2d(column(strokes[i]), kBaseline - column(strokes[i + 1]));
    if (before) draw_line(image, *before, corner, lettering.color, width);
    const bool lifted = i + 2 < strokes.size() && strokes[i + 2] == '|';
    before = lifted ? std::nullopt : std::optional(corner);
  }
}

}  // namespace

double text_width(std::string_view text, double height_px) {
  double columns = 0;
  for (const char letter : text) columns += letter == ' ' ? kBlank : width_of(strokes_of(letter)) + kGap;
  return std::max(0.0, columns - kGap) * height_px / kGridHeight;
}

void draw_text(RgbImage& image, const Eigen::Vector2d& place, std::string_view text,
               const Lettering& lettering) {
  const double unit = lettering.height_px / kGridHeight;
  const double width = text_width(text, lettering.height_px);
  Eigen::Vector2d pen = place;
  if (lettering.anchor == LetteringAnchor::middle) pen.x() -= 0.5 * width;
  if (lettering.anchor == LetteringAnchor::end) pen.x() -= width;
  for (const char letter : text) {
    if (letter != ' ') draw_glyph(image, pen, strokes_of(letter), unit, lettering);
    pen.x() += unit * (letter == ' ' ? kBlank : width_of(strokes_of(letter)) + kGap);
  }
}

}  // namespace cairn
