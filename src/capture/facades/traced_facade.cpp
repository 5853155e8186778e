#include <cmath>

#include "base/colour.h"
#include "capture/facades/facade_lookup.h"
#include "capture/facades/placed_facade.h"
#include "capture/photographs/shadow_strength.h"
#include "graphics/shading/recorded_light.h"
#include "graphics/shading/recorded_shadow.h"
#include "scene/data/scene.h"
#include "scene/data/sun_shadows.h"

namespace parvis::facades {
namespace {

/// A facade's photographs, as a surface that depends on the view.
class FacadeSurface final : public scene::TracedSurface {
 public:
  FacadeSurface(const PlacedFacade& placed, float exposure, std::size_t first_triangle)
      : facade_(placed.facade),
        texels_(*facade_),
        facade_from_world_(glm::inverse(placed.world_from_facade)),
        scale_(glm::length(glm::vec3(facade_from_world_[0]))),
        radiance_of_exposed_(placed.brightness / exposure),
        kept_in_shadow_(placed.kept_in_shadow),
        has_holes_(has_holes(*facade_)),
        first_triangle_(first_triangle) {}

  scene::TracedPoint point(const scene::TracedHit& hit) const override {
    scene::TracedPoint point;
    // Photographs have recorded reflections, too: a black metal adds none where it faces the viewer.
    point.normal = hit.to_viewer;
    point.base_colour = glm::vec3(0.0f), point.metallic = 1.0f, point.roughness = 1.0f;
    const glm::vec3 srgb = glm::clamp(glm::vec3(colour(hit)), 0.0f, 1.0f);
    const glm::vec3 exposed = shading::tone_unmapped(linear_from_srgb(srgb));
    point.emission = radiance_of_exposed_ * exposed;
    const std::uint8_t lit = facade_->lit_of_triangle(first_triangle_ + hit.triangle);
    point.kept_in_shadow = kept_in_shadow_of(kept_in_shadow_, photographs::decoded_luminance(lit), exposed);
    return point;
  }
  float alpha(const scene::TracedHit& hit) const override { return colour(hit).w; }
  scene::Alpha alpha_mode() const override {
    return has_holes_ ? scene::Alpha::cutout : scene::Alpha::opaque;
  }

 private:
  glm::vec4 colour(const scene::TracedHit& hit) const {
    FacadeLookup lookup(*facade_, &texels_);
    const glm::vec3 position(facade_from_world_ * glm::vec4(hit.position, 1.0f));
    const glm::vec3 to_eye = glm::normalize(glm::mat3(facade_from_world_) * hit.to_viewer);
    return lookup.colour(std::uint32_t(first_triangle_) + hit.triangle, position, to_eye,
                         scale_ * hit.width_m, hit.barycentric);
  }

  std::shared_ptr<const PackedFacade> facade_;
  FacadeTexels texels_;
  glm::mat4 facade_from_world_;
  float scale_, radiance_of_exposed_, kept_in_shadow_;
  bool has_holes_;
  std::size_t first_triangle_;  ///< of the facade, at which the mesh begins
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
  hash.add(kept_in_shadow);
  hash.add(max_texture_bytes);
  if (!facade) return;
  hash.add(facade->corners), hash.add(facade->lists), hash.add(facade->tiles), hash.add(facade->blocks);
  for (const PackedPhoto& photo : facade->photos) {
    hash.add(photo.view.centre), hash.add(photo.view.camera_from_world), hash.add(photo.view.fx);
    hash.add(photo.balance.scale), hash.add(photo.balance.offset);
  }
}

namespace {

/// The mesh of triangles [first, last).
Mesh part_of(const Mesh& mesh, std::size_t first, std::size_t last) {
  Mesh part;
  for (std::size_t i = 3 * first; i < 3 * last; ++i) {
    part.indices.push_back(std::uint32_t(part.positions.size()));
    part.positions.push_back(mesh.positions[i]), part.normals.push_back(mesh.normals[i]);
    part.uvs.push_back(mesh.uvs[i]);
  }
  return part;
}

/// Its surfaces, and apart from them the backdrop, which never casts a shadow.
void add_traced(const PlacedFacade& placed, float exposure, int thing, bool casts_shadow,
                scene::TracedScene& traced) {
  const PackedFacade& facade = *placed.facade;
  const Mesh mesh = mesh_of(facade);
  const auto surface = [&](std::size_t first) {
    return std::make_shared<const FacadeSurface>(placed, exposure, first);
  };
  const auto is_backdrop = [&](std::size_t t) {
    return facade.surfaces[facade.surface_of_triangle[t]] == backdrop_name;
  };
  for (std::size_t first = 0, last = 0; first < facade.triangle_count(); first = last) {
    for (last = first; last < facade.triangle_count() && is_backdrop(last) == is_backdrop(first);) ++last;
    traced.add(std::make_shared<const Mesh>(part_of(mesh, first, last)), surface(first),
               placed.world_from_facade,
               {thing, false, placed.is_visible, casts_shadow && !is_backdrop(first), is_backdrop(first)});
  }
}

}  // namespace

scene::TracedKind traced_facades() {
  scene::TracedKind kind;
  kind.name = "facades";
  kind.is_recorded = true;
  kind.count = [](const scene::Scene& scene) { return int(scene.items<PlacedFacade>().size()); };
  kind.trace = [](const scene::Scene& scene, scene::TracedScene& traced) {
    const auto& [facades, makers] = scene.data<scene::ItemsOf<PlacedFacade>>();
    const auto& shadows = scene.data<scene::SunShadows>();
    for (std::size_t i = 0; i < facades.size(); ++i)
      add_traced(facades[i], scene.exposure, int(i), shadows.casts_item_of(makers[i]), traced);
  };
  return kind;
}

}  // namespace parvis::facades
