#include "places/dressing/kind_walls.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/colour.h"
#include "places/dressing/brick_texture.h"
#include "places/dressing/street_level_texture.h"
#include "synthesis/wall_texture.h"
#include "synthesis/window_texture.h"

namespace parvis::dressing {
namespace {

using scene::BuildingEpoch, scene::BuildingUse, scene::WallFinish, scene::WallTint;
using synthesis::Hood, synthesis::Rect, synthesis::SurfaceCanvas, synthesis::Texel, synthesis::Wall,
    synthesis::WindowStyle, synthesis::matt, synthesis::paint_wall, synthesis::paint_window;

constexpr float px_per_m = 88.0f;
constexpr int texels = 4;  // widths of sheets are multiples of so many

glm::vec3 white_paint() { return linear_from_srgb8(0xE2, 0xDF, 0xD6); }
glm::vec3 dark_paint() { return linear_from_srgb8(0x3A, 0x3D, 0x40); }
glm::vec3 brown_paint() { return linear_from_srgb8(0x5E, 0x44, 0x33); }
glm::vec3 trim_stone() { return linear_from_srgb8(0xC6, 0xC0, 0xB2); }

/// Buildings of an epoch: fractions of finishes, measures, windows in a cell of brick_bay_m by
/// brick_storey_m.
struct Epoch {
  float brick, plaster;  ///< fractions of houses; the rest is of `else_of`
  WallFinish else_of;
  WallMeasures measures;
  glm::vec2 window_m;  ///< width and height
  float foot_m;
  glm::ivec2 panes;
};

const Epoch& epoch_row(BuildingEpoch epoch) {
  using F = WallFinish;
  static const std::array<Epoch, 7> rows{{
      {1.0f, 0.0f, F::brick, {{2.8f, 3.35f}, {2.5f, 3.3f}}, {1.2f, 1.85f}, 0.72f, {1, 2}},     // unknown
      {0.4f, 0.45f, F::stone, {{2.8f, 3.1f}, {2.3f, 2.8f}}, {1.05f, 1.6f}, 0.85f, {2, 3}},     // before 1870
      {0.5f, 0.35f, F::stone, {{3.5f, 3.9f}, {2.4f, 2.8f}}, {1.2f, 1.85f}, 0.7f, {2, 2}},      // to 1918
      {0.7f, 0.3f, F::brick, {{2.9f, 3.1f}, {3.0f, 3.4f}}, {1.75f, 1.4f}, 0.95f, {3, 1}},      // to 1945
      {0.3f, 0.45f, F::concrete, {{2.7f, 2.85f}, {3.3f, 3.7f}}, {2.05f, 1.5f}, 0.9f, {2, 1}},  // to 1974
      {0.6f, 0.4f, F::brick, {{2.7f, 2.85f}, {2.9f, 3.3f}}, {1.35f, 1.4f}, 0.95f, {2, 1}},     // to 1999
      {0.45f, 0.5f, F::wood, {{2.95f, 3.15f}, {2.8f, 3.3f}}, {1.3f, 2.4f}, 0.1f, {1, 1}},      // since 2000
  }};
  return rows[std::size_t(epoch)];
}

glm::vec3 frame_of(BuildingEpoch epoch) {
  if (epoch == BuildingEpoch::since_2000) return dark_paint();
  return epoch == BuildingEpoch::to_1999 ? brown_paint() : white_paint();
}

bool is_old(BuildingEpoch epoch) {
  return epoch == BuildingEpoch::before_1870 || epoch == BuildingEpoch::to_1918;
}

WindowStyle window_of(const WallLook& look) {
  const Epoch& row = epoch_row(look.epoch);
  WindowStyle style;
  style.width_m = row.window_m.x, style.height_m = row.window_m.y, style.foot_m = row.foot_m;
  style.panes_across = row.panes.x, style.panes_up = row.panes.y;
  style.trim = trim_stone(), style.frame = frame_of(look.epoch);
  style.surround_m = is_old(look.epoch) && look.finish != WallFinish::brick ? 0.12f : 0.0f;
  if (look.epoch == BuildingEpoch::to_1918 && look.finish != WallFinish::brick) style.hood = Hood::flat;
  style.has_railing = look.epoch == BuildingEpoch::since_2000;
  if (look.epoch == BuildingEpoch::before_1870 && look.finish == WallFinish::plaster) {
    style.has_shutters = true;
    style.shutter = linear_from_srgb8(0x55, 0x6B, 0x5A);
  }
  if (!look.is_office) return style;
  style.has_railing = style.has_shutters = false;
  if (is_old(look.epoch) || look.epoch == BuildingEpoch::to_1945) {
    style.width_m = 1.75f, style.height_m = 2.0f, style.foot_m = 0.7f;
    style.panes_across = 3, style.panes_up = 2;
  } else {  // one band from end to end
    const bool is_glazed_to_floor = look.epoch == BuildingEpoch::since_2000;
    style.width_m = brick_bay_m - 0.06f, style.panes_across = 3, style.panes_up = 1;
    style.height_m = is_glazed_to_floor ? 2.45f : 1.6f, style.foot_m = is_glazed_to_floor ? 0.35f : 0.95f;
    style.surround_m = 0.0f, style.frame = dark_paint();
  }
  return style;
}

/// The wall in a middle tone, on which openings have an alpha of 1.
glm::vec3 paint_finish(SurfaceCanvas& canvas, WallFinish finish, Random& random) {
  if (finish == WallFinish::brick) {
    paint_bricks(canvas, random.next());
    return painted_brick();
  }
  const glm::vec3 middle(0.5f);
  paint_wall(canvas, finish == WallFinish::stone ? Wall::ashlar : Wall::plaster, middle, random.next());
  // Joints of panels; ribs of sheet metal; boards: their distance across and up, and the width of a groove.
  struct Grooves {
    float across_m, up_m, width_m;
  };
  const Grooves grooves = finish == WallFinish::concrete ? Grooves{brick_bay_m, brick_storey_m, 0.025f}
                          : finish == WallFinish::metal  ? Grooves{brick_bay_m / 12.0f, 0.0f, 0.05f}
                          : finish == WallFinish::wood   ? Grooves{0.0f, brick_storey_m / 20.0f, 0.02f}
                                                         : Grooves{0.0f, 0.0f, 0.0f};
  const auto is_groove = [&](float at, float distance_m) {
    if (distance_m == 0.0f) return false;
    const float place = at - distance_m * std::floor(at / distance_m);
    return place < grooves.width_m;
  };
  canvas.paint_all([&](float x, float y, Texel& t) {
    t.alpha = 0.0f;
    if (!is_groove(x, grooves.across_m) && !is_groove(y, grooves.up_m)) return;
    t.colour *= 0.55f, t.height_m -= 0.015f, t.openness = 0.7f;
  });
  return middle;
}

void paint_storeys(SurfaceCanvas& canvas, const WallLook& look, Random& random) {
  const WindowStyle style = window_of(look);
  const KindLayout layout = layout_of(KindSheet::storeys);
  for (int storey = 0; storey < int(layout.count.y); ++storey)
    for (int bay = 0; bay < int(layout.count.x); ++bay) {
      const float x_m = brick_bay_m * (float(bay) + 0.5f), floor_m = brick_storey_m * float(storey);
      if (look.finish == WallFinish::brick && !look.is_office)
        paint_brick_lintel(canvas, x_m, floor_m + style.foot_m + style.height_m,
                           0.5f * style.width_m + 0.08f);
      paint_window(canvas, style, x_m, floor_m, random);
    }
}

/// Gates of slats that roll up.
void paint_gates(SurfaceCanvas& canvas) {
  const KindLayout layout = layout_of(KindSheet::gates);
  const glm::vec3 paint = linear_from_srgb8(0x7E, 0x86, 0x8C);
  for (int bay = 0; bay < int(layout.count.x); bay += 2) {
    const float x = layout.cell_m.x * (float(bay) + 0.5f), half_m = 0.33f * layout.cell_m.x;
    const Rect gate{x - half_m, 0.02f, x + half_m, 0.82f * layout.cell_m.y};
    canvas.fill(gate.inset(-0.1f), matt(dark_paint(), 0.02f));
    canvas.paint(gate, [&](float, float y, Texel& t) {
      const float slat = y / 0.25f - std::floor(y / 0.25f);
      t = matt(paint * (slat < 0.1f ? 0.5f : 1.0f), slat < 0.1f ? -0.14f : -0.12f, 0.5f);
    });
    canvas.shade_below({gate.x0, gate.y1 - 0.35f, gate.x1, gate.y1}, 0.5f);
  }
}

/// Windows of leaded glass under round arches, between pillars of wall.
void paint_nave(SurfaceCanvas& canvas, Random& random) {
  const KindLayout layout = layout_of(KindSheet::nave);
  for (int bay = 0; bay < int(layout.count.x); ++bay) {
    const float x = layout.cell_m.x * (float(bay) + 0.5f), half_m = 0.22f * layout.cell_m.x;
    const float foot = 0.16f * layout.cell_m.y, spring = 0.86f * layout.cell_m.y - half_m;
    const auto is_inside = [&](float px, float py, float grown_m) {
      const float reach = half_m + grown_m, dx = px - x;
      if (py < foot - grown_m || std::abs(dx) > reach) return false;
      return py < spring || dx * dx + (py - spring) * (py - spring) < reach * reach;
    };
    const Rect around{x - half_m - 0.2f, foot - 0.2f, x + half_m + 0.2f, spring + half_m + 0.2f};
    const Texel frame = matt(trim_stone(), 0.04f), lead = matt(glm::vec3(0.05f), -0.17f, 0.5f);
    const float blue = random.uniform(0.03f, 0.06f), red = random.uniform(0.02f, 0.05f);
    const glm::vec3 tone(red, 0.035f, blue);
    canvas.paint(around, [&](float px, float py, Texel& t) {
      if (!is_inside(px, py, 0.0f)) {
        if (is_inside(px, py, 0.16f)) t = frame;
        return;
      }
      const glm::vec2 place = glm::vec2(px - x + half_m, py - foot) / glm::vec2(0.28f, 0.42f);
      const glm::vec2 in_pane = place - glm::floor(place);
      const bool is_lead = in_pane.x < 0.09f || in_pane.y < 0.06f || std::abs(px - x) < 0.06f;
      t = is_lead ? lead : matt(tone, -0.19f, 0.08f);
    });
    canvas.shade_beside({x - half_m, foot, x - half_m + 0.16f, spring}, 0.45f);
  }
}

StreetLook street_look(const WallLook& look, Random& random) {
  static const std::array<glm::vec3, 4> doors{
      linear_from_srgb8(0x2C, 0x50, 0x3E), linear_from_srgb8(0x3A, 0x52, 0x70),
      linear_from_srgb8(0x6B, 0x34, 0x2A), linear_from_srgb8(0x4A, 0x3A, 0x2E)};
  StreetLook street{window_of(look), doors[std::size_t(random.index(int(doors.size())))]};
  street.has_lintels = look.finish == WallFinish::brick && !look.is_office;
  if (look.epoch == BuildingEpoch::since_2000) {
    street.window.has_railing = false;
    if (!look.is_office) street.window.foot_m = 0.35f, street.window.height_m = 2.15f;
    street.door = dark_paint();
  }
  return street;
}

/// Colours nearest to which a tint is.
glm::vec3 colour_of(WallTint tint) {
  static const std::array<glm::vec3, 9> colours{glm::vec3(0.5f),
                                                linear_from_srgb8(0xF0, 0xEE, 0xE8),
                                                linear_from_srgb8(0xA8, 0xA8, 0xA8),
                                                linear_from_srgb8(0x50, 0x50, 0x50),
                                                linear_from_srgb8(0xE0, 0xC0, 0x80),
                                                linear_from_srgb8(0xB0, 0x60, 0x50),
                                                linear_from_srgb8(0x78, 0x50, 0x40),
                                                linear_from_srgb8(0x90, 0xA8, 0x88),
                                                linear_from_srgb8(0x80, 0x98, 0xB0)};
  return colours[std::size_t(tint)];
}

int nearest(const std::vector<glm::vec3>& colours, glm::vec3 wanted) {
  const auto differs = [&](glm::vec3 c) {
    return glm::distance(glm::sqrt(c), glm::sqrt(wanted));  // about as an eye sees it
  };
  return int(std::ranges::min_element(colours, {}, differs) - colours.begin());
}

BuildingEpoch chosen_epoch(const scene::BuildingKind& kind, Random& random) {
  if (kind.epoch != BuildingEpoch::unknown || kind.use != BuildingUse::office) return kind.epoch;
  return BuildingEpoch(int(BuildingEpoch::to_1974) + random.index(3));
}

WallFinish chosen_finish(const scene::BuildingKind& kind, BuildingEpoch epoch, Random& random) {
  if (kind.finish != WallFinish::unknown) return kind.finish;
  const float choice = random.uniform();
  const bool is_recent = epoch >= BuildingEpoch::to_1974;
  if (kind.use == BuildingUse::church && is_old(epoch))
    return choice < 0.6f ? WallFinish::stone : WallFinish::plaster;
  if (kind.use == BuildingUse::industry && is_recent)
    return choice < 0.7f ? WallFinish::metal : WallFinish::concrete;
  if (kind.use == BuildingUse::office && is_recent && choice < 0.35f) return WallFinish::concrete;
  const Epoch& row = epoch_row(epoch);
  if (choice < row.brick) return WallFinish::brick;
  return choice < row.brick + row.plaster ? WallFinish::plaster : row.else_of;
}

}  // namespace

KindLayout layout_of(KindSheet sheet) {
  const glm::vec2 cell_m(brick_bay_m, brick_storey_m);
  switch (sheet) {
    case KindSheet::plain:
      return {{2.0f, 2.0f}, cell_m};
    case KindSheet::gates:
      return {{2.0f, 1.0f}, {5.8f, 4.8f}};
    case KindSheet::nave:
      return {{2.0f, 1.0f}, {4.4f, 8.0f}};
    default:
      return {{float(brick_bays), 2.0f}, cell_m};
  }
}

WallMeasures measures_of(const WallLook& look) {
  if (look.is_office) return {{3.3f, 3.8f}, {2.7f, 3.6f}};
  return epoch_row(look.epoch).measures;
}

std::vector<glm::vec3> wall_colours(WallFinish finish) {
  const auto of = [](std::initializer_list<int> srgb) {
    std::vector<glm::vec3> colours;
    for (const int hex : srgb) colours.push_back(linear_from_srgb8(hex >> 16, (hex >> 8) & 255, hex & 255));
    return colours;
  };
  switch (finish) {
    case WallFinish::plaster:
      return of({0xE6E2DA, 0xE3D7BE, 0xD3B57F, 0xBDBBB5, 0xCFA690, 0xA9B7A0});
    case WallFinish::stone:
      return of({0xC4B08C, 0xB0ACA3, 0xA2735E});
    case WallFinish::concrete:
      return of({0xB4B0A7, 0xCCC8BE});
    case WallFinish::metal:
      return of({0x9AA2A8, 0xD4D6D4, 0x5F6E7C});
    case WallFinish::wood:
      return of({0x8A6544, 0x5B4636, 0xB3A188});
    default: {
      const auto bricks = brick_colours();
      return {bricks.begin(), bricks.end()};
    }
  }
}

ChosenWall chosen_wall(const scene::BuildingKind& kind, Random& random) {
  ChosenWall wall;
  wall.look.epoch = chosen_epoch(kind, random);
  wall.look.finish = chosen_finish(kind, wall.look.epoch, random);
  wall.look.is_office = kind.use == BuildingUse::office;
  const std::vector<glm::vec3> colours = wall_colours(wall.look.finish);
  const int by_seed = random.index(int(colours.size()));
  wall.colour = kind.tint == WallTint::unknown ? by_seed : nearest(colours, colour_of(kind.tint));
  return wall;
}

KindPictures wall_pictures(KindSheet sheet, const WallLook& look) {
  Random random(1, std::uint64_t(look.epoch) * 64 + std::uint64_t(look.finish) * 8 + std::uint64_t(sheet));
  const KindLayout layout = layout_of(sheet);
  const glm::vec2 size_m = layout.count * layout.cell_m;
  const glm::ivec2 size_px = texels * glm::ivec2(glm::round(px_per_m * size_m / float(texels)));
  SurfaceCanvas canvas(size_px.x, size_px.y, size_m.x, size_m.y);
  KindPictures result;
  result.painted = paint_finish(canvas, look.finish, random);
  if (sheet == KindSheet::storeys) paint_storeys(canvas, look, random);
  if (sheet == KindSheet::street) paint_street_level(canvas, street_look(look, random), random);
  if (sheet == KindSheet::gates) paint_gates(canvas);
  if (sheet == KindSheet::nave) paint_nave(canvas, random);
  result.pictures = canvas.pictures(1, 2);
  return result;
}

}  // namespace parvis::dressing
