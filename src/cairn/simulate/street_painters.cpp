// SPDX-License-Identifier: Apache-2.0
#include "cairn/simulate/street_painters.h"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

using Eigen::Vector2d;

Shape rectangle(const Vector2d& low, const Vector2d& high, const Color& color, float opacity = 1) {
  return {(low + high) / 2, (high - low) / 2, 0, false, color, opacity};
}

/// Draws on a canvas as if the street ran along its columns with the near pavement on top.
class StreetFrame {
 public:
  StreetFrame(Canvas& canvas, const StreetGround& ground) : canvas_(canvas), ground_(ground) {}

  [[nodiscard]] double length() const { return ground_.along_x ? canvas_.width() : canvas_.height(); }
  [[nodiscard]] double across() const { return ground_.along_x ? canvas_.height() : canvas_.width(); }

  /// From `begin` to `end` along the street and `low` to `high` across it.
  void draw(double begin, double end, double low, double high, const Color& color, float opacity = 1) {
    if (!ground_.near_first) {
      low = across() - low;
      high = across() - high;
      std::swap(low, high);
    }
    const Vector2d from = ground_.along_x ? Vector2d(begin, low) : Vector2d(low, begin);
    const Vector2d to = ground_.along_x ? Vector2d(end, high) : Vector2d(high, end);
    canvas_.draw(rectangle(from, to, color, opacity));
  }

 private:
  Canvas& canvas_;
  const StreetGround& ground_;
};

/// Slabs of different tones between a kerb and the houses.
void draw_pavement(StreetFrame& street, double begin, double end, double low, double high, Random& random) {
  constexpr double kSlab = 0.5, kJoint = 0.015;
  for (double y = low; y < high; y += kSlab) {
    for (double x = begin; x < end; x += kSlab) {
      const Color tone = Color::Constant(static_cast<float>(random.uniform(128, 176)));
      street.draw(x + kJoint, std::min(x + kSlab, end), y + kJoint, std::min(y + kSlab, high), tone);
    }
  }
}

void draw_kerb(StreetFrame& street, double begin, double end, double at) {
  street.draw(begin, end, at - 0.08, at + 0.08, {190, 188, 182});
}

void draw_window(Canvas& canvas, const Vector2d& low, const Vector2d& high, Random& random) {
  const Vector2d frame(0.07, 0.07);
  canvas.draw(rectangle(low - frame, high + frame, random_color(random, 0.2F, 190, 250)));
  canvas.draw(rectangle(low, high, random_color(random, 0.4F, 20, 80)));
  if (random.index(2) == 0) {  // a curtain or a blind
    const double drop = random.uniform(0.2, 0.9) * (high.y() - low.y());
    canvas.draw(rectangle(low, {high.x(), low.y() + drop}, random_color(random, 0.5F, 110, 240), 0.85F));
  }
  canvas.scatter({8, 0.05, 0.3, 0.5F, 0.3F}, low + 2 * frame, high - 2 * frame, random);
  const double middle = (low.x() + high.x()) / 2;
  canvas.draw(rectangle({middle - 0.03, low.y()}, {middle + 0.03, high.y()}, {225, 222, 214}));
}

void draw_courses(Canvas& canvas, double brick_height, float opacity) {
  for (double y = brick_height; y < canvas.height(); y += brick_height)
    canvas.draw(rectangle({0, y - 0.012}, {canvas.width(), y + 0.012}, {70, 64, 60}, opacity));
}

/// Ground floor: shop windows with a sign over them, or a plain wall, and a door.
void draw_door(Canvas& canvas, double left, Random& random) {
  const double bottom = canvas.height();
  canvas.draw(rectangle({left - 0.08, bottom - 2.2}, {left + 1.08, bottom}, {214, 208, 196}));
  canvas.draw(rectangle({left, bottom - 2.1}, {left + 1.0, bottom}, random_color(random, 0.8F, 30, 140)));
  canvas.scatter({10, 0.05, 0.2, 0.6F, 0.5F}, {left + 0.1, bottom - 2}, {left + 0.9, bottom - 0.2}, random);
}

void draw_ground_floor(Canvas& canvas, double ceiling, Random& random) {
  const double bottom = canvas.height();
  const double door = random.uniform(0.4, canvas.width() - 1.5);
  if (random.index(2) == 0) {
    const Vector2d low(0.3, ceiling + 0.2), high(canvas.width() - 0.3, ceiling + 0.75);
    canvas.draw(rectangle(low, high, random_color(random, 0.9F, 60, 220)));
    canvas.scatter({45, 0.04, 0.2, 1, 0.8F}, low + Vector2d(0.3, 0.15), high - Vector2d(0.3, 0.15), random);
    for (double x = 0.4; x + 1.8 < canvas.width(); x += 2.0)
      draw_window(canvas, {x, ceiling + 0.95}, {x + 1.7, bottom - 0.5}, random);
  } else {
    for (double x = 0.6; x + 1.1 < canvas.width(); x += random.uniform(1.9, 2.9))
      draw_window(canvas, {x, ceiling + 0.8}, {x + 1.0, bottom - 0.9}, random);
  }
  draw_door(canvas, door, random);
}

