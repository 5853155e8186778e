#include "places/square/coarse_square.h"

#include <fmt/format.h>

#include <cmath>

#include "places/square/layout.h"
#include "synthesis/round_mesh.h"

namespace parvis::square {
namespace {

constexpr float lintel_m = 4.2f;      // above it an arcade counts as a wall
constexpr float pier_half_m = 0.62f;  // as built
constexpr float whole = 1000.0f;      // of panels: one square
constexpr float near_m = 95.0f;       // houses farther from the middle are seen too small

void add(scene::Model& model, const std::string& name, Mesh mesh) {
  scene::Part part;
  part.object = name, part.mesh = std::move(mesh), part.material = 0;
  part.node = int(model.nodes.size());
  scene::ModelNode node;
  node.name = name, node.parent = 0;
  model.nodes.push_back(std::move(node));
  model.parts.push_back(std::move(part));
}

/// An upright rectangle of a house's front, at depth y.
Mesh front(const Building& h, float x0, float x1, float z0, float z1, float y = 0.0f) {
  return synthesis::panel(h.frame.point(x0, y, z0), (x1 - x0) * h.frame.along, {0, 0, z1 - z0}, whole);
}

void add_house(scene::Model& model, const Building& h, int number) {
  const std::string name = fmt::format("house_{}", number);
  const float eaves = h.style.eaves_m() - 0.9f;  // there the cornice begins
  const bool is_arcade = h.style.ground == GroundFloor::arcade;
  add(model, name + "_front", front(h, 0.0f, h.width_m, is_arcade ? lintel_m : 0.0f, eaves));
  if (is_arcade) {
    const float bay = h.width_m / float(h.bays);
    Mesh piers;
    for (int i = 0; i <= h.bays; ++i) {
      const float x = bay * float(i);
      append(piers,
             front(h, std::max(x - pier_half_m, 0.0f), std::min(x + pier_half_m, h.width_m), 0.0f, lintel_m));
    }
    add(model, name + "_piers", std::move(piers));
    add(model, name + "_gallery", front(h, 0.0f, h.width_m, 0.0f, 5.3f, gallery_m));
  }
  const Frame& f = h.frame;
  if (h.has_left_front)
    add(model, name + "_left",
        synthesis::panel(f.point(0, h.depth_m, 0), -h.depth_m * f.inward, {0, 0, eaves}, whole));
  if (h.has_right_front)
    add(model, name + "_right",
        synthesis::panel(f.point(h.width_m, 0, 0), h.depth_m * f.inward, {0, 0, eaves}, whole));
  const float out = h.style.cornice_out_m, half = 0.5f * h.depth_m, top = h.style.eaves_m();
  const auto cornice = [&](glm::vec3 from, glm::vec3 along, glm::vec3 outward) {
    add(model, fmt::format("{}_cornice_{}", name, model.parts.size()),
        synthesis::panel(from + glm::vec3(0, 0, eaves), along, out * outward + glm::vec3(0, 0, top - eaves),
                         whole));
  };
  cornice(f.point(0, 0, 0), h.width_m * f.along, -f.inward);
  if (h.has_left_front) cornice(f.point(0, h.depth_m, 0), -h.depth_m * f.inward, -f.along);
  if (h.has_right_front) cornice(f.point(h.width_m, 0, 0), h.depth_m * f.inward, f.along);
  const glm::vec3 up = (half + out) * f.inward + glm::vec3(0, 0, 0.44f * (half + out));
  const float x0 = h.has_left_front ? -out : 0.0f, x1 = h.width_m + (h.has_right_front ? out : 0.0f);
  add(model, name + "_roof", synthesis::panel(f.point(x0, -out, top), (x1 - x0) * f.along, up, whole));
}

}  // namespace

scene::Model make_coarse_square(std::uint64_t seed) {
  scene::Model model;
  model.name = model.nodes[0].name = "coarse square";
  model.materials.resize(1);
  model.materials[0].name = "surface";
  add(model, "ground", synthesis::panel({-110, -60, kerb_m}, {190, 0, 0}, {0, 150, 0}, whole));
  int number = 0;
  for (const Building& house : plan_houses(seed)) {
    ++number;
    const glm::vec3 middle = house.frame.point(0.5f * house.width_m, 0, 0);
    if (glm::length(glm::vec2(middle)) < near_m) add_house(model, house, number);
  }
  Mesh basin = synthesis::turned({{6.3f, 0.0f},
                                  {6.3f, 0.32f},
                                  {5.5f, 0.32f},
                                  {5.55f, 1.0f},
                                  {5.05f, 1.0f},
                                  {5.05f, 0.75f},
                                  {0.0f, 0.75f}},
                                 24);
  Mesh pedestal = synthesis::panelled_box({-1.9f, -1.9f, 0.75f}, {1.9f, 1.9f, 1.5f}, whole);
  append(pedestal, synthesis::panelled_box({-1.15f, -1.15f, 1.5f}, {1.15f, 1.15f, 5.6f}, whole));
  Mesh statue = synthesis::turned(
      {{0.45f, 5.6f}, {0.5f, 7.0f}, {0.6f, 8.2f}, {0.45f, 8.7f}, {0.25f, 9.0f}, {0.0f, 9.4f}}, 10);
  for (Mesh* mesh : {&basin, &pedestal, &statue})
    for (glm::vec3& p : mesh->positions) p += glm::vec3(fountain_at, kerb_m);
  add(model, "basin", std::move(basin)), add(model, "pedestal", std::move(pedestal)),
      add(model, "statue", std::move(statue));
  return model;
}

std::string photographs_script() {
  std::string text =
      "// Where the photographs of the square are taken: `parvis reference photographs.xp --path-traced "
      "--all-cameras`.\n"
      "include(file=\"place.xp\")\n";
  int number = 0;
  const auto photograph = [&](glm::vec3 eye, glm::vec3 target) {
    text += fmt::format(
        "camera(name=\"photo_{:02}\", position=\"{:.1f} {:.1f} {:.1f}\", target=\"{:.1f} {:.1f} {:.1f}\", "
        "fov_deg=74)\n",
        ++number, eye.x, eye.y, eye.z, target.x, target.y, target.z);
  };
  // Along the southern side northward, along the western one eastward, and so round, each side in overlapping
  // views.
  for (const float x : {-38.0f, -20.0f, -2.0f, 16.0f, 32.0f})
    photograph({x, -16.0f, 1.7f}, {x + 4.0f, north_m, 7.5f});
  for (const float y : {-14.0f, 6.0f, 24.0f}) photograph({6.0f, y, 1.7f}, {east_m, y + 2.0f, 7.5f});
  for (const float x : {30.0f, 10.0f, -10.0f, -30.0f})
    photograph({x, 12.0f, 1.7f}, {x - 4.0f, south_m, 7.0f});
  for (const float y : {26.0f, 6.0f, -14.0f}) photograph({-8.0f, y, 1.7f}, {west_m, y - 2.0f, 7.5f});
  // The fountain from four sides.
  for (const glm::vec2 way : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)})
    photograph(glm::vec3(fountain_at + 11.0f * way, 1.7f), glm::vec3(fountain_at, 4.2f));
  return text;
}

}  // namespace parvis::square
