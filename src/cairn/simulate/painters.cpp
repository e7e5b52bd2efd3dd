// SPDX-License-Identifier: Apache-2.0
#include "cairn/simulate/painters.h"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

using Eigen::Vector2d;

Shape rectangle(const Vector2d& low, const Vector2d& high, const Color& color, float opacity = 1) {
  return {(low + high) / 2, (high - low) / 2, 0, false, color, opacity};
}

/// A frame with a mount and many shapes inside; shapes whose centres are inside may reach over the frame, as
/// if pinned to it.
void draw_picture(Canvas& canvas, const Vector2d& low, const Vector2d& high, Random& random) {
  constexpr double kFrame = 0.025, kMount = 0.05;
  const Vector2d one(1, 1);
  canvas.draw(rectangle(low, high, random_color(random, 0.5F, 20, 120)));
  canvas.draw(rectangle(low + kFrame * one, high - kFrame * one, Color(235, 232, 222)));
  const Vector2d inner_low = low + kMount * one, inner_high = high - kMount * one;
  canvas.draw(rectangle(inner_low, inner_high, random_color(random, 0.7F, 90, 230)));
  canvas.scatter({220, 0.006, 0.09, 0.95F, 0.9F}, inner_low + 0.02 * one, inner_high - 0.02 * one, random);
}

void draw_lines(Canvas& canvas, double spacing_x, double spacing_y, double width, const Color& color,
                float opacity) {
  for (double x = spacing_x; spacing_x > 0 && x < canvas.width(); x += spacing_x)
    canvas.draw(rectangle({x - width / 2, 0}, {x + width / 2, canvas.height()}, color, opacity));
  for (double y = spacing_y; spacing_y > 0 && y < canvas.height(); y += spacing_y)
    canvas.draw(rectangle({0, y - width / 2}, {canvas.width(), y + width / 2}, color, opacity));
}

/// One row of books standing on the board at `bottom`.
void draw_books(Canvas& canvas, double bottom, double height, Random& random) {
  for (double x = 0.03; x < canvas.width() - 0.06;) {
    const double width = random.uniform(0.018, 0.055), tall = height * random.uniform(0.65, 0.95);
    const Color color = random_color(random, 0.8F, 50, 230);
    canvas.draw(rectangle({x, bottom - tall}, {x + width, bottom}, color));
    const double label = bottom - tall * random.uniform(0.5, 0.9), high = tall * random.uniform(0.05, 0.2);
    canvas.draw(rectangle({x + 0.1 * width, label}, {x + 0.9 * width, label + high},
                          random_color(random, 0.5F, 60, 250), 0.9F));
    x += width + (random.index(9) == 0 ? random.uniform(0.02, 0.1) : 0.002);
  }
}

}  // namespace

Painter wallpaper(const Color& color, int pictures) {
  return [=](Canvas& canvas, Random& random) {
    canvas.fill(color);
    canvas.add_noise({0.8, 8, 0.8, 13, 6}, random.next());
    canvas.scatter({45, 0.006, 0.07, 0.55F, 0.5F}, random);
    for (int i = 0; i < pictures; ++i) {
      const double height = random.uniform(0.35, 0.8), width = random.uniform(0.35, 0.9);
      const Vector2d size(width, height);
      const double slot = canvas.width() / pictures;  // so that pictures do not hide each other
      const double x = std::max(0.05, i * slot + (slot - size.x()) * random.uniform(0.2, 0.8));
      const double y = random.uniform(0.35, 0.8);
      const Vector2d low(x, y);
      draw_picture(canvas, low, low + size, random);
    }
    canvas.draw(rectangle({0, canvas.height() - 0.08}, {canvas.width(), canvas.height()}, {225, 222, 214}));
    canvas.shade_borders(0.22, 0.25);
  };
}

