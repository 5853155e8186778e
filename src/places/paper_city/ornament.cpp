#include "places/paper_city/ornament.h"

#include <algorithm>
#include <cmath>

#include "synthesis/trim_texture.h"

namespace parvis::city {
namespace {

using Kind = Ornament::Kind;

/// A box on a wall (or free): the six faces by name, in the frame of the wall, where y < 0 is outside.
struct Box {
  const Frame& frame;
  float x0, x1, y0, y1, z0, z1;

  glm::vec3 at(float x, float y, float z) const { return frame.point(x, y, z); }
};

void front(CityMesh& mesh, CityMaterial m, const Box& b, glm::vec2 foot, glm::vec2 top) {
  mesh.quad(m, b.at(b.x0, b.y0, b.z0), b.at(b.x1, b.y0, b.z0), b.at(b.x1, b.y0, b.z1), b.at(b.x0, b.y0, b.z1),
            foot, top);
}
void back(CityMesh& mesh, CityMaterial m, const Box& b, glm::vec2 foot, glm::vec2 top) {
  mesh.quad(m, b.at(b.x1, b.y1, b.z0), b.at(b.x0, b.y1, b.z0), b.at(b.x0, b.y1, b.z1), b.at(b.x1, b.y1, b.z1),
            foot, top);
}
void left(CityMesh& mesh, CityMaterial m, const Box& b, glm::vec2 foot, glm::vec2 top) {
  mesh.quad(m, b.at(b.x0, b.y1, b.z0), b.at(b.x0, b.y0, b.z0), b.at(b.x0, b.y0, b.z1), b.at(b.x0, b.y1, b.z1),
            foot, top);
}
void right(CityMesh& mesh, CityMaterial m, const Box& b, glm::vec2 foot, glm::vec2 top) {
  mesh.quad(m, b.at(b.x1, b.y0, b.z0), b.at(b.x1, b.y1, b.z0), b.at(b.x1, b.y1, b.z1), b.at(b.x1, b.y0, b.z1),
            foot, top);
}
void lid(CityMesh& mesh, CityMaterial m, const Box& b, glm::vec2 foot, glm::vec2 top) {
  mesh.quad(m, b.at(b.x0, b.y0, b.z1), b.at(b.x1, b.y0, b.z1), b.at(b.x1, b.y1, b.z1), b.at(b.x0, b.y1, b.z1),
            foot, top);
}
void underside(CityMesh& mesh, CityMaterial m, const Box& b, glm::vec2 foot, glm::vec2 top) {
  mesh.quad(m, b.at(b.x0, b.y1, b.z0), b.at(b.x1, b.y1, b.z0), b.at(b.x1, b.y0, b.z0), b.at(b.x0, b.y0, b.z0),
            foot, top);
}

/// Texture coordinates of a strip over `width_m`.
struct StripUv {
  glm::vec2 foot, top;
};
StripUv strip_uv(synthesis::Trim trim, float width_m) {
  const glm::vec2 v = synthesis::trim_strip(trim);
  return {{0.0f, v.x}, {width_m / synthesis::trim_sheet_m, v.y}};
}

void add_ledge(CityMesh& mesh, const Frame& f, const Ornament& o) {
  const Box box{f, o.x_m, o.x_m + o.width_m, -o.reach_m, 0.0f, o.z_m, o.z_m + 0.22f};
  const StripUv uv = strip_uv(synthesis::Trim::slab, o.width_m);
  front(mesh, CityMaterial::trim, box, uv.foot, uv.top);
  underside(mesh, CityMaterial::trim, box, uv.foot, uv.top);
  lid(mesh, CityMaterial::trim, box, uv.foot, uv.top);
}

void add_balcony(CityMesh& mesh, const Frame& f, const Ornament& o) {
  const float x1 = o.x_m + o.width_m;
  const Box slab{f, o.x_m, x1, -o.reach_m, 0.0f, o.z_m - 0.16f, o.z_m};
  const StripUv edge = strip_uv(synthesis::Trim::slab, o.width_m),
                end = strip_uv(synthesis::Trim::slab, o.reach_m);
  const StripUv soffit = strip_uv(synthesis::Trim::soffit, o.width_m);
  front(mesh, CityMaterial::trim, slab, edge.foot, edge.top);
  left(mesh, CityMaterial::trim, slab, end.foot, end.top);
  right(mesh, CityMaterial::trim, slab, end.foot, end.top);
  underside(mesh, CityMaterial::trim, slab, soffit.foot, soffit.top);
  lid(mesh, CityMaterial::trim, slab, edge.foot, edge.top);
  const Box rail{f, o.x_m + 0.04f, x1 - 0.04f, 0.05f - o.reach_m, 0.0f, o.z_m, o.z_m + 1.0f};
  const glm::vec2 foot(0.0f, 1.0f), top(o.width_m / synthesis::railing_sheet_m, 0.0f),
      end_top(o.reach_m / synthesis::railing_sheet_m, 0.0f);
  front(mesh, CityMaterial::railing, rail, foot, top);
  left(mesh, CityMaterial::railing, rail, foot, end_top);
  right(mesh, CityMaterial::railing, rail, foot, end_top);
}

/// Sloping cloth with a hem that hangs down, and cheeks.
void add_awning(CityMesh& mesh, const Frame& f, const Ornament& o) {
  const float x0 = o.x_m, x1 = o.x_m + o.width_m, out = -o.reach_m, top = o.z_m + 0.75f, low = o.z_m + 0.2f;
  const glm::vec2 v =
      synthesis::trim_strip(o.variant % 2 == 0 ? synthesis::Trim::awning_red : synthesis::Trim::awning_green);
  const float u = o.width_m / synthesis::trim_sheet_m, hem = glm::mix(v.x, v.y, 0.2f);
  const CityMaterial m = CityMaterial::cloth;
  mesh.quad(m, f.point(x0, out, low), f.point(x1, out, low), f.point(x1, 0, top), f.point(x0, 0, top),
            {0, hem}, {u, v.y});
  mesh.quad(m, f.point(x0, out, o.z_m), f.point(x1, out, o.z_m), f.point(x1, out, low), f.point(x0, out, low),
            {0, v.x}, {u, hem});
  const glm::vec2 a(0.0f, hem), b(0.06f, hem), c(0.06f, v.y);
  mesh.triangle(m, {f.point(x0, 0, low), b}, {f.point(x0, out, low), a}, {f.point(x0, 0, top), c});
  mesh.triangle(m, {f.point(x1, out, low), a}, {f.point(x1, 0, low), b}, {f.point(x1, 0, top), c});
}

/// A board that stands out from the wall, seen from both sides.
void add_sign(CityMesh& mesh, const Frame& f, const Ornament& o) {
  const Box box{f, o.x_m, o.x_m, -o.reach_m, -0.12f, o.z_m, o.z_m + 0.8f};
  const glm::vec2 v = synthesis::trim_strip(o.variant % 3 == 0   ? synthesis::Trim::metal
                                            : o.variant % 3 == 1 ? synthesis::Trim::awning_red
                                                                 : synthesis::Trim::awning_green);
  const float first = 0.64f / synthesis::trim_sheet_m * float(o.variant % 7);
  right(mesh, CityMaterial::cloth, box, {first + 0.004f, glm::mix(v.x, v.y, 0.2f)},
        {first + 0.03f, glm::mix(v.x, v.y, 0.9f)});
}

/// Height of the roof above the pavement at a depth.
float roof_height(const Building& b, float depth_m) {
  const std::vector<glm::vec2> profile = roof_profile(b);
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const glm::vec2 p = profile[i], q = profile[i + 1];
    if (depth_m >= p.x && depth_m <= q.x && q.x > p.x)
      return glm::mix(p.y, q.y, (depth_m - p.x) / (q.x - p.x));
  }
  return profile.back().y;
}

/// How deep behind the facade the front slope reaches a height.
float depth_of_slope(const Building& b, float height_m) {
  const std::vector<glm::vec2> profile = roof_profile(b);
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const glm::vec2 p = profile[i], q = profile[i + 1];
    if (q.y > p.y && height_m <= q.y) return glm::mix(p.x, q.x, (height_m - p.y) / (q.y - p.y));
  }
  return profile[profile.size() - 2].x;
}

