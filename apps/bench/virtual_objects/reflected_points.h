// Where the mirrors of a scene show what stands in it: pixels whose mirror rays are known, and how far from
// there the search over reflector maps shows what those rays hit.
#pragma once

#include <functional>
#include <memory>
#include <unordered_map>
#include <vector>

#include "base/random.h"
#include "bench/virtual_objects/judged_body.h"
#include "graphics/reference/ray_scene.h"
#include "reflections/reflector_maps/reflector_map.h"
#include "reflections/reflector_maps/surface_rays.h"
#include "scene/data/scene.h"

namespace parvis::bench {

/// A point that is not shown where it is, or not at all, counts as so many pixels; so does a pixel whose
/// point is shown in another place, too, where the mirror does not show it.
inline constexpr double missed_px = 100.0;

/// How far from the truth a search shows what mirrors show.
struct ReflectedPointErrors {
  std::vector<double>
      px;  ///< of each pixel, and beside them missed_px of each whose point is shown once more
  std::size_t missed = 0, extra = 0;
};

/// A search over one map; `layer` is search_patch's.
using PatchSearch =
    std::function<MapSearch::PatchPoint(MapSearch& search, const MapSearch::ReflectionTask& task, int layer)>;

/// Compares, at sampled pixels of a view, what mirror rays hit with where the search shows it.
class ReflectedPoints {
 public:
  /// Makes the maps of all mirrors of a scene, as the renderer does; `scene` stays where it is.
  static Result<ReflectedPoints> make(const scene::Scene& scene);

  /// For `count` chance pixels that show mirrors which show the scene: pixels between where the fine mesh,
  /// with interpolated normals, mirrors a point and where the search finds it mirrored.
  ReflectedPointErrors errors(const Camera& camera, int width, int height, std::size_t count,
                              const PatchSearch& search) const;

 private:
  /// A mirror's maps, and the fine mesh of each patch.
  struct Mirror {
    reflector_maps::Reflector reflector;
    std::vector<std::unique_ptr<reflector_maps::SurfaceRays>> patches;
  };
  /// Adds the errors of one pixel, where its mirror shows the scene.
  void judge(const Mirror& mirror, const scene::Object& object, const Camera& camera,
             const glm::mat4& pixel_from_world, glm::vec3 direction, const PatchSearch& search,
             ReflectedPointErrors& errors) const;
  /// Is a point that a search has found shown by the patch, seen by the viewer, and wrong? The patch's own
  /// mesh says so; what the search finds beyond it belongs to another patch, and is not drawn.
  static bool is_extra(const Mirror& mirror, std::size_t patch, const MapSearch::ReflectionPoint& point,
                       const MapSearch::ReflectionTask& task);

  const scene::Scene* scene_ = nullptr;
  std::unique_ptr<reference::RayScene> rays_;
  std::unordered_map<const scene::Model*, Mirror> mirrors_;
};

}  // namespace parvis::bench