Painter floor_boards(const Vector2d& rug) {
  return [=](Canvas& canvas, Random& random) {
    constexpr double kBoard = 0.14;
    for (double y = 0; y < canvas.height(); y += kBoard) {
      for (double x = -random.uniform(0, 1.2); x < canvas.width();) {
        const double length = random.uniform(0.7, 1.6);
        const auto tone = static_cast<float>(random.uniform(0.75, 1.1));
        canvas.draw(rectangle({x, y}, {x + length - 0.004, y + kBoard - 0.004}, tone * Color(165, 118, 78)));
        x += length;
      }
    }
    canvas.add_noise({0.5, 7, 0.85, 12, 3}, random.next());
    canvas.scatter({35, 0.006, 0.04, 0.6F, 0.3F}, random);
    const Vector2d middle(canvas.width() / 2, canvas.height() / 2);
    if (rug.minCoeff() > 0) {
      const Vector2d low = middle - rug / 2, high = middle + rug / 2, border(0.06, 0.06);
      canvas.draw(rectangle(low, high, {110, 38, 42}));
      canvas.draw(rectangle(low + border, high - border, {196, 172, 132}));
      canvas.scatter({90, 0.01, 0.12, 0.9F, 0.8F}, low + 2 * border, high - 2 * border, random);
    }
    canvas.shade_borders(0.3, 0.3);
  };
}

Painter ceiling_tiles() {
  return [](Canvas& canvas, Random& random) {
    canvas.fill({226, 224, 216});
    canvas.add_noise({0.6, 7, 0.8, 9, 3}, random.next());
    canvas.scatter({60, 0.004, 0.025, 0.6F, 0.2F}, random);
    draw_lines(canvas, 0.6, 0.6, 0.012, {120, 120, 118}, 0.8F);
    canvas.shade_borders(0.25, 0.3);
  };
}

Painter wood(const Color& color) {
  return [=](Canvas& canvas, Random& random) {
    canvas.fill(color);
    canvas.add_noise({0.25, 6, 0.85, 15, 5}, random.next());
    canvas.scatter({110, 0.004, 0.04, 0.7F, 0.4F}, random);
    canvas.shade_borders(0.25, 0.02);
  };
}

Painter book_shelf() {
  return [](Canvas& canvas, Random& random) {
    constexpr double kShelf = 0.32, kBoard = 0.025;
    canvas.fill({58, 40, 28});
    for (double bottom = kShelf; bottom < canvas.height() + kShelf; bottom += kShelf) {
      draw_books(canvas, bottom - kBoard, kShelf - kBoard, random);
      canvas.draw(rectangle({0, bottom - kBoard}, {canvas.width(), bottom}, {150, 110, 72}));
    }
    draw_lines(canvas, canvas.width() - 0.012, 0, 0.024, {150, 110, 72}, 1);
    canvas.add_noise({0.2, 5, 0.9, 9, 3}, random.next());
  };
}

Painter fabric(const Color& color) {
  return [=](Canvas& canvas, Random& random) {
    canvas.fill(color);
    canvas.add_noise({0.2, 6, 0.9, 14, 7}, random.next());
    canvas.scatter({110, 0.008, 0.06, 0.75F, 0.7F}, random);
    canvas.shade_borders(0.35, 0.04);
  };
}

Painter carton() {
  return [](Canvas& canvas, Random& random) {
    canvas.fill(Color(178, 138, 92) * static_cast<float>(random.uniform(0.85, 1.1)));
    canvas.add_noise({0.3, 7, 0.8, 10, 3}, random.next());
    const double tape = canvas.height() * random.uniform(0.35, 0.65);
    canvas.draw(rectangle({0, tape - 0.025}, {canvas.width(), tape + 0.025}, {205, 185, 140}, 0.8F));
    const Vector2d size(std::min(0.2, canvas.width() * 0.5), std::min(0.14, canvas.height() * 0.5));
    const Vector2d room(canvas.width() - size.x(), canvas.height() - size.y());
    const double low_y = room.y() * random.uniform(0.1, 0.9), low_x = room.x() * random.uniform(0.1, 0.9);
    const Vector2d low(low_x, low_y);
    canvas.draw(rectangle(low, low + size, {238, 236, 230}));
    canvas.scatter({2500, 0.002, 0.02, 0.95F, 0.4F}, low + size / 10, low + size * 0.9, random);
    canvas.scatter({60, 0.005, 0.05, 0.7F, 0.6F}, random);
    canvas.shade_borders(0.3, 0.02);
  };
}

}  // namespace cairn
