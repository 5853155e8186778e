#include "places/dressing/street_level_texture.h"

#include <array>
#include <cmath>

#include "base/colour.h"
#include "places/dressing/brick_texture.h"
#include "synthesis/shop_texture.h"
#include "synthesis/window_texture.h"

namespace parvis::dressing {
namespace {

using synthesis::Rect, synthesis::SurfaceCanvas, synthesis::Texel, synthesis::WindowStyle, synthesis::matt,
    synthesis::paint_glass, synthesis::paint_shop_display, synthesis::paint_window;

constexpr float door_m = 1.0f, leaf_m = 2.1f, doorway_m = 2.5f;  // width; heights of its leaf and its light
constexpr float plinth_m = 0.32f;

glm::vec3 white_joinery() { return linear_from_srgb8(0xE2, 0xDF, 0xD6); }
glm::vec3 stone() { return linear_from_srgb8(0x8E, 0x8A, 0x82); }

/// A stone along the foot of the wall.
void paint_plinth(SurfaceCanvas& canvas, float foot) {
  canvas.fill({0.0f, foot, canvas.width_m(), foot + plinth_m}, matt(0.55f * stone(), 0.03f));
  canvas.fill({0.0f, foot + plinth_m - 0.05f, canvas.width_m(), foot + plinth_m},
              matt(0.8f * stone(), 0.05f));
}

/// A panelled leaf under a light, with a step before it.
void paint_front_door(SurfaceCanvas& canvas, float x, float foot, float width_m, glm::vec3 wood,
                      bool has_lintel, Random& random) {
  const Rect doorway{x - 0.5f * width_m, foot + 0.02f, x + 0.5f * width_m, foot + doorway_m};
  if (has_lintel) paint_brick_lintel(canvas, x, doorway.y1, 0.5f * width_m + 0.08f);
  canvas.fill(doorway, matt(white_joinery(), -0.12f, 0.5f));
  const Rect light{doorway.x0 + 0.08f, foot + leaf_m + 0.06f, doorway.x1 - 0.08f, doorway.y1 - 0.08f};
  canvas.fill(light, matt(glm::vec3(0.02f), -0.16f));
  paint_glass(canvas, light, random);
  const Rect leaf{x - 0.5f * door_m + 0.06f, doorway.y0, x + 0.5f * door_m - 0.06f, foot + leaf_m};
  canvas.fill(leaf, matt(wood, -0.16f, 0.35f));
  for (const float y : {0.25f, 1.0f}) {
    const Rect panel{leaf.x0 + 0.13f, foot + y, leaf.x1 - 0.13f, foot + y + (y < 0.5f ? 0.6f : 0.95f)};
    canvas.fill(panel, matt(0.65f * wood, -0.165f, 0.35f));
    canvas.fill(panel.inset(0.03f), matt(1.1f * wood, -0.175f, 0.35f));
  }
  canvas.fill({x - 0.14f, foot + 0.88f, x + 0.14f, foot + 0.95f}, matt(glm::vec3(0.35f), -0.15f, 0.3f));
  if (width_m > door_m + 0.3f) {  // a light beside the leaf
    const Rect side{leaf.x1 + 0.14f, foot + 0.6f, doorway.x1 - 0.08f, foot + leaf_m};
    canvas.fill(side, matt(glm::vec3(0.02f), -0.16f));
    paint_glass(canvas, side, random);
  }
  canvas.shade_below({doorway.x0, doorway.y1 - 0.4f, doorway.x1, doorway.y1}, 0.55f);
  canvas.shade_beside({doorway.x0, doorway.y0, doorway.x0 + 0.12f, doorway.y1}, 0.4f);
  canvas.fill({doorway.x0 - 0.15f, foot, doorway.x1 + 0.15f, foot + 0.15f}, matt(stone(), 0.12f));
}

WindowStyle street_window(float width_m, int panes_across) {
  WindowStyle style;
  style.width_m = width_m, style.height_m = 1.65f, style.foot_m = 0.82f;
  style.panes_across = panes_across, style.panes_up = 1, style.surround_m = 0.0f;
  style.trim = linear_from_srgb8(0xB4, 0xAE, 0xA2), style.frame = white_joinery();
  return style;
}

void paint_street_window(SurfaceCanvas& canvas, float x, float foot, float width_m, int panes_across,
                         Random& random) {
  const WindowStyle style = street_window(width_m, panes_across);
  paint_brick_lintel(canvas, x, foot + style.foot_m + style.height_m, 0.5f * width_m + 0.08f);
  paint_window(canvas, style, x, foot, random);
}

void paint_houses(SurfaceCanvas& canvas, float foot, bool has_wide_panes, Random& random) {
  paint_plinth(canvas, foot);
  const glm::vec3 wood =
      has_wide_panes ? linear_from_srgb8(0x3A, 0x52, 0x70) : linear_from_srgb8(0x2C, 0x50, 0x3E);
  for (int bay = 0; bay < brick_bays; ++bay) {
    const float x = brick_bay_m * (float(bay) + 0.5f);
    if (bay == door_bay)
      paint_front_door(canvas, x, foot, has_wide_panes ? door_m + 0.6f : door_m, wood, true, random);
    else if (has_wide_panes && bay % 2 == 1)
      paint_street_window(canvas, x, foot, 2.1f, 3, random);
    else
      paint_street_window(canvas, x, foot, 1.3f, 2, random);
  }
}

/// Shop windows with a door in every other bay, under a fascia along the whole front.
void paint_shops(SurfaceCanvas& canvas, float foot, Random& random) {
  constexpr float fascia_foot_m = 2.5f, fascia_m = 0.46f;
  const glm::vec3 wood = linear_from_srgb8(0x6E, 0x74, 0x66);
  const float top = foot + brick_storey_m;
  canvas.fill({0.0f, foot, canvas.width_m(), top - 0.08f}, matt(wood, 0.03f, 0.45f));
  canvas.fill({0.0f, foot, canvas.width_m(), foot + 0.16f}, matt(0.6f * stone(), 0.05f));
  for (int bay = 0; bay < brick_bays; ++bay) {
    const float x = brick_bay_m * float(bay);
    const bool has_door = bay % 2 == 1;
    const Rect window{x + 0.18f, foot + 0.5f, x + brick_bay_m - (has_door ? 1.3f : 0.18f), foot + 2.36f};
    paint_shop_display(canvas, window, wood, random);
    canvas.shade_beside({window.x0, window.y0, window.x0 + 0.12f, window.y1}, 0.5f);
    if (!has_door) continue;
    const Rect door{window.x1 + 0.14f, foot + 0.04f, x + brick_bay_m - 0.18f, foot + 2.36f};
    paint_shop_display(canvas, door, wood, random);
    canvas.fill({door.x0, door.y0, door.x1, door.y0 + 0.7f}, matt(0.85f * wood, -0.08f, 0.4f));
    canvas.fill({door.x0, foot + 2.05f, door.x1, foot + 2.12f}, matt(wood, -0.06f, 0.4f));
    canvas.fill({door.x0 + 0.1f, foot + 0.95f, door.x0 + 0.14f, foot + 1.35f},
                matt(glm::vec3(0.4f), -0.06f, 0.3f));
  }
  const Rect fascia{0.0f, foot + fascia_foot_m, canvas.width_m(), foot + fascia_foot_m + fascia_m};
  canvas.shade_below({fascia.x0, fascia.y0 - 0.3f, fascia.x1, fascia.y0}, 0.6f);
  canvas.fill(fascia, matt(1.25f * wood, 0.12f, 0.4f));
  canvas.fill({fascia.x0, fascia.y1, fascia.x1, top}, matt(stone(), 0.16f, 0.6f));
}

void paint_sheds(SurfaceCanvas& canvas, float foot, Random& random) {
  const float x = brick_bay_m * (float(garage_bay) + 0.5f);
  const Rect door{x - 1.2f, foot + 0.02f, x + 1.2f, foot + 2.2f};
  paint_brick_lintel(canvas, x, door.y1, 1.28f);
  const glm::vec3 paint = linear_from_srgb8(0x8C, 0x90, 0x8E);
  canvas.paint(door, [&](float, float y, Texel& t) {
    const float slat = (y - foot) / 0.22f - std::floor((y - foot) / 0.22f);
    t = matt(paint * (slat < 0.08f ? 0.45f : 1.0f), slat < 0.08f ? -0.13f : -0.12f, 0.5f);
  });
  canvas.shade_below({door.x0, door.y1 - 0.35f, door.x1, door.y1}, 0.5f);
  WindowStyle style = street_window(0.9f, 1);
  style.height_m = 0.7f, style.foot_m = 1.45f;
  paint_window(canvas, style, brick_bay_m * (float(small_window_bay) + 0.5f), foot, random);
}

}  // namespace

void paint_street_level(SurfaceCanvas& canvas, const StreetLook& look, Random& random) {
  paint_plinth(canvas, 0.0f);
  for (int bay = 0; bay < brick_bays; ++bay) {
    const float x = brick_bay_m * (float(bay) + 0.5f);
    if (bay == door_bay) {
      paint_front_door(canvas, x, 0.0f, door_m, look.door, look.has_lintels, random);
      continue;
    }
    const WindowStyle& window = look.window;
    if (look.has_lintels)
      paint_brick_lintel(canvas, x, window.foot_m + window.height_m, 0.5f * window.width_m + 0.08f);
    paint_window(canvas, window, x, 0.0f, random);
  }
  paint_shops(canvas, brick_storey_m, random);
}

void paint_street_level(SurfaceCanvas& canvas, Random& random) {
  const auto foot = [](StreetBand band) { return brick_storey_m * float(band); };
  paint_houses(canvas, foot(StreetBand::houses), false, random);
  paint_houses(canvas, foot(StreetBand::wide_panes), true, random);
  paint_shops(canvas, foot(StreetBand::shops), random);
  paint_sheds(canvas, foot(StreetBand::sheds), random);
}

}  // namespace parvis::dressing
