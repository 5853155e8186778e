#include "places/paper_city/building.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "synthesis/shop_texture.h"
#include "synthesis/trim_texture.h"

namespace parvis::city {
namespace {

constexpr float corner_knee_inset_m = 1.1f;  // of a corner house's mansard, behind its walls

std::vector<Face> street_faces(const Plot& plot) {
  const auto face = [&](glm::vec3 start, glm::vec3 end) {
    const float width = glm::length(end - start);
    const glm::vec3 along = (end - start) / width;
    return Face{{start, along, {-along.y, along.x, 0.0f}}, width, modules_along(width, facade_bay_m)};
  };
  const Frame& f = plot.frame;
  const float w = plot.width_m, cut = corner_cut_m;
  if (!plot.is_corner) return {face(f.origin, f.point(w, 0, 0))};
  return {face(f.origin, f.point(w - cut, 0, 0)), face(f.point(w - cut, 0, 0), f.point(w, cut, 0)),
          face(f.point(w, cut, 0), f.point(w, plot.depth_m, 0))};
}

/// A wall between two points of a face, from `low` to `high` above the pavement.
void wall_quad(CityMesh& mesh, CityMaterial material, const Frame& f, float x0, float x1, float low,
               float high, glm::vec2 foot, glm::vec2 top) {
  mesh.quad(material, f.point(x0, 0, low), f.point(x1, 0, low), f.point(x1, 0, high), f.point(x0, 0, high),
            foot, top);
}

void add_facade(CityMesh& mesh, const Building& b, int face_index) {
  const Face& face = b.faces[std::size_t(face_index)];
  const int shops =
      (b.shop_strip + face_index) % synthesis::shop_strips;  // no two sides of a corner are alike
  const glm::vec2 strip = synthesis::ground_floor_strip(b.has_shops ? shops : synthesis::house_strip);
  const float first = float(b.module_offset + 2 * face_index) / float(synthesis::shop_modules);
  const float modules =
      float(modules_along(face.width_m, synthesis::shop_module_m)) / float(synthesis::shop_modules);
  wall_quad(mesh, CityMaterial::ground_floor, face.frame, 0, face.width_m, 0, b.ground_m, {first, strip.x},
            {first + modules, strip.y});
  const float left = float(b.bay_offset) / float(facade_bays);
  wall_quad(
      mesh, b.wall(), face.frame, 0, face.width_m, b.ground_m, b.eaves_m(), {left, 1.0f},
      {left + float(face.bays) / float(facade_bays), 1.0f - float(b.upper_floors) / float(facade_floors)});
}

/// A wall to the courtyard, with the windows of the upper floors all the way down.
void add_back_wall(CityMesh& mesh, const Building& b, glm::vec3 start, glm::vec3 end, float high) {
  const float width = glm::length(end - start);
  const glm::vec3 up(0, 0, high);
  mesh.quad(b.wall(), start, end, end + up, start + up, {0.0f, 1.0f},
            {float(modules_along(width, facade_bay_m)) / float(facade_bays),
             1.0f - float(b.upper_floors + 1) / float(facade_floors)});
}

Corner blank(const Frame& f, float x, float y, float z) {
  return {f.point(x, y, z), glm::vec2(y, -z) / synthesis::blank_wall_sheet_m};
}

/// The cornice of a face: its underside and front, mitred where faces meet (`left`, `right`: how far its ends
/// reach beyond the face, per metre of overhang).
void add_cornice(CityMesh& mesh, const Building& b, const Face& face, float left, float right) {
  const Frame& f = face.frame;
  const float out = -b.overhang_m, low = b.eaves_m(), high = low + b.cornice_m, w = face.width_m;
  const float x0 = left * out, x1 = w - right * out, u = w / synthesis::trim_sheet_m;
  const glm::vec2 soffit = synthesis::trim_strip(synthesis::Trim::soffit),
                  cornice = synthesis::trim_strip(synthesis::Trim::cornice);
  mesh.quad(CityMaterial::trim, {f.point(x0, out, low), {0, soffit.y}}, {f.point(0, 0, low), {0, soffit.x}},
            {f.point(w, 0, low), {u, soffit.x}}, {f.point(x1, out, low), {u, soffit.y}});
  mesh.quad(CityMaterial::trim, f.point(x0, out, low), f.point(x1, out, low), f.point(x1, out, high),
            f.point(x0, out, high), {0, cornice.x}, {u, cornice.y});
}

/// Texture coordinates of roofs: courses run along the eaves, `up_m` is measured on the slope.
Corner roof_corner(glm::vec3 position, float along_m, float up_m) {
  return {position, glm::vec2(along_m, -up_m) / synthesis::roof_sheet_m};
}

void add_row_roof(CityMesh& mesh, const Building& b) {
  const Frame& f = b.plot.frame;
  const std::vector<glm::vec2> profile = roof_profile(b);
  float up_m = 0.0f;
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const glm::vec2 p = profile[i], q = profile[i + 1];
    const float length = glm::length(q - p), w = b.plot.width_m;
    const bool is_wall = b.roof == Roof::set_back && i == 1;
    if (is_wall) {
      mesh.quad(b.wall(), f.point(0, p.x, p.y), f.point(w, p.x, p.y), f.point(w, q.x, q.y),
                f.point(0, q.x, q.y), {0.0f, 1.0f},
                {float(b.faces[0].bays) / float(facade_bays), 1.0f - 0.92f / float(facade_floors)});
    } else {
      mesh.quad(b.roof_material, roof_corner(f.point(0, p.x, p.y), 0, up_m),
                roof_corner(f.point(w, p.x, p.y), w, up_m),
                roof_corner(f.point(w, q.x, q.y), w, up_m + length),
                roof_corner(f.point(0, q.x, q.y), 0, up_m + length));
    }
    up_m += length;
  }
}

/// The side at `x`: the wall above the neighbour's eaves, and what the roof's profile encloses.
void add_side(CityMesh& mesh, const Building& b, float x, bool faces_right, float neighbour_m) {
  const Frame& f = b.plot.frame;
  const float eaves = b.eaves_m(), depth = b.plot.depth_m;
  const auto corner = [&](glm::vec2 p) { return blank(f, x, p.x, p.y); };
  const auto triangle = [&](glm::vec2 p, glm::vec2 q, glm::vec2 r) {
    const Corner a = corner(p), c = corner(q), d = corner(r);
    faces_right ? mesh.triangle(CityMaterial::blank_wall, a, c, d)
                : mesh.triangle(CityMaterial::blank_wall, a, d, c);
  };
  if (neighbour_m < eaves - 0.01f) {
    triangle({0, neighbour_m}, {depth, neighbour_m}, {depth, eaves});
    triangle({0, neighbour_m}, {depth, eaves}, {0, eaves});
  }
  const glm::vec2 edge(-b.overhang_m, eaves), back(depth, eaves);
  const std::vector<glm::vec2> profile = roof_profile(b);
  if (b.roof != Roof::set_back) {  // a fan round the foot of the cornice: the profile is convex
    for (std::size_t i = profile.size() - 1; i > 0; --i) triangle(edge, profile[i], profile[i - 1]);
    return;
  }
  const glm::vec2 rail = profile[0], foot = profile[1], top = profile[2], end = profile[3],
                  back_foot(depth, foot.y);
  triangle(edge, back, back_foot), triangle(edge, back_foot, rail);
  triangle(foot, back_foot, end), triangle(foot, end, top);
}

void add_row_house(CityMesh& mesh, const Building& b, float left_eaves_m, float right_eaves_m) {
  const Frame& f = b.plot.frame;
  add_facade(mesh, b, 0);
  add_cornice(mesh, b, b.faces[0], 0.0f, 0.0f);
  add_row_roof(mesh, b);
  add_side(mesh, b, 0.0f, false, left_eaves_m);
  add_side(mesh, b, b.plot.width_m, true, right_eaves_m);
  add_back_wall(mesh, b, f.point(b.plot.width_m, b.plot.depth_m, 0), f.point(0, b.plot.depth_m, 0),
                roof_profile(b).back().y);
}

/// The five corners of a corner house at a height, moved inward (or outward, if negative) by `inset_m`.
std::array<glm::vec3, 5> corner_outline(const Building& b, float inset_m, float z) {
  const float w = b.plot.width_m, d = b.plot.depth_m, i = inset_m;
  const float cut = corner_cut_m + (std::sqrt(2.0f) - 1.0f) * i;  // the cut keeps its angle
  const float out = std::max(i, 0.0f);                            // party walls do not move outward
  const Frame& f = b.plot.frame;
  return {f.point(out, i, z), f.point(w - cut, i, z), f.point(w - i, cut, z), f.point(w - i, d - out, z),
          f.point(out, d - out, z)};
}

/// A gabled window in the roof over the cut corner.
void add_corner_dormer(CityMesh& mesh, const Building& b) {
  const Frame& f = b.faces[1].frame;
  const float eaves = b.eaves_m() + b.cornice_m, low = eaves + 0.35f, high = low + 1.5f, peak = high + 0.5f;
  const float middle = 0.5f * b.faces[1].width_m, x0 = middle - 0.8f, x1 = middle + 0.8f;
  const auto depth_at = [&](float z) {  // of the roof's slope
    return glm::mix(-b.overhang_m, corner_knee_inset_m, (z - eaves) / b.roof_rise_m);
  };
  const float y = depth_at(low), y_high = depth_at(high), y_peak = depth_at(peak);
  const glm::vec2 v = synthesis::trim_strip(synthesis::Trim::dormer);
  const float u = synthesis::dormer_module_m / synthesis::trim_sheet_m;
  mesh.quad(CityMaterial::trim, f.point(x0, y, low), f.point(x1, y, low), f.point(x1, y, high),
            f.point(x0, y, high), {0.0f, v.x}, {u, v.y});
  const glm::vec2 stone = synthesis::trim_strip(synthesis::Trim::slab);
  mesh.triangle(CityMaterial::trim, {f.point(x0, y, high), {0, stone.x}},
                {f.point(x1, y, high), {u, stone.x}}, {f.point(middle, y, peak), {0.5f * u, stone.y}});
  const CityMaterial zinc = CityMaterial::roof_zinc;
  const auto corner = [&](float px, float py, float pz) {
    return roof_corner(f.point(px, py, pz), py, pz - low);
  };
  mesh.triangle(zinc, corner(x0, y_high, high), corner(x0, y, low), corner(x0, y, high));
  mesh.triangle(zinc, corner(x1, y, low), corner(x1, y_high, high), corner(x1, y, high));
  mesh.quad(zinc, corner(x0, y, high), corner(middle, y, peak), corner(middle, y_peak, peak),
            corner(x0, y_high, high));
  mesh.quad(zinc, corner(middle, y, peak), corner(x1, y, high), corner(x1, y_high, high),
            corner(middle, y_peak, peak));
}

/// A mansard round the corner under a low pyramid.
void add_corner_roof(CityMesh& mesh, const Building& b) {
  const float eaves = b.eaves_m() + b.cornice_m, knee = eaves + b.roof_rise_m;
  const auto low = corner_outline(b, -b.overhang_m, eaves),
             high = corner_outline(b, corner_knee_inset_m, knee);
  const glm::vec3 apex = b.plot.frame.point(0.5f * b.plot.width_m, 0.5f * b.plot.depth_m, knee + 1.4f);
  for (std::size_t i = 0; i < 5; ++i) {
    const std::size_t j = (i + 1) % 5;
    const float w = glm::length(low[j] - low[i]), slope = b.roof_rise_m * 1.1f;
    mesh.quad(b.roof_material, roof_corner(low[i], 0, 0), roof_corner(low[j], w, 0),
              roof_corner(high[j], w - 1, slope), roof_corner(high[i], 1, slope));
    mesh.triangle(CityMaterial::roof_zinc, roof_corner(high[i], 0, 0), roof_corner(high[j], w, 0),
                  roof_corner(apex, 0.5f * w, 6.0f));
  }
  add_corner_dormer(mesh, b);
}

void add_corner_house(CityMesh& mesh, const Building& b) {
  const Frame& f = b.plot.frame;
  const float w = b.plot.width_m, d = b.plot.depth_m, mitre = std::tan(0.125f * 3.14159265f);
  for (int face = 0; face < int(b.faces.size()); ++face) add_facade(mesh, b, face);
  add_cornice(mesh, b, b.faces[0], 0.0f, mitre);
  add_cornice(mesh, b, b.faces[1], mitre, mitre);
  add_cornice(mesh, b, b.faces[2], mitre, 0.0f);
  add_back_wall(mesh, b, f.point(w, d, 0), f.point(0, d, 0), b.eaves_m() + b.cornice_m);
  add_back_wall(mesh, b, f.point(0, d, 0), f.point(0, 0, 0), b.eaves_m() + b.cornice_m);
}

Roof choose_roof(Random& random) {
  const float kind = random.uniform();
  return kind < 0.5f ? Roof::gable : kind < 0.88f ? Roof::mansard : Roof::set_back;
}

}  // namespace