void add_dormer(CityMesh& mesh, const Building& b, const Frame& f, const Ornament& o) {
  const float x0 = o.x_m, x1 = o.x_m + o.width_m, low = o.z_m, high = o.z_m + o.reach_m;
  const float y = depth_of_slope(b, low), y_back = depth_of_slope(b, high + 0.25f);
  const glm::vec2 v = synthesis::trim_strip(synthesis::Trim::dormer);
  const float u = float(o.variant % 8) * synthesis::dormer_module_m / synthesis::trim_sheet_m,
              u1 = u + synthesis::dormer_module_m / synthesis::trim_sheet_m;
  mesh.quad(CityMaterial::trim, f.point(x0, y, low), f.point(x1, y, low), f.point(x1, y, high),
            f.point(x0, y, high), {u, v.x}, {u1, v.y});
  const glm::vec2 zinc(0.3f, 0.3f);
  const auto corner = [&](float px, float py, float pz) {
    return Corner{f.point(px, py, pz), zinc + glm::vec2(px, py + pz) / synthesis::roof_sheet_m};
  };
  const CityMaterial m = CityMaterial::roof_zinc;
  mesh.triangle(m, corner(x0, y_back, high + 0.25f), corner(x0, y, low), corner(x0, y, high));
  mesh.triangle(m, corner(x1, y, low), corner(x1, y_back, high + 0.25f), corner(x1, y, high));
  mesh.quad(m, corner(x0 - 0.12f, y - 0.18f, high - 0.02f), corner(x1 + 0.12f, y - 0.18f, high - 0.02f),
            corner(x1 + 0.12f, y_back, high + 0.25f), corner(x0 - 0.12f, y_back, high + 0.25f));
}

