#include <cmath>

#include "base/colour.h"
#include "capture/facades/facade_lookup.h"
#include "capture/facades/placed_facade.h"
#include "graphics/shading/tone_curve.h"
#include "scene/data/scene.h"

namespace parvis::facades {
namespace {

using namespace shading;  // GLSL's own functions and types, for the included text
#include "capture/facades/recorded_light.glsl"

/// A facade's photographs, as a surface that depends on the view.
class FacadeSurface final : public scene::TracedSurface {
 public:
  FacadeSurface(std::shared_ptr<const PackedFacade> facade, const glm::mat4& world_from_facade,
                float radiance_of_exposed)
      : facade_(std::move(facade)),
        texels_(*facade_),
        facade_from_world_(glm::inverse(world_from_facade)),
        scale_(glm::length(glm::vec3(facade_from_world_[0]))),
        radiance_of_exposed_(radiance_of_exposed),
        has_holes_(has_holes(*facade_)) {}

  scene::TracedPoint point(const scene::TracedHit& hit) const override {
    scene::TracedPoint point;
    point.normal = hit.normal;
    point.base_colour = glm::vec3(0.0f), point.metallic = 1.0f, point.roughness = 1.0f;
    const glm::vec3 srgb = glm::clamp(glm::vec3(colour(hit)), 0.0f, 1.0f);
    point.emission = radiance_of_exposed_ * tone_unmapped(linear_from_srgb(srgb));
    return point;
  }
  float alpha(const scene::TracedHit& hit) const override { return colour(hit).w; }
  scene::Alpha alpha_mode() const override {
    return has_holes_ ? scene::Alpha::cutout : scene::Alpha::opaque;
  }

 private:
  glm::vec4 colour(const scene::TracedHit& hit) const {
    FacadeLookup lookup(*facade_, texels_);
    const glm::vec3 position(facade_from_world_ * glm::vec4(hit.position, 1.0f));
    const glm::vec3 to_eye = glm::normalize(glm::mat3(facade_from_world_) * hit.to_viewer);
    return lookup.colour(hit.triangle, position, to_eye, scale_ * hit.width_m, hit.barycentric);
  }

  std::shared_ptr<const PackedFacade> facade_;
  FacadeTexels texels_;
  glm::mat4 facade_from_world_;
  float scale_, radiance_of_exposed_;
  bool has_holes_;
};

}  // namespace

bool has_holes(const PackedFacade& facade) {
  for (const std::uint32_t tile : facade.tiles)
    if (TileKind(tile & 3u) == TileKind::alpha) return true;
  return false;
}

Mesh mesh_of(const PackedFacade& facade) {
  Mesh mesh;
  mesh.positions = facade.corners;
  mesh.uvs.assign(facade.corners.size(), glm::vec2(0.0f));
  for (std::size_t t = 0; t < facade.triangle_count(); ++t) {
    const glm::vec3* c = facade.corners.data() + 3 * t;
    const glm::vec3 across = glm::cross(c[1] - c[0], c[2] - c[0]);
    const float length = glm::length(across);
    const glm::vec3 normal = length > 0.0f ? across / length : glm::vec3(0, 0, 1);
    for (std::uint32_t k = 0; k < 3; ++k) {
      mesh.normals.push_back(normal);
      mesh.indices.push_back(std::uint32_t(3 * t) + k);
    }
  }
  return mesh;
}

void PlacedFacade::hash(ContentHash& hash) const {
  hash.add_text(called), hash.add(world_from_facade), hash.add(brightness), hash.add(is_visible);
  if (!facade) return;
  hash.add(facade->corners), hash.add(facade->lists), hash.add(facade->tiles), hash.add(facade->blocks);
  for (const PackedPhoto& photo : facade->photos) {
    hash.add(photo.view.centre), hash.add(photo.view.camera_from_world), hash.add(photo.view.fx);
    hash.add(photo.balance.scale), hash.add(photo.balance.offset);
  }
}

scene::TracedKind traced_facades() {
  scene::TracedKind kind;
  kind.name = "facades";
  kind.count = [](const scene::Scene& scene) { return int(scene.items<PlacedFacade>().size()); };
  kind.trace = [](const scene::Scene& scene, scene::TracedScene& traced) {
    int thing = 0;
    for (const PlacedFacade& placed : scene.items<PlacedFacade>())
      traced.add(std::make_shared<const Mesh>(mesh_of(*placed.facade)),
                 std::make_shared<const FacadeSurface>(placed.facade, placed.world_from_facade,
                                                       placed.brightness / scene.exposure),
                 placed.world_from_facade, {thing++, false, placed.is_visible, true});
  };
  return kind;
}

}  // namespace parvis::facades
