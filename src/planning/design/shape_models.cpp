#include "planning/design/shape_models.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <tuple>

#include "base/colour.h"
#include "places/paper_city/night_lights.h"
#include "synthesis/ground_texture.h"
#include "synthesis/round_mesh.h"

namespace parvis::design {
namespace {

using glm::vec3;
using synthesis::panelled_box, synthesis::smooth, synthesis::tube, synthesis::turned;

constexpr float whole = 10.0f;  // of panels: one square

scene::Material plain(const char* name, vec3 colour, float roughness, float metallic = 0.0f) {
  scene::Material material;
  material.name = name, material.base_colour = colour, material.roughness = roughness,
  material.metallic = metallic;
  return material;
}

scene::Material cast_iron() { return plain("cast iron", linear_from_srgb8(0x2C, 0x31, 0x30), 0.5f); }

/// The main part's material: as asked for, or else as the shape has it.
scene::Material main_material(const ShapeRequest& request, const char* own) {
  const std::string& name = request.material.empty() ? std::string(own) : request.material;
  if (name == "wood") return plain("wood", request.colour, 0.7f);
  if (name == "metal") return plain("metal", request.colour, 0.35f, 0.8f);
  if (name == "concrete") return plain("concrete", request.colour, 0.9f);
  if (name == "lacquer") {
    scene::Material lacquer = plain("lacquer", request.colour, 0.45f);
    lacquer.clear_coat = 0.6f;
    return lacquer;
  }
  return plain("stone", request.colour, 0.8f);
}

void add(scene::Model& model, const char* object, Mesh mesh, scene::Material material) {
  scene::Part part;
  part.object = object, part.mesh = std::move(mesh), part.material = int(model.materials.size());
  model.parts.push_back(std::move(part));
  model.materials.push_back(std::move(material));
}

Mesh box(vec3 low, vec3 high) { return panelled_box(low, high, whole); }

/// Stretched along its axes.
Mesh stretched(Mesh mesh, vec3 by) {
  for (vec3& position : mesh.positions) position *= by;
  for (vec3& normal : mesh.normals) normal = glm::normalize(normal / by);
  return mesh;
}

/// Upright posts at the corners of a rectangle, `inset` from its sides.
Mesh corner_posts(vec3 size, float inset, float radius) {
  Mesh posts;
  const glm::vec2 reach = 0.5f * glm::vec2(size) - inset;
  for (const float x : {-reach.x, reach.x})
    for (const float y : {-reach.y, reach.y})
      append(posts, tube({{{x, y, 0.0f}, radius}, {{x, y, size.z}, radius}}));
  return posts;
}

/// Slats on frames of cast iron, one for each metre and a half; its back is away from its front.
scene::Model bench_wood(const ShapeRequest& request) {
  const float half = 0.5f * request.size_m.x, up = request.size_m.z / 0.95f, deep = request.size_m.y / 0.65f;
  Mesh slats, frames;
  for (int i = 0; i < 4; ++i) {
    const float y = 0.24f - 0.12f * float(i);
    append(slats, box({-half, y - 0.095f, 0.43f}, {half, y, 0.465f}));
  }
  for (int i = 0; i < 3; ++i) {
    const float z = 0.55f + 0.13f * float(i), y = -0.26f - 0.04f * float(i);
    append(slats, box({-half, y - 0.03f, z}, {half, y, z + 0.095f}));
  }
  const int count = std::max(2, int(std::ceil(request.size_m.x / 1.5f)) + 1);
  for (int i = 0; i < count; ++i) {
    const float reach = std::max(half - 0.22f, 0.1f), x = -reach + 2.0f * reach * float(i) / float(count - 1);
    append(frames, tube({{{x, 0.24f, 0.0f}, 0.03f}, {{x, 0.2f, 0.42f}, 0.025f}}));
    append(frames,
           tube({{{x, -0.3f, 0.0f}, 0.03f}, {{x, -0.25f, 0.42f}, 0.028f}, {{x, -0.37f, 0.95f}, 0.02f}}));
    append(frames, tube({{{x, 0.22f, 0.41f}, 0.022f}, {{x, -0.25f, 0.41f}, 0.022f}}));
  }
  scene::Model model;
  add(model, "slats", stretched(std::move(slats), {1.0f, deep, up}), main_material(request, "wood"));
  add(model, "frame", stretched(std::move(frames), {1.0f, deep, up}), cast_iron());
  return model;
}

/// A slab on two feet that stand back from its edges.
scene::Model bench_stone(const ShapeRequest& request) {
  const vec3 half = 0.5f * request.size_m;
  const float height = request.size_m.z, slab = std::min(0.14f, 0.4f * height);
  Mesh stone = box({-half.x, -half.y, height - slab}, {half.x, half.y, height});
  const float foot = std::min(0.3f, 0.25f * request.size_m.x), in = std::min(0.18f, 0.15f * request.size_m.x);
  for (const float side : {-1.0f, 1.0f}) {
    const float a = side * (half.x - in), b = side * (half.x - in - foot);
    append(stone,
           box({std::min(a, b), -0.8f * half.y, 0.0f}, {std::max(a, b), 0.8f * half.y, height - slab}));
  }
  scene::Model model;
  add(model, "stone", std::move(stone), main_material(request, "stone"));
  return model;
}

scene::Model table(const ShapeRequest& request) {
  const vec3 size = request.size_m, half = 0.5f * size;
  scene::Model model;
  add(model, "top", box({-half.x, -half.y, size.z - 0.04f}, {half.x, half.y, size.z}),
      main_material(request, "wood"));
  add(model, "legs", corner_posts({size.x, size.y, size.z - 0.04f}, 0.08f, 0.025f), cast_iron());
  return model;
}

/// Eight ribs of cloth over a pole, with a short valance.
scene::Model umbrella(const ShapeRequest& request) {
  const float radius = 0.5f * request.size_m.x, top = request.size_m.z, rim = top - 0.32f * radius;
  constexpr int ribs = 8;
  scene::Material cloth = main_material(request, "wood");
  cloth.name = "cloth", cloth.is_double_sided = true, cloth.translucency = 0.25f, cloth.roughness = 0.9f;
  const float depth = request.size_m.y / request.size_m.x;
  Mesh canopy = turned(
      {{radius, rim - 0.18f}, {radius, rim}, {0.55f * radius, rim + 0.21f * radius}, {0.03f, top}}, ribs);
  Mesh pole = turned({{0.025f, 0.06f}, {0.025f, top - 0.02f}, {0.04f, top}, {0.005f, top + 0.06f}}, 12);
  append(pole, turned({{0.32f, 0.0f}, {0.32f, 0.05f}, {0.05f, 0.07f}, {0.03f, 0.3f}}, 24));
  scene::Model model;
  add(model, "canopy", stretched(std::move(canopy), {1.0f, depth, 1.0f}), std::move(cloth));
  add(model, "pole", std::move(pole), plain("varnished wood", linear_from_srgb8(0x8A, 0x6B, 0x4F), 0.5f));
  return model;
}

/// A closed stand with a counter on its front and a pyramid of zinc above.
scene::Model kiosk(const ShapeRequest& request) {
  const vec3 size = request.size_m, half = 0.5f * size - vec3(0.15f, 0.15f, 0.0f);
  const float eaves = 0.78f * size.z;
  Mesh body = box({-half.x, -half.y, 0.0f}, {half.x, half.y, 1.0f}), upper, dark;
  for (const float side : {-1.0f, 1.0f})
    append(upper, box({side > 0 ? half.x - 0.12f : -half.x, -half.y, 1.0f},
                      {side > 0 ? half.x : -half.x + 0.12f, half.y, eaves}));
  append(upper, box({-half.x, -half.y, 1.0f}, {half.x, -half.y + 0.12f, eaves}));
  append(upper, box({-half.x, half.y - 0.12f, eaves - 0.35f}, {half.x, half.y, eaves}));
  append(dark, box({-half.x + 0.12f, -half.y + 0.12f, 1.0f}, {half.x - 0.12f, 0.2f * half.y, eaves}));
  append(body, box({-half.x - 0.05f, half.y - 0.1f, 1.0f}, {half.x + 0.05f, half.y + 0.2f, 1.05f}));
  append(body, std::move(upper));
  // A square turned on a lathe stands on its corner: its radius reaches to the eaves' corners.
  Mesh roof = turned({{0.5f, eaves - 0.06f}, {0.5f, eaves}, {0.12f, 0.93f * size.z}, {0.02f, size.z}}, 4);
  const glm::mat4 turn = glm::rotate(glm::mat4(1.0f), glm::radians(45.0f), vec3(0, 0, 1));
  Mesh square;
  append(square, roof, turn);
  scene::Model model;
  add(model, "body", std::move(body), main_material(request, "lacquer"));
  add(model, "inside", std::move(dark), plain("inside", vec3(0.05f), 0.9f));
  add(model, "roof", stretched(std::move(square), {std::sqrt(2.0f) * size.x, std::sqrt(2.0f) * size.y, 1.0f}),
      plain("zinc", linear_from_srgb8(0x7C, 0x85, 0x8C), 0.4f, 0.7f));
  return model;
}

/// Posts, a roof, panes at its back and a bench.
scene::Model stop(const ShapeRequest& request) {
  const vec3 size = request.size_m, half = 0.5f * size;
  const int bays = std::max(1, int(std::round(size.x / 1.5f)));
  Mesh frame, panes, seat;
  for (int i = 0; i <= bays; ++i) {
    const float x = -half.x + 0.1f + (size.x - 0.2f) * float(i) / float(bays), y = -half.y + 0.15f;
    append(frame, box({x - 0.04f, y - 0.04f, 0.0f}, {x + 0.04f, y + 0.04f, size.z - 0.15f}));
    if (i == bays) break;
    const float next = x + (size.x - 0.2f) / float(bays);
    append(panes, box({x + 0.05f, y - 0.006f, 0.25f}, {next - 0.05f, y + 0.006f, size.z - 0.3f}));
  }
  append(frame, box({-half.x, -half.y, size.z - 0.15f}, {half.x, half.y, size.z}));
  append(seat, box({-0.35f * size.x, -half.y + 0.3f, 0.42f}, {0.35f * size.x, -half.y + 0.68f, 0.46f}));
  scene::Material glass = plain("glass", vec3(0.03f, 0.04f, 0.04f), 0.05f);
  glass.alpha = 0.25f, glass.alpha_mode = scene::Alpha::blend, glass.is_double_sided = true;
  scene::Model model;
  add(model, "frame", std::move(frame), main_material(request, "metal"));
  add(model, "seat", std::move(seat), plain("seat", linear_from_srgb8(0x8E, 0x69, 0x45), 0.7f));
  add(model, "panes", std::move(panes), std::move(glass));
  model.parts.back().casts_shadow = false;
  return model;
}

/// Four sides of `wall` thickness about a bed that is filled to `soil` below the rim.
scene::Model bordered(const ShapeRequest& request, const char* own, float wall, float soil) {
  const vec3 size = request.size_m, half = 0.5f * size;
  wall = std::min(wall, 0.3f * std::min(size.x, size.y));
  Mesh sides = box({-half.x, -half.y, 0.0f}, {half.x, -half.y + wall, size.z});
  append(sides, box({-half.x, half.y - wall, 0.0f}, {half.x, half.y, size.z}));
  append(sides, box({-half.x, -half.y + wall, 0.0f}, {-half.x + wall, half.y - wall, size.z}));
  append(sides, box({half.x - wall, -half.y + wall, 0.0f}, {half.x, half.y - wall, size.z}));
  const float bed = size.z - std::min(soil, 0.6f * size.z);
  scene::Model model;
  add(model, "sides", std::move(sides), main_material(request, own));
  add(model, "soil", box({-half.x + wall, -half.y + wall, 0.0f}, {half.x - wall, half.y - wall, bed}),
      plain("soil", linear_from_srgb8(0x4A, 0x3A, 0x2C), 0.95f));
  return model;
}

scene::Model grass_square(const ShapeRequest& request) { return bordered(request, "stone", 0.12f, 0.04f); }
scene::Model planter(const ShapeRequest& request) { return bordered(request, "concrete", 0.08f, 0.08f); }

/// The street lamp of the paper's city, at another height; its lantern stays as large.
scene::Model lamp(const ShapeRequest& request) {
  scene::Model model = city::make_street_lamp();
  const float height = bounds(model).max.z;
  for (scene::Part& part : model.parts)
    for (vec3& position : part.mesh.positions)
      position.z = position.z > 0.7f * height
                       ? position.z + request.size_m.z - height
                       : position.z * (request.size_m.z - 0.3f * height) / (0.7f * height);
  return model;
}

scene::Model bollard(const ShapeRequest& request) {
  const vec3 by(request.size_m.x / 0.2f, request.size_m.y / 0.2f, request.size_m.z / 0.96f);
  Mesh mesh = turned(smooth({{0.1f, 0.0f},
                             {0.085f, 0.1f},
                             {0.06f, 0.2f},
                             {0.055f, 0.7f},
                             {0.07f, 0.78f},
                             {0.07f, 0.84f},
                             {0.045f, 0.92f},
                             {0.005f, 0.96f}},
                            3),
                     16);
  scene::Model model;
  scene::Material iron = main_material(request, "lacquer");
  iron.name = "cast iron";
  add(model, "bollard", stretched(std::move(mesh), by), std::move(iron));
  return model;
}

scene::Model bin(const ShapeRequest& request) {
  const vec3 by(request.size_m.x / 0.52f, request.size_m.y / 0.52f, request.size_m.z / 1.12f);
  Mesh shell = turned(
      {{0.21f, 0.08f}, {0.24f, 0.12f}, {0.25f, 0.78f}, {0.26f, 0.8f}, {0.25f, 0.83f}, {0.21f, 0.84f}}, 24);
  Mesh iron = turned({{0.23f, 0.98f}, {0.25f, 1.0f}, {0.2f, 1.08f}, {0.02f, 1.12f}}, 24);
  append(iron, turned({{0.24f, 0.0f}, {0.24f, 0.08f}, {0.1f, 0.1f}}, 24));
  append(iron, turned({{0.21f, 0.84f}, {0.2f, 0.6f}, {0.02f, 0.58f}}, 24));
  for (const float x : {-0.2f, 0.2f})
    append(iron, tube({{{x, 0.0f, 0.8f}, 0.015f}, {{x, 0.0f, 1.0f}, 0.015f}}));
  scene::Model model;
  add(model, "shell", stretched(std::move(shell), by), main_material(request, "lacquer"));
  add(model, "iron", stretched(std::move(iron), by), cast_iron());
  return model;
}

/// A hoop of steel tube.
scene::Model bicycle_stand(const ShapeRequest& request) {
  const float half = 0.5f * request.size_m.x - 0.025f, height = request.size_m.z - 0.025f,
              round = 0.5f * half;
  std::vector<synthesis::TubeRing> rings{{{-half, 0.0f, 0.0f}, 0.024f}};
  constexpr int steps = 6;
  for (const float side : {-1.0f, 1.0f})
    for (int i = 0; i <= steps; ++i) {
      const float turn = glm::half_pi<float>() * float(side < 0 ? i : steps - i) / float(steps);
      rings.push_back(
          {{side * (half - round + round * std::cos(turn)), 0.0f, height - round + round * std::sin(turn)},
           0.024f});
    }
  rings.push_back({{half, 0.0f, 0.0f}, 0.024f});
  scene::Model model;
  add(model, "hoop", tube(rings), main_material(request, "metal"));
  return model;
}

const std::map<std::string, scene::Model (*)(const ShapeRequest&)>& makers() {
  static const std::map<std::string, scene::Model (*)(const ShapeRequest&)> all{
      {"bench_wood", bench_wood},
      {"bench_stone", bench_stone},
      {"table", table},
      {"umbrella", umbrella},
      {"kiosk", kiosk},
      {"stop", stop},
      {"planter", planter},
      {"grass_square", grass_square},
      {"lamp", lamp},
      {"bollard", bollard},
      {"bin", bin},
      {"bicycle_stand", bicycle_stand}};
  return all;
}

float cross(glm::vec2 a, glm::vec2 b) { return a.x * b.y - a.y * b.x; }

/// Ears are cut off one after another (Meisters 1975): corners at which the polygon turns left and whose
/// triangle holds no other corner.
std::vector<std::uint32_t> triangles_of(const std::vector<glm::vec3>& outline) {
  std::vector<std::uint32_t> left(outline.size()), triangles;
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = std::uint32_t(i);
  float area = 0.0f;
  for (std::size_t i = 0; i < outline.size(); ++i)
    area += cross(glm::vec2(outline[i]), glm::vec2(outline[(i + 1) % outline.size()]));
  if (area < 0.0f) std::ranges::reverse(left);
  const auto at = [&](std::size_t i) { return glm::vec2(outline[left[i % left.size()]]); };
  const auto is_ear = [&](std::size_t i) {
    const glm::vec2 a = at(i), b = at(i + 1), c = at(i + 2);
    if (cross(b - a, c - b) <= 0.0f) return false;
    for (std::size_t k = 3; k < left.size(); ++k) {
      const glm::vec2 p = at(i + k);
      if (cross(b - a, p - a) >= 0.0f && cross(c - b, p - b) >= 0.0f && cross(a - c, p - c) >= 0.0f)
        return false;
    }
    return true;
  };
  while (left.size() >= 3) {
    std::size_t ear = 0;
    while (ear < left.size() && !is_ear(ear)) ++ear;
    if (ear == left.size()) break;  // what is left has no area, or crosses itself
    const std::size_t n = left.size();
    triangles.insert(triangles.end(), {left[ear % n], left[(ear + 1) % n], left[(ear + 2) % n]});
    left.erase(left.begin() + std::ptrdiff_t((ear + 1) % n));
  }
  return triangles;
}

struct Sheet {
  const char* name;
  float side_m;
  synthesis::SurfacePictures (*paint)(std::uint32_t seed);
};
constexpr Sheet sheets[]{{"paving", synthesis::paving_sheet_m, synthesis::paving_pictures},
                         {"asphalt", synthesis::asphalt_sheet_m, synthesis::asphalt_pictures},
                         {"gravel", synthesis::gravel_sheet_m, synthesis::gravel_pictures},
                         {"lawn", synthesis::lawn_sheet_m, synthesis::lawn_pictures}};

/// Painted once; models share the pictures' content, not their memory.
const synthesis::SurfacePictures& pictures_of(const Sheet& sheet) {
  static std::map<std::string, synthesis::SurfacePictures> painted;
  const auto [pictures, is_new] = painted.try_emplace(sheet.name);
  if (is_new) pictures->second = sheet.paint(11);
  return pictures->second;
}

}  // namespace

double exact_decimal(float value) { return std::strtod(fmt::format("{}", value).c_str(), nullptr); }

glm::dvec3 exact_decimals(glm::vec3 value) {
  return {exact_decimal(value.x), exact_decimal(value.y), exact_decimal(value.z)};
}

const std::vector<std::string>& shape_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const auto& [name, make] : makers()) all.push_back(name);
    return all;
  }();
  return names;
}

