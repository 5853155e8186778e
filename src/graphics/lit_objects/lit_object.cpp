#include "graphics/lit_objects/lit_object.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/joined_triangles.h"

namespace parvis::lit_objects {
namespace {

constexpr std::size_t block_vertices = 4096;

bool shows_backs(const scene::Model& model, const scene::Part& part) {
  const scene::Material& material = model.materials[std::size_t(part.material)];
  return material.is_double_sided || material.translucency > 0.0f;
}

std::vector<glm::mat4> transforms_of(const scene::Object& object) {
  const std::vector<glm::mat4> pose = object.pose.empty() ? scene::rest_pose(*object.model) : object.pose;
  std::vector<glm::mat4> transforms;
  for (const scene::Part& part : object.model->parts)
    transforms.push_back(object.world_from_model * pose[std::size_t(part.node)]);
  return transforms;
}

bool has_direction(glm::vec3 normal) { return glm::dot(normal, normal) > 1e-12f; }

/// True where the triangles that enclose bodies face the inside of these.
bool faces_inward(const Mesh& mesh) {
  double six_volumes = 0.0;
  const glm::vec3 middle = mesh.bounds().centre();
  for (const MeshShell& shell : shells(mesh)) {
    if (!shell.is_closed) continue;
    for (const std::uint32_t triangle : shell.triangles) {
      const std::uint32_t* corner = mesh.indices.data() + 3 * std::size_t(triangle);
      six_volumes += double(
          glm::dot(mesh.positions[corner[0]] - middle,
                   glm::cross(mesh.positions[corner[1]] - middle, mesh.positions[corner[2]] - middle)));
    }
  }
  return six_volumes < 0.0;
}

}  // namespace

std::size_t LitObject::texel_count(const scene::Object& object) {
  std::size_t count = 0;
  for (std::size_t p = 0; p < object.model->parts.size(); ++p)
    count += object.mesh(p).positions.size() * (shows_backs(*object.model, object.model->parts[p]) ? 2 : 1);
  return count;
}

LitObject::LitObject(const scene::Scene& scene, int object, std::vector<std::string>& what_is_odd)
    : object_(object) {
  const scene::Object& it = scene.objects[std::size_t(object)];
  const scene::Model& model = *it.model;
  filled_normals_.resize(model.parts.size());
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    const Mesh& mesh = it.mesh(p);
    const bool has_backs = shows_backs(model, model.parts[p]);
    const bool has_all =
        mesh.normals.size() == mesh.positions.size() && std::ranges::all_of(mesh.normals, has_direction);
    if (!has_all) {
      what_is_odd.push_back(fmt::format(
          "\"{}\" has vertices without normals: those of its triangles are taken", model.parts[p].object));
      Mesh filled = mesh;
      fill_normals(filled);
      filled_normals_[p] = std::move(filled.normals);
    }
    if (!has_backs && faces_inward(mesh))
      what_is_odd.push_back(
          fmt::format("\"{}\" is inside out: its triangles face inward, and it is lit as a room "
                      "that is seen from within; turn them over if that is not meant",
                      model.parts[p].object));
    for (int side = 0; side < (has_backs ? 2 : 1); ++side)
      for (std::size_t first = 0; first < mesh.positions.size(); first += block_vertices)
        blocks_.push_back({p, first, side == 1,
                           light::VertexLight(std::vector<light::LitVertex>(
                               std::min(block_vertices, mesh.positions.size() - first)))});
  }
  for (VertexBlock& block : blocks_) block.shown.assign(block.light.vertices().size(), glm::vec3(0.0f));
  follow(scene);
}

std::size_t LitObject::vertex_count() const {
  std::size_t count = 0;
  for (const VertexBlock& block : blocks_) count += block.shown.size();
  return count;
}

std::vector<light::LitVertex> LitObject::vertices(const scene::Object& object, std::size_t part) const {
  const Mesh& mesh = object.mesh(part);
  const std::vector<glm::vec3>& normals =
      filled_normals_[part].empty() ? mesh.normals : filled_normals_[part];
  const glm::mat4& m = world_from_mesh_[part];
  const glm::vec3 c0(m[0]), c1(m[1]), c2(m[2]);  // normals follow the cofactors, as in surface_vertex.glsl
  const glm::mat3 cofactors(glm::cross(c1, c2), glm::cross(c2, c0), glm::cross(c0, c1));
  std::vector<light::LitVertex> result(mesh.positions.size());
  for (std::size_t v = 0; v < result.size(); ++v) {
    const glm::vec3 normal = cofactors * normals[v];
    result[v].position = glm::vec3(m * glm::vec4(mesh.positions[v], 1.0f));
    result[v].normal = has_direction(normal) ? glm::normalize(normal) : glm::vec3(0.0f, 0.0f, 1.0f);
  }
  return result;
}

bool LitObject::follow(const scene::Scene& scene) {
  const scene::Object& it = scene.objects[std::size_t(object_)];
  std::vector<glm::mat4> now = transforms_of(it);
  if (now == world_from_mesh_ && it.deformed_meshes.empty()) return false;
  world_from_mesh_ = std::move(now);
  bounds_ = {};
  std::vector<light::LitVertex> all;
  std::size_t part = it.model->parts.size();
  for (VertexBlock& block : blocks_) {
    if (block.part != part) all = vertices(it, part = block.part);
    std::vector<light::LitVertex> own(all.begin() + std::ptrdiff_t(block.first),
                                      all.begin() + std::ptrdiff_t(block.first + block.shown.size()));
    for (light::LitVertex& vertex : own) {
      bounds_.add(vertex.position);
      if (block.is_behind) vertex.normal = -vertex.normal;
    }
    block.light.restart(std::move(own));
  }
  return true;
}

void LitObject::restart() {
  for (VertexBlock& block : blocks_) block.light.restart();
}

void LitObject::follow_sky(const light::SkyTable& sky) {
  for (VertexBlock& block : blocks_) block.light.follow(sky);
}

bool LitObject::take_news() {
  bool is_any = false;
  for (VertexBlock& block : blocks_) is_any |= std::exchange(block.is_new, false);
  return is_any;
}

std::shared_ptr<const scene::LitVertices> LitObject::light() const {
  auto light = std::make_shared<scene::LitVertices>();
  light->parts.resize(world_from_mesh_.size());
  for (const VertexBlock& block : blocks_) {
    scene::LitVertices::PartLight& part = light->parts[block.part];
    std::vector<glm::vec3>& side = block.is_behind ? part.behind : part.front;
    side.insert(side.end(), block.shown.begin(), block.shown.end());
  }
  return light;
}

}  // namespace parvis::lit_objects
