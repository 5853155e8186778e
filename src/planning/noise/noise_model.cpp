// The map of noise as a model: ground and facades in the colours of the scale.
#include <algorithm>

#include "planning/noise/noise_picture.h"

namespace parvis::noise {
namespace {

/// Adds a rectangle with the colour of a step; `u` and `v` are half of its sides, and u x v its normal.
void add_rectangle(Mesh& mesh, glm::dvec3 middle, glm::dvec3 u, glm::dvec3 v, glm::vec2 uv) {
  const auto first = std::uint32_t(mesh.positions.size());
  const glm::vec3 normal(glm::normalize(glm::cross(u, v)));
  for (const glm::dvec3& corner : {middle - u - v, middle + u - v, middle + u + v, middle - u + v}) {
    mesh.positions.emplace_back(corner);
    mesh.normals.push_back(normal);
    mesh.uvs.push_back(uv);
  }
  for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + corner);
}

}  // namespace

scene::Model noise_model(const NoiseMap& map, double receiver_height_m) {
  constexpr double above_ground_m = 0.1, before_facade_m = 0.05, receiver_gap_m = 0.1,
                   lowest_receiver_m = 1.5;
  const std::span<const ScaleStep> scale = level_scale();
  scene::Texture colours{.name = "Lden",
                         .image = Image8(8 * int(scale.size()), 4, 4, 255),
                         .wrap_u = scene::Wrap::clamp,
                         .wrap_v = scene::Wrap::clamp};
  for (int y = 0; y < colours.image.height; ++y)
    for (int x = 0; x < colours.image.width; ++x)
      std::copy_n(&scale[std::size_t(x) / 8].colour[0], 3, colours.image.at(x, y));
  scene::Material material{.name = "Lden"};
  material.base_colour = glm::vec3(1.0f), material.base_colour_texture = 0, material.roughness = 1.0f;
  scene::Model model;
  model.textures.push_back(std::move(colours));
  model.materials.push_back(std::move(material));
  model.nodes.emplace_back();
  scene::Part ground, facades;
  ground.object = "ground", facades.object = "facades";
  ground.material = facades.material = ground.node = facades.node = 0;
  for (std::size_t i = 0; i < map.receivers.size(); ++i) {
    const Receiver& it = map.receivers[i];
    std::size_t step = 0;
    while (step + 1 < scale.size() && map.levels[i].lden >= scale[step + 1].from) ++step;
    const glm::vec2 uv((float(step) + 0.5f) / float(scale.size()), 0.5f);
    const double half = 0.5 * map.cell_m;
    if (it.wall < 0) {
      add_rectangle(ground.mesh, it.place - glm::dvec3(0, 0, receiver_height_m - above_ground_m),
                    {half, 0, 0}, {0, half, 0}, uv);
    } else {
      const glm::dvec3 out(it.facing, 0.0);
      const glm::dvec3 foot =
          it.place - (receiver_gap_m - before_facade_m) * out - glm::dvec3(0, 0, lowest_receiver_m);
      add_rectangle(facades.mesh, foot + glm::dvec3(0, 0, 0.5 * it.height_m),
                    0.5 * it.width_m * glm::dvec3(-it.facing.y, it.facing.x, 0.0), {0, 0, 0.5 * it.height_m},
                    uv);
    }
  }
  for (scene::Part* part : {&ground, &facades})
    if (!part->mesh.indices.empty()) model.parts.push_back(std::move(*part));
  return model;
}

}  // namespace parvis::noise
