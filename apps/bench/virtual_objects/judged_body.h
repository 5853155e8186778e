// Bodies whose reflections are known: vertices that a viewer sees in a body, made from chance places of its
// fine mesh, and how well a search finds those places again in the body's maps.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "reflections/reflection_search/reflection_search.h"
#include "reflections/reflector_maps/reflector_map.h"
#include "reflections/reflector_maps/surface_rays.h"

namespace parvis::bench {

using MapSearch = reflection_search::ReflectionSearch<reflector_maps::ReflectorMap>;

/// A vertex that a patch of the body is known to reflect to a viewer. In the body's frame.
struct KnownReflection {
  std::size_t patch;
  glm::vec3 viewer, vertex;
  float reach;  ///< of the vertex, in radii of the body
};

/// What one search made of all of a body's reflections.
struct SearchFigures {
  /// Between bisector and normal, on the fine mesh; none: there is no surface where the search has ended.
  std::vector<std::optional<double>> angles_deg;
  std::vector<bool> is_told;  ///< the search says that it has not found it
  double microseconds = 0.0;  ///< for each
};

/// A reflecting body with reflections that are known from its fine mesh.
class JudgedBody {
 public:
  using Search = std::function<MapSearch::PatchPoint(MapSearch&, const MapSearch::ReflectionTask&)>;

  /// `count` reflections that nothing of the body hides, their vertices at 1.1, 1.5, 2.5 and 4 radii.
  static Result<JudgedBody> make(std::string name, const Mesh& mesh, std::size_t count);

  /// As the report calls it.
  const std::string& name() const { return name_; }
  /// All known reflections.
  const std::vector<KnownReflection>& reflections() const { return reflections_; }
  /// Runs the search for every known reflection.
  SearchFigures judge(const Search& search) const;
  /// Triangles and patches, for the report.
  std::string description() const;

 private:
  std::string name_;
  std::size_t triangles_ = 0, patches_ = 0;
  std::vector<reflector_maps::ReflectorMap> maps_;
  /// Of the fine mesh: each map's own part, and beside it that of its neighbours.
  std::vector<std::unique_ptr<reflector_maps::SurfaceRays>> own_rays_, rays_around_;
  std::vector<KnownReflection> reflections_;
};

}  // namespace parvis::bench
