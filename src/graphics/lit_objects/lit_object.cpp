#include "graphics/lit_objects/lit_object.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/joined_triangles.h"

namespace parvis::lit_objects {
namespace {

constexpr std::size_t block_vertices = 4096;
/// Of which it is kept what they hit of their own object: 8 bytes each.
constexpr std::size_t max_own_rays = 4'000'000;
/// Fewer rays than these to the sky are not shown by themselves.
constexpr int min_shown_rays = 64;

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

/// True where parts have moved by one way, and nothing has been turned or stretched.
bool is_shifted(const std::vector<glm::mat4>& from, const std::vector<glm::mat4>& to) {
  if (from.empty() || from.size() != to.size()) return false;
  const glm::vec4 way = to[0][3] - from[0][3];
  for (std::size_t p = 0; p < to.size(); ++p) {
    constexpr float max_off_m = 1e-4f;  // roundings far from the origin
    for (int column = 0; column < 3; ++column)
      if (from[p][column] != to[p][column]) return false;
    if (glm::distance(way, to[p][3] - from[p][3]) > max_off_m) return false;
  }
  return true;
}

/// Sky and sun together.
std::vector<glm::vec3> sum_of(SplitLight light) {
  for (std::size_t v = 0; v < light.sky.size(); ++v) light.sky[v] += light.sun[v];
  return std::move(light.sky);
}

}  // namespace

bool VertexBlock::stands_alone() const {
  return is_finished() || (light.rays() > 0 && light.sky_rays() >= min_shown_rays);
}

void VertexBlock::show_light() {
  if (is_finished()) guess.reset();
  if (guess)
    show(sum_of(mixed(*guess, light)));
  else if (stands_alone())
    show(light.irradiance());
}

void VertexBlock::restart() {
  if (guess)
    guess = mixed(*guess, light);
  else if (stands_alone())
    guess = {light.sky_irradiance(), light.sun_irradiance()};
  light.restart();
}

bool VertexBlock::can_follow_sky() const { return light.sky_rays() >= min_shown_rays; }

void VertexBlock::follow_sky(const light::SkyTable& sky) {
  light.follow(sky);
  guess.reset();
}

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
  is_deformed_ = !it.deformed_meshes.empty();
  const bool knows_itself = !is_deformed_ && is_shifted(world_from_mesh_, now);
  world_from_mesh_ = std::move(now);
  bounds_ = {};
  faces_.reset();
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
    if (knows_itself)
      block.light.shift(std::move(own));
    else
      block.light.restart(std::move(own));
    block.guess.reset();
  }
  return true;
}

void LitObject::restart() {
  faces_.reset();
  for (VertexBlock& block : blocks_) block.restart();
}

void LitObject::follow_sky(const light::SkyTable& sky) {
  faces_.reset();
  for (VertexBlock& block : blocks_) block.follow_sky(sky);
}

const light::OwnFaces* LitObject::faces(const reference::RayScene& rays, const light::SkyTable& sky) {
  std::size_t own_rays = 0;
  for (const VertexBlock& block : blocks_) own_rays += block.shown.size() * std::size_t(block.rays_wanted);
  if (is_deformed_ || own_rays > max_own_rays) return nullptr;
  if (!faces_) faces_.emplace(rays, object_, sky);
  return &*faces_;
}

bool LitObject::is_finished() const { return std::ranges::all_of(blocks_, &VertexBlock::is_finished); }

bool LitObject::has_light() const {
  return std::ranges::all_of(blocks_, [](const VertexBlock& block) { return block.is_shown; });
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
