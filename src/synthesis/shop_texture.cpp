#include "synthesis/shop_texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/colour.h"
#include "synthesis/lettering.h"
#include "synthesis/wall_texture.h"
#include "synthesis/window_texture.h"

namespace parvis::synthesis {
namespace {

constexpr int shop_sheet_px = 2048;

struct Shop {
  std::string_view name;
  glm::vec3 srgb;  ///< of its woodwork, 0..255
  bool has_light_letters;
};
constexpr std::array<Shop, shop_modules * shop_strips> sheet_shops{{
    {"BOULANGERIE", {112, 62, 40}, true},
    {"CAFE", {36, 64, 52}, true},
    {"LIBRAIRIE", {40, 56, 92}, true},
    {"FLEURS", {196, 186, 160}, false},
    {"PHARMACIE", {62, 66, 66}, true},
    {"EPICERIE", {118, 40, 36}, true},
    {"COIFFEUR", {186, 196, 192}, false},
    {"BIJOUX", {30, 32, 36}, true},
    {"CAFE DE LA PLACE", {128, 84, 44}, true},
    {"OPTIQUE", {72, 94, 104}, true},
    {"TABAC", {140, 44, 34}, true},
    {"CHOCOLAT", {70, 44, 34}, true},
    {"MODE", {204, 198, 186}, false},
    {"VINS", {78, 32, 44}, true},
    {"JOUETS", {58, 104, 96}, true},
}};

glm::vec3 linear8(glm::vec3 srgb) { return linear_from_srgb(srgb / 255.0f); }

struct ShopOpenings {
  Rect door, window;
};

/// Glass with bars, the lower part of the door, and panels below the window.
void paint_shop_openings(SurfaceCanvas& canvas, const ShopOpenings& openings, float foot, glm::vec3 wood,
                         Random& random) {
  const Rect& door = openings.door;
  const Rect& window = openings.window;
  for (const Rect& opening : {door, window}) {
    canvas.fill(opening.inset(-0.05f), matt(wood * 1.25f, 0.06f, 0.4f));
    paint_shop_display(canvas, opening, wood, random);
    canvas.shade_beside({opening.x0, opening.y0, opening.x0 + 0.12f, opening.y1}, 0.5f);
  }
  const Texel bar = matt(wood, -0.04f, 0.4f);
  canvas.fill({door.x0, door.y0, door.x1, door.y0 + 0.85f}, matt(wood * 0.9f, -0.08f, 0.4f));
  canvas.fill({door.x0, door.y0 + 2.15f, door.x1, door.y0 + 2.25f}, bar);
  canvas.fill({window.x0, window.y1 - 0.6f, window.x1, window.y1 - 0.54f}, bar);
  const float pane = window.width() / 3.0f;
  for (int i = 0; i < 3; ++i) {
    const float x = window.x0 + pane * float(i);
    if (i > 0) canvas.fill({x - 0.03f, window.y0, x + 0.03f, window.y1}, bar);
    canvas.fill({x + 0.08f, foot + 0.22f, x + pane - 0.08f, foot + 0.62f}, matt(wood * 0.8f, 0.02f, 0.45f));
  }
}

void paint_fascia(SurfaceCanvas& canvas, const Rect& fascia, const Shop& shop, glm::vec3 wood) {
  canvas.shade_below({fascia.x0, fascia.y0 - 0.3f, fascia.x1, fascia.y0}, 0.6f);
  canvas.fill(fascia, matt(wood * 0.9f, 0.14f, 0.4f));
  const glm::vec3 ink =
      shop.has_light_letters ? linear_from_srgb8(0xE8, 0xD2, 0x9A) : linear_from_srgb8(0x3A, 0x4A, 0x38);
  const float letter_m = 0.34f * std::min(1.0f, 3.7f / lettering_width(shop.name, 0.34f));
  const float start = 0.5f * (fascia.x0 + fascia.x1 - lettering_width(shop.name, letter_m));
  paint_lettering(canvas, shop.name, start, fascia.y0 + 0.5f * (fascia.height() - letter_m), letter_m,
                  matt(ink, 0.02f, 0.4f));
  canvas.fill({fascia.x0 - 0.06f, fascia.y1, fascia.x1 + 0.06f, fascia.y1 + 0.1f},
              matt(wood * 1.1f, 0.22f, 0.5f));
}

void paint_shop_front(SurfaceCanvas& canvas, float x0, float foot, const Shop& shop, Random& random) {
  const glm::vec3 wood = linear8(shop.srgb);
  const Rect front{x0 + 0.34f, foot + 0.06f, x0 + shop_module_m - 0.34f, foot + 4.0f};
  canvas.fill(front, matt(wood, 0.04f, 0.45f));
  const bool door_is_left = random.chance(0.5f);
  const float door_x = door_is_left ? front.x0 + 0.14f : front.x1 - 1.14f;
  const Rect door{door_x, foot + 0.12f, door_x + 1.0f, foot + 3.2f};
  const Rect window{door_is_left ? door.x1 + 0.16f : front.x0 + 0.14f, foot + 0.75f,
                    door_is_left ? front.x1 - 0.14f : door.x0 - 0.16f, foot + 3.2f};
  paint_shop_openings(canvas, {door, window}, foot, wood, random);
  paint_fascia(canvas, {front.x0 - 0.05f, foot + 3.3f, front.x1 + 0.05f, foot + 3.95f}, shop, wood);
}

void paint_arched_door(SurfaceCanvas& canvas, const Rect& door, glm::vec3 wood, glm::vec3 trim) {
  const float middle = 0.5f * (door.x0 + door.x1), radius = 0.5f * door.width(), spring = door.y1 - radius;
  const auto beyond = [&](float x, float y) {  // how far outside of the opening, negative inside
    return y > spring ? glm::length(glm::vec2(x - middle, y - spring)) - radius
                      : std::abs(x - middle) - radius;
  };
  canvas.paint({door.x0 - 0.3f, door.y0, door.x1 + 0.3f, door.y1 + 0.3f}, [&](float x, float y, Texel& t) {
    const float out = beyond(x, y);
    if (out > 0.24f) return;
    if (out > 0.0f) {
      t = matt(trim * (0.9f + 0.15f * glm::smoothstep(0.0f, 0.2f, out)), 0.06f);
    } else if (y > spring) {
      t = matt(glm::vec3(0.025f), -0.2f, 0.05f);  // fanlight
      const float angle = std::atan2(y - spring, x - middle);
      if (std::abs(std::sin(angle * 4.0f)) < 0.12f || out > -0.07f) t = matt(wood, -0.17f, 0.4f);
    } else {
      t = matt(wood, -0.2f, 0.35f);
      const glm::vec2 panel(std::abs(std::abs(x - middle) - 0.5f * radius) / (0.32f * radius),
                            std::abs(std::fmod(y - door.y0, 0.95f) - 0.5f) / 0.38f);
      const float edge = std::max(panel.x, panel.y);
      if (edge < 1.0f) t.colour *= edge > 0.85f ? 0.6f : 1.15f;
      if (std::abs(x - middle) < 0.012f) t.colour *= 0.3f;
      t.openness *=
          1.0f - 0.6f * glm::smoothstep(spring - 0.7f, spring, y) - 0.3f * glm::smoothstep(-0.25f, 0.0f, out);
    }
  });
}

void paint_house_module(SurfaceCanvas& canvas, float x0, float foot, int index, glm::vec3 trim,
                        Random& random) {
  constexpr std::array<glm::vec3, 3> doors{{{48, 74, 62}, {96, 58, 34}, {52, 60, 84}}};
  const glm::vec3 wood = linear8(doors[std::size_t(index) % doors.size()]);
  const float middle = x0 + 0.5f * shop_module_m;
  if (index % 2 == 0) {
    paint_arched_door(canvas, {middle - 0.75f, foot + 0.06f, middle + 0.75f, foot + 3.3f}, wood, trim);
    return;
  }
  WindowStyle style;
  style.width_m = 1.15f, style.height_m = 2.0f, style.foot_m = 1.15f;
  style.hood = Hood::keystone, style.trim = trim, style.frame = glm::vec3(0.6f), style.surround_m = 0.18f;
  for (const float x : {middle - 1.25f, middle + 1.25f}) {
    paint_window(canvas, style, x, foot, random);
    const Texel iron = matt(glm::vec3(0.02f), 0.02f, 0.5f);
    for (int i = 0; i <= 8; ++i) {
      const float bar = x - 0.5f + 0.125f * float(i);
      canvas.fill({bar - 0.012f, foot + 1.15f, bar + 0.012f, foot + 3.15f}, iron);
    }
    for (const float y : {1.35f, 2.2f, 2.95f})
      canvas.fill({x - 0.55f, foot + y, x + 0.55f, foot + y + 0.03f}, iron);
  }
}

/// The foot of every wall: dark with damp and with what the street throws up, in uneven tongues.
void paint_damp_foot(SurfaceCanvas& canvas, float foot) {
  canvas.paint({0.0f, foot, canvas.width_m(), foot + 0.8f}, [&](float x, float y, Texel& t) {
    const float tongue =
        0.55f + 0.2f * std::sin(2.7f * x) + 0.15f * std::sin(7.1f * x + 1.0f) + 0.1f * std::sin(19.0f * x);
    const float up = (y - foot) / 0.8f;
    const float damp = 0.6f * glm::smoothstep(tongue, 0.0f, up);
    t.colour *= glm::vec3(1.0f) - damp * glm::vec3(0.8f, 0.84f, 0.9f);
    t.openness *= 0.6f + 0.4f * std::min(1.0f, 2.5f * up);
  });
}

/// The ledge between ground floor and upper floors, over the strip's full width.
void paint_ledge(SurfaceCanvas& canvas, float top, glm::vec3 trim) {
  canvas.shade_below({0.0f, top - 0.5f, canvas.width_m(), top - 0.24f}, 0.5f);
  canvas.fill({0.0f, top - 0.24f, canvas.width_m(), top}, matt(trim * 0.95f, 0.08f));
  canvas.fill({0.0f, top - 0.08f, canvas.width_m(), top}, matt(trim * 1.06f, 0.14f));
}

}  // namespace

void paint_shop_display(SurfaceCanvas& canvas, const Rect& glass, glm::vec3 tint, Random& random) {
  canvas.paint(glass, [&](float, float y, Texel& t) {
    const float up = (y - glass.y0) / glass.height();
    t = matt(glm::vec3(0.035f, 0.033f, 0.03f) * (0.6f + 1.4f * up * up), -0.12f, 0.05f);
  });
  for (int row = 0; row < 3; ++row) {
    const float shelf = glass.y0 + 0.12f + 0.62f * float(row);
    if (shelf + 0.4f > glass.y1) break;
    for (float x = glass.x0 + 0.1f; x < glass.x1 - 0.25f;) {
      const float width = random.uniform(0.12f, 0.4f), height = random.uniform(0.12f, 0.42f);
      const float green = random.uniform(0.7f, 1.0f), blue = green * random.uniform(0.5f, 0.95f);
      const glm::vec3 thing = glm::mix(glm::vec3(1.0f, green, blue), tint, random.uniform(0.0f, 0.6f));
      if (random.chance(0.8f))
        canvas.fill({x, shelf, std::min(x + width, glass.x1), shelf + height},
                    matt(thing * random.uniform(0.06f, 0.28f), -0.12f, 0.05f));
      x += width + random.uniform(0.02f, 0.2f);
    }
  }
  canvas.shade_below({glass.x0, glass.y1 - 0.7f, glass.x1, glass.y1}, 0.75f);
}

glm::vec2 ground_floor_strip(int strip) {
  const float height = 1.0f / float(ground_floor_strips), half_pixel = 1.5f / float(shop_sheet_px);
  const float foot = 1.0f - height * float(strip);  // keeps the strips' colours apart in the first mipmaps
  return {foot - half_pixel, foot - height + half_pixel};
}

SurfaceCanvas ground_floor_canvas(std::uint32_t seed) {
  Random random(seed);
  SurfaceCanvas canvas(shop_sheet_px, shop_sheet_px, shop_module_m * float(shop_modules),
                       ground_floor_m * float(ground_floor_strips));
  const glm::vec3 stone = linear_from_srgb8(0xC4, 0xB8, 0xA0);
  paint_wall(canvas, Wall::ashlar, stone, random.next());
  for (int strip = 0; strip < ground_floor_strips; ++strip) {
    const float foot = ground_floor_m * float(strip);
    for (int module = 0; module < shop_modules; ++module) {
      const float x0 = shop_module_m * float(module);
      if (strip < shop_strips)
        paint_shop_front(canvas, x0, foot,
                         sheet_shops[std::size_t(strip) * shop_modules + std::size_t(module)], random);
      else
        paint_house_module(canvas, x0, foot, module, stone * 1.05f, random);
    }
    paint_ledge(canvas, foot + ground_floor_m, stone);
    paint_damp_foot(canvas, foot);
  }
  return canvas;
}

SurfacePictures ground_floor_pictures(std::uint32_t seed) { return ground_floor_canvas(seed).pictures(4, 4); }

}  // namespace parvis::synthesis