void add_chimney(CityMesh& mesh, const Building& b, const Frame& f, const Ornament& o) {
  const float depth = 0.5f * b.plot.depth_m + o.reach_m, half = 0.75f;
  const float foot = std::min(roof_height(b, depth - half), roof_height(b, depth + half)) - 0.1f;
  const Box box{f, o.x_m, o.x_m + o.width_m, depth - half, depth + half, foot, roof_height(b, depth) + 1.5f};
  const StripUv wide = strip_uv(synthesis::Trim::chimney, 2.0f * half),
                narrow = strip_uv(synthesis::Trim::chimney, o.width_m);
  front(mesh, CityMaterial::trim, box, narrow.foot, narrow.top);
  back(mesh, CityMaterial::trim, box, narrow.foot, narrow.top);
  left(mesh, CityMaterial::trim, box, wide.foot, wide.top);
  right(mesh, CityMaterial::trim, box, wide.foot, wide.top);
  const StripUv cap = strip_uv(synthesis::Trim::metal, o.width_m);
  lid(mesh, CityMaterial::trim, box, cap.foot, cap.top);
}

/// A lower building in the courtyard, against the back wall, under a lean-to roof.
void add_wing(CityMesh& mesh, const Building& b, const Frame& f, const Ornament& o) {
  const float x0 = o.x_m, x1 = o.x_m + o.width_m, y0 = b.plot.depth_m, y1 = y0 + o.reach_m;
  const float low = o.z_m - 1.2f, high = o.z_m;
  const float floors = std::max(1.0f, std::round(low / b.floor_m));
  const auto uv = [&](float width_m) {
    return glm::vec2(std::max(1.0f, std::round(width_m / facade_bay_m)) / float(facade_bays),
                     1.0f - floors / float(facade_floors));
  };
  const glm::vec2 foot(0.0f, 1.0f), side = uv(o.reach_m), end = uv(o.width_m);
  mesh.quad(b.wall(), f.point(x0, y1, 0), f.point(x0, y0, 0), f.point(x0, y0, high), f.point(x0, y1, high),
            foot, side);
  mesh.quad(b.wall(), f.point(x1, y0, 0), f.point(x1, y1, 0), f.point(x1, y1, low), f.point(x1, y0, low),
            foot, side);
  mesh.quad(b.wall(), {f.point(x1, y1, 0), foot}, {f.point(x0, y1, 0), {end.x, 1.0f}},
            {f.point(x0, y1, high), end}, {f.point(x1, y1, low), {0.0f, end.y}});
  const float slope = glm::length(glm::vec2(o.width_m, 1.2f)) / synthesis::roof_sheet_m,
              length = o.reach_m / synthesis::roof_sheet_m;
  mesh.quad(CityMaterial::roof_tile, f.point(x1, y0, low), f.point(x1, y1, low), f.point(x0, y1, high),
            f.point(x0, y0, high), {0.0f, 0.0f}, {length, -slope});
}