int modules_along(float length_m, float module_m) {
  return std::max(1, int(std::lround(length_m / module_m)));
}

std::vector<glm::vec2> roof_profile(const Building& b) {
  const float eaves = b.eaves_m(), edge = eaves + b.cornice_m, depth = b.plot.depth_m, rise = b.roof_rise_m;
  switch (b.roof) {
    case Roof::gable:
      return {{-b.overhang_m, edge}, {0.5f * depth, edge + rise}, {depth, eaves}};
    case Roof::mansard:
      return {{-b.overhang_m, edge}, {0.9f, edge + rise}, {0.5f * depth, edge + rise + 1.0f}, {depth, eaves}};
    case Roof::set_back:
      break;
  }
  return {{-b.overhang_m, edge}, {2.0f, edge}, {2.0f, edge + 3.1f}, {depth, edge + 2.7f}};
}

Building plan_building(const Plot& plot, const Building* neighbour, float distance_to_centre_m,
                       Random& random) {
  Building b;
  b.plot = plot;
  do {
    b.style = random.index(facade_style_count);
  } while (neighbour && neighbour->style == b.style);
  b.tint = random.index(wall_tints);
  const bool is_central = distance_to_centre_m < 300.0f;
  b.upper_floors = (is_central ? 3 : 2) + random.index(3) + (plot.is_corner && is_central ? 1 : 0);
  b.upper_floors = std::min(b.upper_floors, 5);
  b.ground_m = random.uniform(4.2f, 4.8f), b.floor_m = random.uniform(3.2f, 3.55f);
  b.has_shops = random.chance(plot.is_corner ? 0.95f : is_central ? 0.72f : 0.4f);
  b.shop_strip = neighbour ? (neighbour->shop_strip + 1 + random.index(synthesis::shop_strips - 1)) %
                                 synthesis::shop_strips
                           : random.index(synthesis::shop_strips);
  b.module_offset = random.index(synthesis::shop_modules), b.bay_offset = random.index(facade_bays);
  b.roof = plot.is_corner ? Roof::mansard : choose_roof(random);
  b.cornice_m = random.uniform(0.4f, 0.65f), b.overhang_m = random.uniform(0.4f, 0.6f);
  b.roof_rise_m = b.roof == Roof::gable ? random.uniform(2.0f, 3.2f) : random.uniform(2.6f, 3.3f);
  b.roof_material = b.roof == Roof::gable ? CityMaterial::roof_tile
                    : random.chance(0.6f) ? CityMaterial::roof_slate
                                          : CityMaterial::roof_zinc;
  if (b.roof == Roof::set_back) b.roof_material = CityMaterial::roof_zinc;
  b.faces = street_faces(plot);
  return b;
}

void add_building(CityMesh& mesh, const Building& building, float left_eaves_m, float right_eaves_m) {
  if (!building.plot.is_corner) return add_row_house(mesh, building, left_eaves_m, right_eaves_m);
  add_corner_house(mesh, building);
  add_corner_roof(mesh, building);
}

}  // namespace parvis::city
