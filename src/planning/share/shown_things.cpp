#include "planning/share/shown_things.h"

#include <algorithm>
#include <set>

#include "base/content_hash.h"
#include "planning/share/plant_model.h"
#include "scene/data/surroundings.h"

namespace parvis::share {
namespace {

/// A part of a model that a browser draws: without deformation.
scene::Part still_part(const scene::Object& object, std::size_t number) {
  scene::Part part = object.model->parts[number];
  part.mesh = object.mesh(number);
  part.deformation = nullptr;
  return part;
}

bool is_deformed(const scene::Model& model) {
  return std::ranges::any_of(model.parts,
                             [](const scene::Part& part) { return part.deformation != nullptr; });
}

/// Meshes with surfaces of their own, in the colours that these have at the corners, seen from straight
/// before.
scene::Model coloured_model(const Mesh& mesh, const scene::TracedSurface& surface) {
  scene::Part part;
  part.mesh = mesh;
  part.mesh.colours.assign(mesh.positions.size(), glm::vec4(1.0f));
  if (part.mesh.uvs.empty()) part.mesh.uvs.assign(mesh.positions.size(), glm::vec2(0.0f));
  float brightest = 1.0f;
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    const std::size_t v = mesh.indices[i];
    const glm::vec3 normal = mesh.normals[v];
    const scene::TracedPoint point =
        surface.point({.position = mesh.positions[v],
                       .to_viewer = normal,
                       .normal = normal,
                       .uv = part.mesh.uvs[v],
                       .triangle = std::uint32_t(i / 3),
                       .barycentric = {i % 3 == 1 ? 1.0f : 0.0f, i % 3 == 2 ? 1.0f : 0.0f},
                       .width_m = 0.5f,
                       .is_back = false});
    const glm::vec3 colour = (1.0f - point.metallic) * point.base_colour + point.emission;
    part.mesh.colours[v] = glm::vec4(colour, point.openness);
    brightest = std::max({brightest, colour.x, colour.y, colour.z});
  }
  for (glm::vec4& colour : part.mesh.colours) colour = glm::vec4(glm::vec3(colour) / brightest, colour.w);
  scene::Model model;
  scene::Material material;
  material.base_colour = glm::vec3(1.0f), material.roughness = 0.9f;
  material.is_double_sided = surface.is_double_sided();
  model.materials.push_back(material);
  model.parts.push_back(std::move(part));
  return model;
}

/// Takes what a room traces as objects.
class TracedAsObjects final : public scene::TracedScene {
 public:
  struct Found {
    std::shared_ptr<const scene::Model> model;
    glm::mat4 world_from_model;
    std::uint64_t key;
    bool is_plain;
  };

  void add(std::shared_ptr<const Mesh> mesh, std::shared_ptr<const scene::TracedSurface> surface,
           const glm::mat4& world_from_mesh, const scene::TracedPlacing& placing) override {
    if (!placing.is_visible) return;
    auto model = std::make_shared<scene::Model>(coloured_model(*mesh, *surface));
    model->parts.front().casts_shadow = placing.casts_shadow;
    model->parts.front().is_backdrop = placing.is_backdrop;
    ContentHash hash;
    hash.add(mesh->positions), hash.add(model->parts.front().mesh.colours);
    found.push_back({std::move(model), world_from_mesh, hash.value(), true});
  }
  void add(std::shared_ptr<const scene::Model> model, const glm::mat4& world_from_model,
           const scene::TracedPlacing& placing) override {
    if (!placing.is_visible) return;
    const auto key = std::uint64_t(reinterpret_cast<std::uintptr_t>(model.get()));
    found.push_back({std::move(model), world_from_model, key, false});
  }

  std::vector<Found> found;
};

constexpr std::string_view plants = "grown plants";

}  // namespace

int ShownThings::number_of(const scene::Object& object, std::uint64_t model_key) {
  ContentHash hash;
  hash.add_text(object.name), hash.add(model_key), hash.add(object.world_from_model), hash.add(object.pose);
  hash.add(reinterpret_cast<std::uintptr_t>(object.paint.get()));
  const auto [found, is_new] = numbers_.try_emplace(hash.value(), int(objects_.size()));
  if (is_new) objects_.push_back(object);
  return found->second;
}

std::shared_ptr<const scene::Model> ShownThings::still(const scene::Object& object, std::uint64_t& key) {
  key = std::uint64_t(reinterpret_cast<std::uintptr_t>(object.model.get()));
  if (!is_deformed(*object.model)) {
    models_.try_emplace(key, object.model);  // its address stays its own
    return object.model;
  }
  ContentHash hash;
  hash.add(key);
  for (const Mesh& mesh : object.deformed_meshes) hash.add(mesh.positions);
  key = hash.value();
  std::shared_ptr<const scene::Model>& kept = models_[key];
  if (kept) return kept;
  auto model = std::make_shared<scene::Model>(*object.model);
  for (std::size_t i = 0; i < model->parts.size(); ++i) model->parts[i] = still_part(object, i);
  kept = model;
  return kept;
}

void ShownThings::add_plants(const scene::Scene& scene, std::vector<int>& shown) {
  for (const vegetation::ScenePlant& plant : vegetation::scene_plants(scene)) {
    if (!plant.is_visible) continue;
    const auto key = std::uint64_t(reinterpret_cast<std::uintptr_t>(plant.shape.get()));
    std::shared_ptr<const scene::Model>& model = models_[key];
    if (!model) model = std::make_shared<const scene::Model>(plant_model(*plant.shape));
    has_thinned_plants_ = has_thinned_plants_ || is_thinned(*plant.shape);
    scene::Object object;
    object.name = std::string(plant.shape->kind().name);
    object.model = model;
    object.world_from_model = plant.world_from_plant;
    shown.push_back(number_of(object, key));
  }
}

void ShownThings::add_others(const scene::Scene& scene, std::vector<int>& shown) {
  for (const scene::TracedKind& kind : scene.traced_kinds) {
    if (kind.name == plants || kind.count(scene) == 0) continue;
    TracedAsObjects taken;
    kind.trace(scene, taken);
    int plain = 0;
    for (const TracedAsObjects::Found& each : taken.found) {
      std::shared_ptr<const scene::Model>& model = models_[each.key];
      if (!model) model = each.model;
      scene::Object object;
      object.name = kind.name, object.model = model, object.world_from_model = each.world_from_model;
      shown.push_back(number_of(object, each.key));
      plain += int(each.is_plain);
    }
    if (plain > 0) plain_kinds_[kind.name] = std::max(plain_kinds_[kind.name], plain);
  }
}

std::vector<int> ShownThings::add(const scene::Scene& scene) {
  std::vector<int> shown;
  for (const scene::Object& object : scene.objects) {
    if (!object.is_visible || object.model->triangle_count() == 0) continue;
    scene::Object taken = object;
    std::uint64_t key = 0;
    taken.model = still(object, key);
    taken.deformed_meshes.clear();
    taken.played = {};
    const std::size_t before = objects_.size();
    shown.push_back(number_of(taken, key));
    if (objects_.size() > before && scene::surrounds_place(scene, object))
      surroundings_.push_back(shown.back());
  }
  add_plants(scene, shown);
  add_others(scene, shown);
  std::ranges::sort(shown);
  shown.erase(std::ranges::unique(shown).begin(), shown.end());
  return shown;
}

}  // namespace parvis::share
