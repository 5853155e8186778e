// What rays see of a captured tree: the box of each cell. Where a ray enters one, the billboard that faces
// the ray's origin says colour and opacity, as the renderer's does; a ray is stopped by the chance of that
// opacity, so that the mean of a pixel's rays is their over.
#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <unordered_map>

#include "base/colour.h"
#include "capture/trees/billboard_math.h"
#include "capture/trees/scene_tree.h"
#include "capture/trees/tree_drawable.h"
#include "graphics/shading/sky.h"
#include "graphics/shading/surface.h"
#include "scene/data/sun_shadows.h"

namespace parvis::trees {
namespace {

namespace foliage {
using namespace parvis::shading;
#include "capture/trees/foliage.glsl"
}  // namespace foliage

constexpr float sun_distance_m = 1e5f;  // an eye there sees a tree as the sun does

/// The boxes of all cells, 12 triangles each, in the tree's frame.
Mesh boxes_of(const CellGrid& grid) {
  constexpr std::uint32_t faces[6][4]{{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                      {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  Mesh mesh;
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    const Bounds box = grid.bounds(cell);
    const auto first = std::uint32_t(mesh.positions.size());
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
      mesh.positions.emplace_back(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                                  corner & 4 ? box.max.z : box.min.z);
      mesh.normals.push_back(glm::normalize(mesh.positions.back() - box.centre()));
      mesh.uvs.emplace_back(0.0f, 0.0f);
    }
    for (const auto& face : faces)
      for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u})
        mesh.indices.push_back(first + face[corner]);
  }
  return mesh;
}

/// The mean radiance of a scene's sky, computed when the first ray asks.
class MeanSky {
 public:
  explicit MeanSky(const scene::Scene& scene) : scene_(scene) {}
  glm::vec3 radiance() const {
    std::call_once(once_, [&] {
      std::array<glm::vec3, 9> sh =
          shading::make_sky_light(scene_.sky.picture, scene_.sky.intensity, scene_.sky.heading).irradiance_sh;
      radiance_ = (shading::sky_irradiance(sh.data(), glm::vec3(0, 0, 1)) +
                   shading::sky_irradiance(sh.data(), glm::vec3(0, 0, -1))) /
                  (2.0f * shading::pi);
    });
    return radiance_;
  }

 private:
  const scene::Scene& scene_;  // outlives its rays
  mutable std::once_flag once_;
  mutable glm::vec3 radiance_{0.0f};
};

class TreeSurface final : public scene::TracedSurface {
 public:
  TreeSurface(const SceneTree& tree, std::shared_ptr<const MeanSky> sky, glm::vec3 to_sun)
      : tree_(tree.tree),
        sky_(std::move(sky)),
        tree_from_world_(glm::inverse(tree.world_from_leaning_tree())),
        tree_per_world_(std::cbrt(std::abs(glm::determinant(glm::mat3(tree_from_world_))))),
        to_sun_(to_sun) {}

  scene::TracedPoint point(const scene::TracedHit& hit) const override {
    const glm::vec4 colour = colour_at(hit);
    const std::size_t cell = hit.triangle / 12;
    const CrownLight& crown = tree_->crown;
    const glm::vec3 albedo = crown.albedo_factor[0][cell] * glm::vec3(colour) / std::max(colour.w, 1e-6f);
    const shading::Surface s = foliage::foliage_surface(albedo, to_sun_, hit.to_viewer);
    const float sky_share = crown.sky[0][cell];
    scene::TracedPoint point;
    point.normal = s.normal, point.base_colour = s.base_colour;
    point.metallic = s.metallic, point.roughness = s.roughness;
    point.translucency = s.translucency, point.occlusion = sky_share * s.occlusion;
    // The tracer mirrors all of the sky that the place sees: what the crown hides of it is taken off.
    point.emission = -(1.0f - sky_share) * sky_radiance() *
                     shading::base_reflectance(s, glm::max(glm::dot(s.normal, hit.to_viewer), 1e-4f));
    return point;
  }
  float alpha(const scene::TracedHit& hit) const override {
    if (hit.is_back) return 0.0f;  // the ray leaves the cell
    return colour_at(hit).w > display::opacity_threshold(hit.position) ? 1.0f : 0.0f;
  }
  scene::Alpha alpha_mode() const override { return scene::Alpha::cutout; }

 private:
  glm::vec3 sky_radiance() const { return sky_->radiance(); }
  /// Linear, premultiplied.
  glm::vec4 colour_at(const scene::TracedHit& hit) const {
    const BillboardTree& shown = tree_->levels.front();
    const std::size_t cell = hit.triangle / 12;
    const glm::vec3 at(tree_from_world_ * glm::vec4(hit.position, 1.0f));
    const glm::vec3 centre = shown.grid.centre(cell);
    // A cell is so small that all of it is seen from one direction.
    const glm::vec3 to_eye = glm::normalize(glm::mat3(tree_from_world_) * hit.to_viewer);
    const BillboardFrame frame =
        billboard_frame(centre, shown.grid.cell_size_m(), centre + sun_distance_m * to_eye);
    const glm::vec3 off = at - centre;
    const glm::vec2 place = glm::clamp(
        glm::vec2(glm::dot(off, frame.right), glm::dot(off, frame.up)) / frame.half_size_m, -1.0f, 1.0f);
    const ClosestViews closest = closest_views(shown, centre, to_eye, int(cell));
    glm::vec4 sum(0.0f);
    for (std::size_t v = 0; v < 2; ++v) {
      if (closest.weights[v] <= 0.0f) continue;
      sum +=
          closest.weights[v] * texture_colour(shown, shown.views[std::size_t(closest.views[v])], cell, place);
    }
    const LeafDetail& detail = tree_->detail;
    if (detail.is_empty()) return sum;
    return detail.added_to(sum, LeafDetail::offset_of(cell) + place * frame.half_size_m / detail.width_m(),
                           hit.width_m * tree_per_world_);
  }

  std::shared_ptr<const TreeLevels> tree_;
  std::shared_ptr<const MeanSky> sky_;
  glm::mat4 tree_from_world_;
  float tree_per_world_;  // metres
  glm::vec3 to_sun_;
};

}  // namespace

scene::TracedKind traced_trees() {
  scene::TracedKind kind;
  kind.name = "captured trees";
  kind.count = [](const scene::Scene& scene) { return int(scene_trees(scene).size()); };
  kind.trace = [](const scene::Scene& scene, scene::TracedScene& traced) {
    std::unordered_map<const TreeLevels*, std::shared_ptr<const Mesh>> meshes;
    const auto sky = std::make_shared<const MeanSky>(scene);
    const auto& shadows = scene.data<scene::SunShadows>();
    const SceneTrees& trees = scene.data<SceneTrees>();
    for (std::size_t i = 0; i < trees.items.size(); ++i) {
      const SceneTree& tree = trees.items[i];
      std::shared_ptr<const Mesh>& mesh = meshes[tree.tree.get()];
      if (!mesh) mesh = std::make_shared<const Mesh>(boxes_of(tree.tree->levels.front().grid));
      traced.add(mesh, std::make_shared<const TreeSurface>(tree, sky, scene.sun.direction_to_sun),
                 tree.world_from_leaning_tree(),
                 {int(i), tree.sways(), tree.is_visible, shadows.casts_item_of(trees.makers[i])});
    }
  };
  return kind;
}

}  // namespace parvis::trees
