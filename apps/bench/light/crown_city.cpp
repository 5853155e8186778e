#include "bench/light/crown_city.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "base/files.h"
#include "base/random.h"
#include "formats/gltf/gltf_writer.h"
#include "graphics/reference/ray_scene.h"
#include "places/paper_city/paper_city.h"
#include "places/paper_city/street_plan.h"
#include "scene/data/vertex_irradiance.h"

namespace parvis::bench {
namespace {

constexpr const char* crown_name = "crown";
constexpr double frame_s = 1.0 / 30.0;
constexpr glm::vec3 leaf_colour{0.10f, 0.17f,
                                0.05f};  // a white crown would be lit by itself more than by the sky

/// 2,500 leaves of four vertices about a point six metres up, four metres across.
scene::Model crown() {
  constexpr int leaves = 2500;
  constexpr float radius_m = 2.0f, leaf_m = 0.12f;
  scene::Model model;
  scene::Part part;
  Random random(9);
  const auto any = [&] {
    const float x = random.uniform(-1.0f, 1.0f), y = random.uniform(-1.0f, 1.0f);
    return glm::vec3(x, y, random.uniform(-1.0f, 1.0f));
  };
  for (int leaf = 0; leaf < leaves; ++leaf) {
    const glm::vec3 middle = glm::vec3(0.0f, 0.0f, 6.0f) + radius_m * any();
    const glm::vec3 normal = glm::normalize(any() + 1e-4f);
    const glm::vec3 right = glm::normalize(
        glm::cross(normal, std::abs(normal.z) < 0.9f ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0)));
    const glm::vec3 up = glm::cross(normal, right);
    const auto first = std::uint32_t(part.mesh.positions.size());
    for (const glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
      part.mesh.positions.push_back(middle + leaf_m * (corner.x * right + corner.y * up));
      part.mesh.normals.push_back(normal);
      part.mesh.uvs.emplace_back(0.5f * corner + 0.5f);
    }
    for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) part.mesh.indices.push_back(first + corner);
  }
  model.parts.push_back(std::move(part));
  scene::Material leaf;
  leaf.base_colour = leaf_colour, leaf.metallic = 0.0f, leaf.roughness = 1.0f;
  model.materials.push_back(std::move(leaf));
  return model;
}

}  // namespace

Status CrownCity::write(const ScratchFolder& folder) {
  if (Status written = city::write_paper_city(folder.path, 1); !written) return written;
  return scene::write_gltf(folder.path / "crown.glb", crown());
}

Result<CrownCity> CrownCity::open(const BenchSetup& setup, const ScratchFolder& folder, const char* how_lit) {
  const auto script = folder.path / "lit.xp";
  const std::string text = fmt::format(
      "include(file=\"paper_day.xp\")\nlitVirtualObject({}) {{ object(name=\"{}\", file=\"crown.glb\", "
      "grab=1) }}\n",
      how_lit, crown_name);
  if (Status status = write_file(script, text); !status) return status.errors();
  Result<house::Play> play = house::open_play(setup.house, script, {});
  if (!play) return play.errors();
  for (std::size_t o = 0; o < play->scene.objects.size(); ++o)
    if (play->scene.objects[o].name == crown_name) return CrownCity(*std::move(play), o);
  return error("the scene has no object \"{}\"", crown_name);
}

void CrownCity::move(glm::vec2 from_crossing_m) {
  play_.scene.objects[crown_].world_from_model =
      glm::translate(glm::mat4(1.0f), glm::vec3(city::main_crossing() + from_crossing_m, 0.0f));
}

void CrownCity::advance() { play_.advance(frame_s); }

void CrownCity::settle() {
  advance();
  play_.settle();
}

std::vector<glm::vec3> CrownCity::light() const {
  std::vector<glm::vec3> all;
  for (const auto& part : play_.scene.data<scene::VertexIrradiance>().of(crown_)->parts)
    all.insert(all.end(), part.front.begin(), part.front.end());
  return all;
}

std::vector<light::LitVertex> CrownCity::vertices() const {
  const scene::Object& object = play_.scene.objects[crown_];
  const std::vector<glm::mat4> pose = object.pose.empty() ? scene::rest_pose(*object.model) : object.pose;
  std::vector<light::LitVertex> vertices;
  for (const scene::Part& part : object.model->parts) {
    const glm::mat4 world_from_mesh = object.world_from_model * pose[std::size_t(part.node)];
    for (std::size_t v = 0; v < part.mesh.positions.size(); ++v)  // nothing is scaled
      vertices.push_back({glm::vec3(world_from_mesh * glm::vec4(part.mesh.positions[v], 1.0f)),
                          glm::normalize(glm::mat3(world_from_mesh) * part.mesh.normals[v])});
  }
  return vertices;
}

Bounds CrownCity::bounds() const {
  Bounds bounds;
  for (const light::LitVertex& vertex : vertices()) bounds.add(vertex.position);
  return bounds;
}

Status CrownCity::stands_beside_facade() const {
  constexpr float near_m = 8.0f;  // beside a lawn it would be 60
  const glm::vec3 middle = bounds().centre();
  const scene::Scene others = casters(false);
  const reference::RayScene around(others);
  for (const float east : {-1.0f, 1.0f})
    if (around.is_blocked({middle, {east, 0.0f, 0.0f}, 0.0f, near_m})) return Done{};
  return error("the crown stands at {:.1f} {:.1f}, where no facade is within {} m", middle.x, middle.y,
               near_m);
}

Status CrownCity::stands_free_in_sun(glm::vec3 to_sun) const {
  constexpr double max_share = 0.01;
  const scene::Scene others = casters(false);
  const reference::RayScene around(others);
  const std::vector<light::LitVertex> leaves = vertices();
  const glm::vec3 middle = bounds().centre();
  std::size_t met = 0, shaded = 0;
  for (const light::LitVertex& leaf : leaves) {
    const glm::vec3 inward = middle - leaf.position;
    const float distance_m = glm::length(inward);
    if (distance_m > 0.0f && around.is_blocked({leaf.position, inward / distance_m, 0.0f, distance_m})) ++met;
    if (around.is_blocked({leaf.position, to_sun})) ++shaded;
  }
  const double all = double(leaves.size());
  if (met == 0 && double(shaded) <= max_share * all) return Done{};
  return error(
      "the crown at {:.1f} {:.1f} does not stand free in the sun: other things lie between {:.0f} % "
      "of its vertices and its middle, and shade {:.0f} %",
      middle.x, middle.y, 100.0 * double(met) / all, 100.0 * double(shaded) / all);
}

scene::Scene CrownCity::casters(bool with_crown) const {
  scene::Scene casters = play_.scene;
  casters.sky.picture = {};
  for (std::size_t o = 0; o < casters.objects.size(); ++o)
    if (o == crown_)
      casters.objects[o].is_visible = with_crown, casters.objects[o].is_dynamic = true;  // it has moved
    else if (casters.objects[o].is_dynamic)
      casters.objects[o].is_visible = false;
  return casters;
}

double light_rmse_percent(const std::vector<glm::vec3>& light, const std::vector<glm::vec3>& truth) {
  double off = 0.0, mean = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const glm::dvec3 difference = glm::dvec3(light[i]) - glm::dvec3(truth[i]);
    off += glm::dot(difference, difference), mean += glm::dot(glm::dvec3(truth[i]), glm::dvec3(1.0));
  }
  return 100.0 * std::sqrt(off * 3.0 * double(truth.size())) / mean;
}

}  // namespace parvis::bench
