// What rays see of grown plants: every leaf and all wood, as geometry.
#include <algorithm>
#include <unordered_map>

#include "graphics/reference/mip_texture.h"
#include "graphics/shading/surface.h"
#include "life/vegetation/bark.h"
#include "life/vegetation/plant_drawable.h"
#include "life/vegetation/plant_selection.h"
#include "life/vegetation/scene_plant.h"
#include "scene/data/sun_shadows.h"
#include "synthesis/leaf_texture.h"

namespace parvis::vegetation {
namespace {

namespace shared {
using namespace parvis::shading;
#include "life/vegetation/bark_layout.glsl"
#include "life/vegetation/leaf_surface.glsl"
}  // namespace shared

scene::TracedPoint traced_point(const shading::Surface& surface, float openness) {
  scene::TracedPoint point;
  point.normal = surface.normal, point.base_colour = surface.base_colour;
  point.roughness = surface.roughness, point.translucency = surface.translucency;
  point.openness = openness;
  return point;
}

/// Leaves count as cut out, though they have no holes: what is opaque occludes whole views and hides the sky
/// from the ground, as walls do.
class LeafSurface final : public scene::TracedSurface {
 public:
  LeafSurface(std::shared_ptr<const PlantShape> shape, float scale)
      : shape_(std::move(shape)), scale_(scale) {}

  scene::TracedPoint point(const scene::TracedHit& hit) const override {
    const PlantKind& kind = shape_->kind();
    const Leaf& leaf = shape_->leaves[hit.triangle / full_leaf(kind.leaf).triangle_count()];
    const float shade = shared::vein_shade(hit.uv, kind.veins, hit.width_m / (scale_ * leaf.length_m));
    const glm::vec3 colour =
        shared::leaf_side_colour(glm::mix(kind.dark, kind.light, leaf.tint), hit.is_back);
    return traced_point(shared::leaf_surface(hit.normal, shade * colour, kind.translucency, kind.roughness),
                        leaf.openness);
  }
  scene::Alpha alpha_mode() const override { return scene::Alpha::cutout; }

 private:
  std::shared_ptr<const PlantShape> shape_;
  float scale_;  ///< of the plant in the world: its lengths are those of the shape times it
};

/// Bark. Cut out for the same reason.
class WoodSurface final : public scene::TracedSurface {
 public:
  WoodSurface(std::shared_ptr<const PlantShape> shape, float scale)
      : shape_(std::move(shape)), scale_(scale) {}

  scene::TracedPoint point(const scene::TracedHit& hit) const override {
    static const reference::MipTexture bark(bark_texture(), 0);
    const glm::vec3 texel(
        bark.sample(shared::bark_repeats * hit.uv,
                    shared::bark_repeats * hit.width_m / (scale_ * synthesis::bark_sheet_m) * bark.size().x));
    const std::uint32_t* corner = shape_->wood.indices.data() + 3 * std::size_t(hit.triangle);
    const auto& openness = shape_->wood_openness;
    const float open = glm::mix(glm::mix(openness[corner[0]], openness[corner[1]],
                                         hit.barycentric.x / std::max(1.0f - hit.barycentric.y, 1e-6f)),
                                openness[corner[2]], hit.barycentric.y);
    return traced_point(shared::bark_surface(hit.normal, texel, shape_->kind().bark), open);
  }
  scene::Alpha alpha_mode() const override { return scene::Alpha::cutout; }

 private:
  std::shared_ptr<const PlantShape> shape_;
  float scale_;  ///< of the plant in the world: its lengths are those of the shape times it
};

/// Meshes that all plants of a shape share.
struct TracedShape {
  std::shared_ptr<const Mesh> leaves, wood;
};

TracedShape traced_shape(const std::shared_ptr<const PlantShape>& shape) {
  return {std::make_shared<const Mesh>(leaf_mesh(*shape)), std::shared_ptr<const Mesh>(shape, &shape->wood)};
}

}  // namespace

scene::TracedKind traced_plants() {
  scene::TracedKind kind;
  kind.name = "grown plants";
  kind.count = [](const scene::Scene& scene) { return int(scene_plants(scene).size()); };
  kind.trace = [](const scene::Scene& scene, scene::TracedScene& traced) {
    std::unordered_map<const PlantShape*, TracedShape> shapes;
    const auto& shadows = scene.data<scene::SunShadows>();
    const ScenePlants& plants = scene.data<ScenePlants>();
    for (std::size_t i = 0; i < plants.items.size(); ++i) {
      const ScenePlant& plant = plants.items[i];
      const scene::TracedPlacing placing{int(i), false, plant.is_visible,
                                         shadows.casts_item_of(plants.makers[i])};
      TracedShape& shape = shapes[plant.shape.get()];
      if (!shape.leaves) shape = traced_shape(plant.shape);
      const float scale = placed(plant, 0).scale;
      traced.add(shape.leaves, std::make_shared<const LeafSurface>(plant.shape, scale),
                 plant.world_from_plant, placing);
      if (shape.wood->triangle_count() > 0)
        traced.add(shape.wood, std::make_shared<const WoodSurface>(plant.shape, scale),
                   plant.world_from_plant, placing);
    }
  };
  return kind;
}

}  // namespace parvis::vegetation