const std::vector<std::string>& material_names() {
  static const std::vector<std::string> names{"stone", "concrete", "wood", "metal", "lacquer"};
  return names;
}

const std::vector<std::string>& surface_names() {
  static const std::vector<std::string> names{"paving", "asphalt", "gravel", "lawn", "plain"};
  return names;
}

scene::Model shape_model(const std::string& shape, const ShapeRequest& request) {
  const auto maker = makers().find(shape);
  assert(maker != makers().end() && "the schema lets only known shapes through");
  return maker->second(request);
}

scene::Model surface_model(const std::vector<glm::vec3>& outline, const std::string& material,
                           glm::vec3 colour) {
  constexpr float lift_m = 0.02f;  // above what it lies on
  scene::Model model;
  Mesh mesh;
  mesh.indices = triangles_of(outline);
  if (mesh.indices.empty()) return model;
  const auto sheet =
      std::ranges::find(sheets, material, [](const Sheet& each) { return std::string(each.name); });
  const float side_m = sheet == std::end(sheets) ? 1.0f : sheet->side_m;
  for (const vec3 corner : outline) {
    mesh.positions.push_back(corner + vec3(0.0f, 0.0f, lift_m));
    mesh.uvs.push_back(glm::vec2(corner.x, -corner.y) / side_m);
  }
  fill_normals(mesh);
  scene::Material surface = plain(material.c_str(), colour, 0.9f);
  if (sheet != std::end(sheets)) {
    const synthesis::SurfacePictures& pictures = pictures_of(*sheet);
    for (const auto& [name, image, is_srgb] : {std::tuple(material, &pictures.colour, true),
                                               std::tuple(material + " normals", &pictures.normal, false),
                                               std::tuple(material + " surface", &pictures.surface, false)}) {
      scene::Texture& texture = model.textures.emplace_back();
      texture.name = name, texture.image = *image, texture.is_srgb = is_srgb;
    }
    surface.base_colour_texture = 0, surface.normal_texture = 1, surface.surface_texture = 2;
    surface.roughness = 1.0f, surface.metallic = 1.0f;
  }
  add(model, "surface", std::move(mesh), std::move(surface));
  model.parts.back().casts_shadow = false;
  return model;
}

}  // namespace parvis::design
