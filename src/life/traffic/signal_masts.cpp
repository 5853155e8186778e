#include "life/traffic/signal_masts.h"

#include <algorithm>
#include <array>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>

#include "synthesis/round_mesh.h"

namespace parvis::traffic {
namespace {

constexpr float mast_m = 3.3f, mast_radius_m = 0.055f;
constexpr float drive_lens_m = 0.1f, walk_lens_m = 0.085f;  // radii
constexpr float drive_middle_m = 2.8f, walk_middle_m = 2.3f, lens_apart_m = 0.27f, walk_apart_m = 0.24f;
constexpr float lamp_radiance = 3.0f;  // W/m2/sr: as bright as a white wall in the sun
constexpr std::array colours{glm::vec3(1.0f, 0.03f, 0.02f), glm::vec3(1.0f, 0.5f, 0.02f),
                             glm::vec3(0.02f, 0.9f, 0.35f)};
enum Colour : std::uint8_t { red, yellow, green };

/// A lantern: its frame has x towards who looks at it and its origin on the ground below.
struct Lantern {
  glm::mat4 world_from_lantern;
  int phase;
  bool is_for_people;
};

glm::mat4 frame_at(glm::vec3 foot, glm::vec2 facing) {
  const glm::vec3 x(facing, 0.0f), y(-facing.y, facing.x, 0.0f);
  return {glm::vec4(x, 0.0f), glm::vec4(y, 0.0f), glm::vec4(0, 0, 1, 0), glm::vec4(foot, 1.0f)};
}

std::vector<Lantern> lanterns_of(const SignalJunction& junction) {
  std::vector<Lantern> lanterns;
  for (const SignalApproach& approach : junction.approaches) {
    // Traffic keeps to the right: seen from the junction its masts stand on the left.
    const glm::vec2 right(-approach.away.y, approach.away.x);
    const bool is_outermost = std::ranges::none_of(junction.approaches, [&](const SignalApproach& other) {
      return glm::dot(other.away, approach.away) > 0.9f &&
             glm::dot(glm::vec2(other.stop - approach.stop), right) > 0.5f;
    });
    if (!is_outermost) continue;
    const glm::vec3 foot =
        approach.stop + glm::vec3((approach.half_width_m + junction.beside_m) * right, 0.0f);
    lanterns.push_back({frame_at(foot, approach.away), approach.phase, false});
  }
  for (const SignalWalk& walk : junction.walks) {
    const glm::vec2 across = glm::normalize(glm::vec2(walk.b - walk.a));
    glm::vec2 inward(-across.y, across.x);
    if (glm::dot(inward, glm::vec2(junction.middle - walk.a)) < 0.0f) inward = -inward;
    const glm::vec3 aside((walk.half_width_m + 0.3f) * inward, 0.0f), out(junction.beside_m * across, 0.0f);
    lanterns.push_back({frame_at(walk.a + aside - out, across), walk.phase, true});
    lanterns.push_back({frame_at(walk.b + aside + out, -across), walk.phase, true});
  }
  return lanterns;
}

/// The height of a lens of this colour.
float height_of(bool is_for_people, Colour colour) {
  return is_for_people ? walk_middle_m + (colour == green ? -0.5f : 0.5f) * walk_apart_m
                       : drive_middle_m + float(int(yellow) - int(colour)) * lens_apart_m;
}

Mesh lens(const Lantern& lantern, Colour colour, float front_m) {
  const float z = height_of(lantern.is_for_people, colour);
  const float radius = lantern.is_for_people ? walk_lens_m : drive_lens_m;
  Mesh mesh;
  append(mesh, synthesis::tube({{{front_m - 0.02f, 0, z}, radius}, {{front_m, 0, z}, radius}}, 16),
         lantern.world_from_lantern);
  return mesh;
}

scene::Material material(const char* name, glm::vec3 colour, float roughness,
                         glm::vec3 emission = glm::vec3(0.0f)) {
  scene::Material m;
  m.name = name, m.base_colour = colour, m.roughness = roughness, m.emission = emission;
  return m;
}

void add_part(scene::Model& model, Mesh mesh, int number) {
  if (mesh.indices.empty()) return;
  scene::Part part;
  part.object = model.materials[std::size_t(number)].name, part.mesh = std::move(mesh),
  part.material = number;
  model.parts.push_back(std::move(part));
}

std::shared_ptr<const scene::Model> lamps(const SignalJunction& junction, int phase, bool is_for_people,
                                          Colour colour) {
  auto model = std::make_shared<scene::Model>();
  model->name = "lit lamps";
  model->materials = {material("lamp", glm::vec3(0.0f), 0.5f, lamp_radiance * colours[colour])};
  Mesh mesh;
  for (const Lantern& lantern : lanterns_of(junction))
    if (lantern.phase == phase && lantern.is_for_people == is_for_people)
      append(mesh, lens(lantern, colour, 0.2f));
  add_part(*model, std::move(mesh), 0);
  if (!model->parts.empty()) model->parts[0].casts_shadow = false;
  return model;
}

}  // namespace

std::shared_ptr<const scene::Model> signal_masts(const SignalJunction& junction) {
  auto model = std::make_shared<scene::Model>();
  model->name = "traffic lights";
  model->materials = {material("mast", glm::vec3(0.18f, 0.19f, 0.20f), 0.55f),
                      material("housing", glm::vec3(0.02f, 0.022f, 0.022f), 0.6f)};
  for (const glm::vec3 colour : colours) model->materials.push_back(material("lens", 0.06f * colour, 0.2f));
  std::array<Mesh, 5> meshes;
  for (const Lantern& lantern : lanterns_of(junction)) {
    const glm::mat4& at = lantern.world_from_lantern;
    append(meshes[0],
           synthesis::tube({{{0, 0, 0}, mast_radius_m},
                            {{0, 0, lantern.is_for_people ? walk_middle_m + 0.3f : mast_m}, mast_radius_m}},
                           10),
           at);
    const float middle = lantern.is_for_people ? walk_middle_m : drive_middle_m,
                half = lantern.is_for_people ? 0.27f : 0.44f, wide = lantern.is_for_people ? 0.12f : 0.15f;
    append(meshes[1],
           synthesis::panelled_box({0.03f, -wide, middle - half}, {0.18f, wide, middle + half}, 1.0f), at);
    for (const Colour colour : {red, yellow, green}) {
      if (lantern.is_for_people && colour == yellow) continue;
      append(meshes[2 + std::size_t(colour)], lens(lantern, colour, 0.19f));
      // A visor above each lens.
      const float radius = (lantern.is_for_people ? walk_lens_m : drive_lens_m) + 0.01f;
      const float z = height_of(lantern.is_for_people, colour);
      append(meshes[1],
             synthesis::panelled_box({0.18f, -radius, z + radius - 0.01f}, {0.34f, radius, z + radius}, 1.0f),
             at);
    }
  }
  for (std::size_t m = 0; m < meshes.size(); ++m) add_part(*model, std::move(meshes[m]), int(m));
  return model;
}

std::shared_ptr<const scene::Model> lit_drive_lamps(const SignalJunction& junction, int phase,
                                                    DriveLight light) {
  return lamps(junction, phase, false,
               light == DriveLight::red      ? red
               : light == DriveLight::yellow ? yellow
                                             : green);
}

std::shared_ptr<const scene::Model> lit_walk_lamps(const SignalJunction& junction, int phase,
                                                   scene::WalkLight light) {
  return lamps(junction, phase, true, light == scene::WalkLight::wait ? red : green);
}

}  // namespace parvis::traffic