void draw_floor(Canvas& canvas, double floor, double pitch, double width, Random& random) {
  for (double x = pitch / 4; x + width < canvas.width() - 0.2; x += pitch)
    draw_window(canvas, {x, floor - 2.2}, {x + width, floor - 0.8}, random);
  canvas.draw(
      rectangle({0, floor - 0.1}, {canvas.width(), floor + 0.1}, random_color(random, 0.2F, 130, 230)));
}

}  // namespace

Painter street_ground(const StreetGround& ground) {
  return [ground](Canvas& canvas, Random& random) {
    canvas.fill({92, 92, 94});
    StreetFrame street(canvas, ground);
    const double far = street.across() - ground.far_pavement;
    canvas.scatter({0.15, 0.3, 1.6, 0.35F, 0.05F}, random);  // repairs
    const double middle = (ground.near_pavement + far) / 2;
    for (double x = 1; x < street.length(); x += 6)
      street.draw(x, x + 3, middle - 0.07, middle + 0.07, {226, 226, 220}, 0.85F);
    draw_pavement(street, 0, street.length(), 0, ground.near_pavement, random);
    draw_pavement(street, ground.corner, street.length() - ground.corner, far, street.across(), random);
    draw_kerb(street, 0, street.length(), ground.near_pavement);
    draw_kerb(street, ground.corner, street.length() - ground.corner, far);
    canvas.add_noise({1.6, 7, 0.9, 15, 2}, random.next());
    canvas.scatter({6, 0.03, 0.25, 0.55F, 0.15F}, random);
  };
}

Painter house_front() {
  return [](Canvas& canvas, Random& random) {
    constexpr double kFloor = 3.0;
    canvas.fill(random_color(random, 0.5F, 120, 225));
    canvas.add_noise({2.5, 7, 0.8, 14, 4}, random.next());
    draw_courses(canvas, random.uniform(0.2, 0.45), 0.25F);
    canvas.scatter({3, 0.03, 0.2, 0.5F, 0.3F}, random);
    const double pitch = random.uniform(1.8, 2.8), width = random.uniform(0.9, 1.3);
    const double ground_ceiling = canvas.height() - kFloor;
    for (double floor = ground_ceiling; floor > kFloor * 0.8; floor -= kFloor)
      draw_floor(canvas, floor, pitch, width, random);
    draw_ground_floor(canvas, ground_ceiling, random);
    canvas.shade_borders(0.35, 0.15);
  };
}

Painter brick_wall() {
  return [](Canvas& canvas, Random& random) {
    canvas.fill(random_color(random, 0.5F, 100, 190));
    draw_courses(canvas, 0.3, 0.5F);
    canvas.add_noise({2, 7, 0.85, 16, 4}, random.next());
    canvas.scatter({5, 0.03, 0.3, 0.5F, 0.4F}, random);
  };
}

Painter car_body() {
  return [](Canvas& canvas, Random& random) {
    canvas.fill(random_color(random, 0.9F, 60, 230));
    const double h = canvas.height(), w = canvas.width();
    canvas.add_noise({0.8, 5, 0.8, 8, 2}, random.next());
    canvas.draw(rectangle({0.05 * w, 0.15 * h}, {0.47 * w, 0.5 * h}, {40, 46, 54}));
    canvas.draw(rectangle({0.53 * w, 0.15 * h}, {0.95 * w, 0.5 * h}, {48, 54, 62}));
    canvas.scatter({20, 0.02, 0.15, 0.8F, 0.5F}, random);
    canvas.shade_borders(0.4, 0.05);
  };
}

Painter pole() {
  return [](Canvas& canvas, Random& random) {
    canvas.fill(random_color(random, 0.6F, 60, 180));
    canvas.add_noise({0.3, 4, 0.9, 18, 3}, random.next());
    canvas.scatter({30, 0.02, 0.12, 0.9F, 0.8F}, random);
  };
}

Painter leaves() {
  return [](Canvas& canvas, Random& random) {
    canvas.fill({58, 84, 44});
    canvas.add_noise({0.6, 6, 0.95, 26, 6}, random.next());
    for (int i = static_cast<int>(60 * canvas.width() * canvas.height()); i > 0; --i) {
      const double size = random.uniform(0.03, 0.12), tone = random.uniform(0.4, 1.5);
      canvas.draw({{random.uniform(0, canvas.width()), random.uniform(0, canvas.height())},
                   {size, 0.5 * size},
                   random.uniform(0, 3.14),
                   true,
                   static_cast<float>(tone) * Color(84, 122, 58),
                   0.9F});
    }
  };
}

}  // namespace cairn
