#include "synthesis/window_texture.h"

#include <algorithm>
#include <cmath>

#include "synthesis/wall_texture.h"

namespace parvis::synthesis {
namespace {

constexpr float glass_roughness = 0.05f;

void paint_curtains(SurfaceCanvas& canvas, const Rect& rect, Random& random) {
  const float drawn = random.uniform(0.12f, 0.42f) * rect.width();  // each side
  const float tone = random.uniform(0.13f, 0.3f), waves = random.uniform(40.0f, 70.0f),
              phase = random.uniform(0.0f, 6.0f);
  const float blue = random.uniform(0.75f, 0.92f), green = random.uniform(0.9f, 0.98f);
  const glm::vec3 cloth = tone * glm::vec3(1.0f, green, blue);
  canvas.paint(rect, [&](float x, float y, Texel& t) {
    const float inward = std::min(x - rect.x0, rect.x1 - x);
    const float gathered =
        drawn * (0.75f + 0.35f * std::abs(y - rect.y0 - 0.35f * rect.height()) / rect.height());
    const float fold = 0.8f + 0.2f * std::sin(waves * x + phase + 1.5f * std::sin(3.0f * y));
    t.colour = glm::mix(t.colour, cloth * fold, glm::smoothstep(gathered, gathered - 0.05f, inward));
  });
}

void paint_blind(SurfaceCanvas& canvas, const Rect& rect, Random& random) {
  const float foot = rect.y1 - random.uniform(0.25f, 0.75f) * rect.height();
  const glm::vec3 cloth = random.uniform(0.16f, 0.34f) * glm::vec3(1.0f, 0.95f, 0.86f);
  canvas.paint({rect.x0, foot, rect.x1, rect.y1},
               [&](float, float y, Texel& t) { t.colour = cloth * (0.88f + 0.12f * std::sin(90.0f * y)); });
}

/// A net curtain: pale, thin, from the foot up, in folds.
void paint_net(SurfaceCanvas& canvas, const Rect& rect, Random& random) {
  const float top = rect.y0 + random.uniform(0.45f, 1.0f) * rect.height();
  const float thickness = random.uniform(0.45f, 0.75f), phase = random.uniform(0.0f, 6.0f);
  const glm::vec3 cloth = random.uniform(0.2f, 0.34f) * glm::vec3(1.0f, 0.99f, 0.96f);
  canvas.paint({rect.x0, rect.y0, rect.x1, top}, [&](float x, float y, Texel& t) {
    const float fold = 0.86f + 0.14f * std::sin(75.0f * x + phase + 2.0f * std::sin(9.0f * x));
    const float hem = y > top - 0.05f ? 1.1f : 1.0f;
    t.colour = glm::mix(t.colour, cloth * fold * hem, thickness);
  });
}

/// Paints the room behind: a lighter ceiling, and the back wall's edge, each room from its own side.
void paint_room(SurfaceCanvas& canvas, const Rect& rect, Random& random) {
  const float ceiling = rect.y1 - random.uniform(0.12f, 0.3f) * rect.height();
  const float corner = rect.x0 + random.uniform(0.15f, 0.85f) * rect.width();
  const float side = random.chance(0.5f) ? 1.0f : -1.0f, light = random.uniform(0.012f, 0.05f);
  canvas.paint(rect, [&](float x, float y, Texel& t) {
    const float slant = 0.35f * std::max(0.0f, side * (x - corner));  // the side wall's ceiling comes nearer
    const bool is_ceiling = y > ceiling + slant;
    const float wall = side * (x - corner) > 0.0f ? 0.55f : 1.0f;
    t.colour += light * (is_ceiling ? 1.3f : wall * glm::mix(0.5f, 1.0f, (y - rect.y0) / rect.height())) *
                glm::vec3(1.0f, 0.93f, 0.82f);
  });
}

/// One leaf of louvres; `turned` is the share of its width that is seen (1: flat).
void paint_shutter_leaf(SurfaceCanvas& canvas, const Rect& leaf, glm::vec3 colour, float height_m,
                        float turned) {
  canvas.fill(leaf, matt(colour * (0.75f + 0.25f * turned), height_m, 0.6f));
  const Rect field = {leaf.x0 + 0.06f * turned, leaf.y0 + 0.08f, leaf.x1 - 0.06f * turned, leaf.y1 - 0.08f};
  const float rail = 0.5f * (field.y0 + field.y1);
  canvas.paint(field, [&](float, float y, Texel& t) {
    if (std::abs(y - rail) < 0.05f) return;
    const float slat = y / 0.055f - std::floor(y / 0.055f);
    t.colour *= 0.52f + 0.55f * slat;
    t.height_m -= 0.012f * (1.0f - slat);
  });
  canvas.shade_below({leaf.x0 - 0.02f, leaf.y0 - 0.16f, leaf.x1 + 0.05f, leaf.y0}, 0.45f);
}

void paint_shutters(SurfaceCanvas& canvas, const WindowStyle& style, const Rect& opening, Random& random) {
  const glm::vec3 colour = style.shutter * random.uniform(0.85f, 1.12f);
  const float leaf = 0.5f * opening.width() + 0.02f;
  for (const float side : {-1.0f, 1.0f}) {
    const float edge = side < 0.0f ? opening.x0 : opening.x1;
    const float state = random.uniform();
    float reach = side * leaf, turned = 1.0f;  // folded back on the wall
    if (state > 0.84f) {
      reach = -side * leaf;  // closed
    } else if (state > 0.68f) {
      turned = random.uniform(0.35f, 0.6f), reach = -side * leaf * turned;  // half shut
    }
    const Rect rect{std::min(edge, edge + reach), opening.y0 - 0.02f, std::max(edge, edge + reach),
                    opening.y1 + 0.02f};
    const bool is_folded_back = side * reach > 0.0f;
    if (is_folded_back) {
      const Rect beside = side < 0.0f ? Rect{rect.x0 - 0.1f, rect.y0, rect.x0, rect.y1}
                                      : Rect{rect.x1, rect.y0, rect.x1 + 0.1f, rect.y1};
      canvas.shade_beside(beside, side < 0.0f ? -0.4f : 0.4f);
    }
    paint_shutter_leaf(canvas, rect, colour, is_folded_back ? 0.05f : -0.05f, turned);
  }
}

void paint_railing(SurfaceCanvas& canvas, const Rect& opening) {
  const Texel iron = matt(glm::vec3(0.018f), 0.04f, 0.5f);
  const Rect rail{opening.x0 - 0.06f, opening.y0 + 0.02f, opening.x1 + 0.06f, opening.y0 + 0.98f};
  for (const float y : {rail.y0, rail.y0 + 0.16f, rail.y1 - 0.14f, rail.y1})
    canvas.fill({rail.x0, y, rail.x1, y + 0.035f}, iron);
  const int bars = int(rail.width() / 0.11f);
  for (int i = 0; i <= bars; ++i) {
    const float x = rail.x0 + rail.width() * float(i) / float(bars);
    canvas.fill({x - 0.011f, rail.y0, x + 0.011f, rail.y1}, iron);
  }
  const float middle = rail.y0 + 0.5f * rail.height();
  for (int i = 0; i < bars; ++i) {  // a ring between each two bars
    const float x = rail.x0 + rail.width() * (float(i) + 0.5f) / float(bars);
    canvas.paint({x - 0.06f, middle - 0.06f, x + 0.06f, middle + 0.06f}, [&](float px, float py, Texel& t) {
      const float r = glm::length(glm::vec2(px - x, py - middle));
      if (r > 0.028f && r < 0.052f) t = iron;
    });
  }
}

void paint_sill(SurfaceCanvas& canvas, const WindowStyle& style, const Rect& opening, std::uint32_t seed) {
  const Rect sill{opening.x0 - 0.16f, opening.y0 - 0.12f, opening.x1 + 0.16f, opening.y0};
  paint_streaks(canvas, {sill.x0 - 0.05f, sill.y0 - 0.9f, sill.x1 + 0.05f, sill.y0}, 0.75f, seed);
  canvas.shade_below({sill.x0 - 0.03f, sill.y0 - 0.22f, sill.x1 + 0.03f, sill.y0}, 0.55f);
  canvas.fill(sill, matt(style.trim, 0.1f));
  canvas.fill({sill.x0, sill.y1 - 0.03f, sill.x1, sill.y1}, matt(style.trim * 1.12f, 0.08f));
}

void paint_hood(SurfaceCanvas& canvas, const WindowStyle& style, const Rect& opening) {
  const float y = opening.y1 + style.surround_m;
  if (style.hood == Hood::flat) {
    const Rect hood{opening.x0 - 0.3f, y + 0.06f, opening.x1 + 0.3f, y + 0.22f};
    canvas.shade_below({hood.x0, hood.y0 - 0.24f, hood.x1, hood.y0}, 0.6f);
    canvas.fill(hood, matt(style.trim, 0.14f));
    canvas.fill({hood.x0 - 0.04f, hood.y1 - 0.06f, hood.x1 + 0.04f, hood.y1}, matt(style.trim * 1.1f, 0.2f));
    for (const float x : {hood.x0 + 0.05f, hood.x1 - 0.17f})  // consoles
      canvas.fill({x, hood.y0 - 0.3f, x + 0.12f, hood.y0}, matt(style.trim * 0.95f, 0.1f));
  } else if (style.hood == Hood::keystone) {
    const float x = 0.5f * (opening.x0 + opening.x1);
    canvas.paint({x - 0.16f, opening.y1 - 0.04f, x + 0.16f, y + 0.14f}, [&](float px, float py, Texel& t) {
      if (std::abs(px - x) < 0.1f + 0.05f * (py - opening.y1) / 0.3f) t = matt(style.trim * 1.08f, 0.12f);
    });
  }
}

}  // namespace

Texel matt(glm::vec3 colour, float height_m, float roughness) {
  Texel t;
  t.colour = colour, t.height_m = height_m, t.roughness = roughness;
  return t;
}

void paint_glass(SurfaceCanvas& canvas, const Rect& rect, Random& random) {
  const float dark = random.uniform(0.012f, 0.035f), warm = random.uniform(0.0f, 0.3f);
  canvas.paint(rect, [&](float, float y, Texel& t) {
    const float up = (y - rect.y0) / rect.height();
    const float depth_m = t.height_m;
    t = matt(dark * glm::vec3(1.0f + warm, 1.05f, 1.15f - warm) * (0.7f + 0.6f * up), depth_m,
             glass_roughness);
  });
  paint_room(canvas, rect, random);
  const float kind = random.uniform();
  if (kind > 0.55f && kind < 0.75f) paint_net(canvas, rect, random);
  if (kind < 0.5f) paint_curtains(canvas, rect, random);
  if (kind < 0.2f) paint_net(canvas, rect, random);
  if (kind > 0.8f) paint_blind(canvas, rect, random);
}

void paint_casement(SurfaceCanvas& canvas, const Rect& opening, int panes_across, int panes_up,
                    glm::vec3 frame, float depth_m, Random& random) {
  canvas.fill(opening, matt(frame * 0.8f, -depth_m));
  const Rect inside = opening.inset(0.035f);
  canvas.fill(inside, matt(frame, 0.02f - depth_m, 0.5f));
  const Rect glass = inside.inset(0.05f);
  canvas.fill(glass, matt(glm::vec3(0.02f), -depth_m));
  paint_glass(canvas, glass, random);
  const auto bar = [&](const Rect& rect) { canvas.fill(rect, matt(frame, 0.02f - depth_m, 0.5f)); };
  for (int i = 1; i < panes_across; ++i) {
    const float x = glass.x0 + glass.width() * float(i) / float(panes_across);
    const float half = panes_across == 2 ? 0.045f : 0.02f;  // two casements meet in the middle
    bar({x - half, glass.y0, x + half, glass.y1});
  }
  for (int i = 1; i < panes_up; ++i) {
    const float y = glass.y0 + glass.height() * float(i) / float(panes_up);
    bar({glass.x0, y - 0.02f, glass.x1, y + 0.02f});
  }
  canvas.shade_below({opening.x0, opening.y1 - 0.35f, opening.x1, opening.y1}, 0.6f);
  canvas.shade_beside({opening.x0, opening.y0, opening.x0 + 0.14f, opening.y1}, 0.35f);
  canvas.shade_beside({opening.x1 - 0.14f, opening.y0, opening.x1, opening.y1}, -0.35f);
}

void paint_window(SurfaceCanvas& canvas, const WindowStyle& style, float x_m, float floor_m, Random& random) {
  const Rect opening{x_m - 0.5f * style.width_m, floor_m + style.foot_m, x_m + 0.5f * style.width_m,
                     floor_m + style.foot_m + style.height_m};
  if (style.surround_m > 0.0f) {
    const Rect surround = opening.inset(-style.surround_m);
    canvas.fill(surround, matt(style.trim, 0.035f));
    canvas.fill(surround.inset(0.045f), matt(style.trim * 0.94f, 0.02f));
  }
  paint_hood(canvas, style, opening);
  paint_casement(canvas, opening, style.panes_across, style.panes_up,
                 style.frame * random.uniform(0.85f, 1.0f), 0.2f, random);
  paint_sill(canvas, style, opening, random.next());
  if (style.has_shutters) paint_shutters(canvas, style, opening, random);
  if (style.has_railing) paint_railing(canvas, opening);
}

}  // namespace parvis::synthesis
