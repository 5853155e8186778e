#include "places/kerbside/street_models.h"

#include <map>
#include <set>

#include "base/colour.h"
#include "formats/meshes/simplification.h"
#include "places/paper_city/car.h"
#include "places/paper_city/night_lights.h"
#include "synthesis/round_mesh.h"
#include "synthesis/tree.h"

namespace parvis::kerbside {
namespace {

using glm::vec3;
using synthesis::Outline, synthesis::panelled_box, synthesis::smooth, synthesis::tube, synthesis::turned;

constexpr int tree_shapes = 5;
// A car of so few triangles looks the same from 3 m on: of a wheel's outline 16 segments leave out 6 mm.
constexpr float car_error_m = 0.006f, car_crease_deg = 45.0f;
constexpr int car_wheel_segments = 16;
constexpr std::size_t cars_per_body = 20;  // in a short street they differ by their paint alone
constexpr float panel_m = 10.0f;           // of panels: one square

scene::Material material(const char* name, vec3 colour, float roughness) {
  scene::Material result;
  result.name = name, result.base_colour = colour, result.roughness = roughness;
  return result;
}

scene::Material cast_iron() { return material("cast iron", linear_from_srgb8(0x2C, 0x31, 0x30), 0.5f); }
scene::Material wood() { return material("oak slats", linear_from_srgb8(0x8E, 0x69, 0x45), 0.7f); }

void add(scene::Model& model, const char* object, Mesh mesh, scene::Material material) {
  scene::Part part;
  part.object = object, part.mesh = std::move(mesh), part.material = int(model.materials.size());
  model.parts.push_back(std::move(part));
  model.materials.push_back(std::move(material));
}

/// Slats on two frames of cast iron; its back is towards the houses.
scene::Model make_bench() {
  constexpr float half_m = 0.9f;
  Mesh slats, frames;
  for (int i = 0; i < 4; ++i) {
    const float y = -0.24f + 0.12f * float(i);
    append(slats, panelled_box({-half_m, y, 0.43f}, {half_m, y + 0.095f, 0.465f}, panel_m));
  }
  for (int i = 0; i < 3; ++i) {
    const float z = 0.55f + 0.13f * float(i), y = 0.26f + 0.04f * float(i);
    append(slats, panelled_box({-half_m, y, z}, {half_m, y + 0.03f, z + 0.095f}, panel_m));
  }
  for (const float x : {-0.68f, 0.68f}) {
    append(frames, tube({{{x, -0.24f, 0.0f}, 0.03f}, {{x, -0.2f, 0.42f}, 0.025f}}));
    append(frames, tube({{{x, 0.3f, 0.0f}, 0.03f}, {{x, 0.25f, 0.42f}, 0.028f}, {{x, 0.37f, 0.95f}, 0.02f}}));
    append(frames, tube({{{x, -0.22f, 0.41f}, 0.022f}, {{x, 0.25f, 0.41f}, 0.022f}}));
  }
  scene::Model model;
  add(model, "slats", std::move(slats), wood());
  add(model, "frame", std::move(frames), cast_iron());
  return model;
}

scene::Model make_bin() {
  const Outline body{{0.21f, 0.08f}, {0.24f, 0.12f}, {0.25f, 0.78f},
                     {0.26f, 0.8f},  {0.25f, 0.83f}, {0.21f, 0.84f}};
  const Outline hood{{0.23f, 0.98f}, {0.25f, 1.0f}, {0.2f, 1.08f}, {0.02f, 1.12f}};
  const Outline inside{{0.21f, 0.84f}, {0.2f, 0.6f}, {0.02f, 0.58f}};
  Mesh shell = turned(body, 24), iron = turned(hood, 24);
  append(iron, turned({{0.24f, 0.0f}, {0.24f, 0.08f}, {0.1f, 0.1f}}, 24));
  append(iron, turned(inside, 24));
  for (const float x : {-0.2f, 0.2f})
    append(iron, tube({{{x, 0.0f, 0.8f}, 0.015f}, {{x, 0.0f, 1.0f}, 0.015f}}));
  scene::Model model;
  add(model, "shell", std::move(shell), material("green enamel", linear_from_srgb8(0x2E, 0x4A, 0x3A), 0.4f));
  add(model, "iron", std::move(iron), cast_iron());
  return model;
}

scene::Model make_bollard() {
  scene::Model model;
  add(model, "bollard",
      turned(smooth({{0.1f, 0.0f},
                     {0.085f, 0.1f},
                     {0.06f, 0.2f},
                     {0.055f, 0.7f},
                     {0.07f, 0.78f},
                     {0.07f, 0.84f},
                     {0.045f, 0.92f},
                     {0.005f, 0.96f}},
                    3),
             16),
      cast_iron());
  return model;
}

std::size_t bodies_of(const StreetModels& models) {
  std::set<const scene::Model*> bodies;
  for (const StreetModel& each : models) bodies.insert(each.model.get());
  return bodies.size();
}

/// Simplifies a car; a part that turns by itself, as a wheel, touches nothing else.
void simplify_car(scene::Model& car) {
  std::map<int, std::vector<Mesh*>> meshes_of;  // by the nodes of their parts
  for (scene::Part& part : car.parts) meshes_of[part.node].push_back(&part.mesh);
  for (const auto& [node, meshes] : meshes_of) scene::simplify_together(meshes, car_error_m, car_crease_deg);
  std::erase_if(car.parts, [](const scene::Part& part) { return part.mesh.indices.empty(); });
}

}  // namespace

StreetModels street_trees(float height_m, std::uint64_t seed) {
  StreetModels models;
  for (int i = 0; i < tree_shapes; ++i)
    models.push_back(
        {std::make_shared<scene::Model>(synthesis::make_medium_tree(height_m, seed + std::uint64_t(i)))});
  return models;
}

StreetModels parked_cars(std::size_t places) {
  StreetModels models;
  for (const city::VehicleKind& kind : city::city_vehicles()) {
    if (kind.shape.name == "bus" || bodies_of(models) * cars_per_body >= places) continue;
    city::CarShape shape = kind.shape;
    shape.wheel_segments = car_wheel_segments, shape.has_round_tyre_shoulders = false;
    scene::Model body = city::make_car(shape, kind.paints.front());
    body.name = body.nodes.front().name = shape.name;
    simplify_car(body);
    const auto shared = std::make_shared<const scene::Model>(std::move(body));
    for (const city::CarPaint& paint : kind.paints)
      models.push_back(
          {shared, std::make_shared<const std::vector<scene::Material>>(city::car_materials(paint))});
  }
  return models;
}

const std::vector<FurnitureKind>& furniture_kinds() {
  static const std::vector<FurnitureKind> kinds{
      {"lamps", "street lamp", 25.0f, 0.5f, 0.0f, city::make_street_lamp},
      {"benches", "bench", 30.0f, 1.2f, 0.9f, make_bench},
      {"bins", "bin", 45.0f, 0.8f, 0.0f, make_bin},
      {"bollards", "bollard", 2.2f, 0.3f, 0.0f, make_bollard},
  };
  return kinds;
}

}  // namespace parvis::kerbside
