#include <cmath>

#include "capture/view_dependent_objects/placed_object.h"
#include "capture/view_dependent_objects/view_lookup.h"
#include "graphics/shading/recorded_light.h"
#include "graphics/shading/recorded_shadow.h"
#include "scene/data/scene.h"
#include "scene/data/sun_shadows.h"

namespace parvis::view_dependent_objects {
namespace {

/// A piece's textures, as a surface that depends on the view.
class ObjectSurface final : public scene::TracedSurface {
 public:
  ObjectSurface(std::shared_ptr<const ViewLookup> lookup, const PlacedObject& placed, const Piece& piece,
                float exposure)
      : lookup_(std::move(lookup)),
        model_(placed.model),
        piece_(&piece),
        object_from_world_(glm::inverse(placed.world_from_object)),
        scale_(glm::length(glm::vec3(object_from_world_[0]))),
        radiance_of_exposed_(placed.brightness / exposure),
        kept_in_shadow_(placed.kept_in_shadow),
        passes_(placed.passes) {}

  scene::TracedPoint point(const scene::TracedHit& hit) const override {
    scene::TracedPoint point;
    point.normal = hit.to_viewer;  // textures have recorded reflections, too: black metal adds none here
    point.base_colour = glm::vec3(0.0f), point.metallic = 1.0f, point.roughness = 1.0f;
    const glm::vec3 exposed = shading::tone_unmapped(glm::clamp(glm::vec3(colour(hit)), 0.0f, 1.0f));
    point.emission = radiance_of_exposed_ * exposed;
    point.kept_in_shadow = shading::kept_in_shadow_of(kept_in_shadow_, model_->lit_luminance, exposed);
    return point;
  }
  float alpha(const scene::TracedHit& hit) const override { return colour(hit).w; }
  scene::Alpha alpha_mode() const override {
    return model_->has_holes ? scene::Alpha::cutout : scene::Alpha::opaque;
  }

 private:
  glm::vec4 colour(const scene::TracedHit& hit) const {
    return lookup_->colour(
        *piece_,
        {piece_->first_triangle + hit.triangle, hit.barycentric,
         glm::normalize(glm::mat3(object_from_world_) * hit.to_viewer), scale_ * hit.width_m},
        passes_);
  }

  std::shared_ptr<const ViewLookup> lookup_;
  std::shared_ptr<const BlendedModel> model_;
  const Piece* piece_;  ///< of the model
  glm::mat4 object_from_world_;
  float scale_, radiance_of_exposed_, kept_in_shadow_;
  int passes_;
};

std::shared_ptr<const Mesh> mesh_of(const BlendedModel& model, const Piece& piece) {
  auto mesh = std::make_shared<Mesh>();
  for (std::size_t i = 3 * piece.first_triangle; i < 3 * (piece.first_triangle + piece.triangle_count); ++i) {
    mesh->indices.push_back(std::uint32_t(mesh->positions.size()));
    mesh->positions.push_back(model.corners[i]), mesh->normals.push_back(model.normals[i]);
    mesh->uvs.emplace_back(0.0f);
  }
  return mesh;
}

}  // namespace

void PlacedObject::hash(ContentHash& hash) const {
  hash.add_text(called), hash.add(world_from_object), hash.add(passes), hash.add(brightness),
      hash.add(is_visible), hash.add(kept_in_shadow);
  if (model) model->hash(hash);
}

scene::TracedKind traced_objects() {
  scene::TracedKind kind;
  kind.name = "view-dependent objects";
  kind.is_recorded = true;
  kind.count = [](const scene::Scene& scene) { return int(scene.items<PlacedObject>().size()); };
  kind.trace = [](const scene::Scene& scene, scene::TracedScene& traced) {
    const auto& [objects, makers] = scene.data<scene::ItemsOf<PlacedObject>>();
    const auto& shadows = scene.data<scene::SunShadows>();
    for (std::size_t i = 0; i < objects.size(); ++i) {
      const PlacedObject& placed = objects[i];
      const auto lookup = std::make_shared<const ViewLookup>(placed.model);
      for (const Piece& piece : placed.model->pieces)
        traced.add(mesh_of(*placed.model, piece),
                   std::make_shared<const ObjectSurface>(lookup, placed, piece, scene.exposure),
                   placed.world_from_object,
                   {int(i), false, placed.is_visible, shadows.casts_item_of(makers[i])});
    }
  };
  return kind;
}

}  // namespace parvis::view_dependent_objects