void suggest_on_face(const Building& b, int index, int face_index, float distance_m, Random& random,
                     std::vector<Ornament>& found) {
  const Face& face = b.faces[std::size_t(face_index)];
  const int middle_bay = face.bays / 2;
  const float bay_m = face.width_m / float(face.bays), near = distance_m / 100.0f;
  const auto suggest = [&](Kind kind, float x, float width, float z, float reach, float rank) {
    found.push_back({kind, index, face_index, x, width, z, reach, random.index(64),
                     rank - near + random.uniform(0, 0.5f)});
  };
  suggest(Kind::ledge, 0.0f, face.width_m, b.ground_m - 0.2f, 0.16f, 2.0f);
  if (b.has_shops && random.chance(0.6f) && face.width_m > 4.0f) {
    const int shops = std::max(1, int(std::lround(face.width_m / 5.12f)));
    const float module = face.width_m / float(shops);
    for (int i = 0; i < shops; ++i)
      if (random.chance(0.55f))
        suggest(Kind::awning, module * float(i) + 0.25f, module - 0.5f, 2.5f, 1.4f, 1.9f);
    suggest(Kind::sign, module * float(random.index(shops)) + 0.12f, 0.1f, 3.0f, 0.75f, 1.0f);
  }
  const bool may_have_balconies = face.bays >= 2 || b.plot.is_corner;
  if (may_have_balconies && random.chance(0.7f) && b.upper_floors > 1) {
    const int first = random.index(2), bays = std::max(1, face.bays - 2 * first);
    const float margin = 0.25f;
    for (int floor = 0; floor < b.upper_floors; ++floor) {
      const bool is_long = floor == 0 || floor == b.upper_floors - 1;
      if (!is_long && random.chance(0.6f)) continue;
      const float x = is_long ? bay_m * float(first) + margin : bay_m * float(middle_bay) + margin;
      const float width =
          (is_long ? bay_m * float(std::min(bays, face.bays - first)) : bay_m) - 2.0f * margin;
      suggest(Kind::balcony, x, width, b.ground_m + b.floor_m * float(floor) + 0.22f, is_long ? 0.85f : 0.7f,
              1.7f - 0.2f * float(floor));
    }
  }
  const float eaves = b.eaves_m() + b.cornice_m;
  if (b.roof == Roof::mansard && !b.plot.is_corner)
    for (int bay = 0; bay < face.bays; ++bay)
      suggest(Kind::dormer, bay_m * (float(bay) + 0.5f) - 0.65f, 1.3f, eaves + 0.5f, 1.45f, 1.9f);
  else if (b.roof == Roof::gable && random.chance(0.3f))
    suggest(Kind::dormer, bay_m * (float(middle_bay) + 0.5f) - 0.65f, 1.3f, eaves + 0.6f, 1.1f, 0.6f);
}

}  // namespace

std::size_t triangle_count(Kind kind) {
  switch (kind) {
    case Kind::ledge:
      return 6;
    case Kind::balcony:
      return 16;
    case Kind::awning:
      return 6;
    case Kind::sign:
      return 2;
    case Kind::dormer:
      return 6;
    case Kind::chimney:
      return 10;
    case Kind::wing:
      return 8;
  }
  return 0;
}

std::vector<Ornament> possible_ornaments(const Building& b, int index, float distance_m, Random& random) {
  std::vector<Ornament> found;
  for (int face = 0; face < int(b.faces.size()); ++face)
    suggest_on_face(b, index, face, distance_m, random, found);
  const float near = distance_m / 100.0f;
  if (b.plot.is_corner) return found;
  if (b.roof != Roof::set_back && random.chance(0.8f))
    found.push_back({Kind::chimney, index, 0, random.chance(0.5f) ? 0.1f : b.plot.width_m - 0.8f, 0.7f, 0.0f,
                     random.uniform(-1.5f, 1.5f), 0, 1.5f - 0.6f * near + random.uniform(0, 1.5f)});
  if (random.chance(0.7f)) {
    const float width = std::min(b.plot.width_m, random.uniform(5.0f, 8.0f));
    found.push_back({Kind::wing, index, 0, random.chance(0.5f) ? 0.0f : b.plot.width_m - width, width,
                     std::min(b.eaves_m() - 0.8f, random.uniform(5.0f, 11.0f)), random.uniform(7.0f, 16.0f),
                     0, 1.9f - 0.3f * near + random.uniform(0, 1.5f)});
  }
  return found;
}

void add_ornament(CityMesh& mesh, const Building& building, const Ornament& o) {
  const Frame& wall = building.faces[std::size_t(o.face)].frame;
  switch (o.kind) {
    case Kind::ledge:
      return add_ledge(mesh, wall, o);
    case Kind::balcony:
      return add_balcony(mesh, wall, o);
    case Kind::awning:
      return add_awning(mesh, wall, o);
    case Kind::sign:
      return add_sign(mesh, wall, o);
    case Kind::dormer:
      return add_dormer(mesh, building, wall, o);
    case Kind::chimney:
      return add_chimney(mesh, building, wall, o);
    case Kind::wing:
      return add_wing(mesh, building, wall, o);
  }
}

}  // namespace parvis::city
