#include "formats/city_models/city_json_clues.h"

#include <algorithm>

#include "land/heights/city_surfaces.h"

namespace parvis::scene {
namespace {

/// Calls use(index) for each vertex in lists within lists.
template <class Use>
void each_vertex(const Json& boundaries, const Use& use) {
  if (boundaries.is_number_unsigned()) use(boundaries.get<std::size_t>());
  if (!boundaries.is_array()) return;
  for (const Json& inner : boundaries) each_vertex(inner, use);
}

/// Calls use(object, geometry) for each geometry of the file's objects.
template <class Use>
void each_geometry(const Json& city, const Use& use) {
  const Json& objects = member(city, "CityObjects");
  if (!objects.is_object()) return;
  for (const Json& object : objects)
    for (const Json& geometry : member(object, "geometry")) use(object, geometry);
}

/// The kinds of the surfaces of a shell, in lists nested as its boundaries are.
struct Kinds {
  const Json* values;

  Kinds at(std::size_t i) const { return {&element(*values, i)}; }
};

/// Adds the outer rings of one geometry's roofs.
class Roofs {
 public:
  Roofs(const Json& geometry, const std::vector<glm::dvec3>& vertices) : vertices_(vertices) {
    const Json& semantics = member(geometry, "semantics");
    const Kinds kinds{semantics.is_array() ? &semantics : &member(semantics, "values")};
    each_shell(geometry, kinds, [&](const Json& surfaces, const Kinds& of_shell) {
      for (std::size_t i = 0; i < surfaces.size(); ++i) {
        rings_.push_back(outer_ring(element(surfaces, i)));
        are_roofs_.push_back(semantics_of(geometry, element(*of_shell.values, i)) == "RoofSurface");
      }
    });
  }

  bool has_named() const { return std::ranges::find(are_roofs_, true) != are_roofs_.end(); }

  void name_those_above() {
    CoordinateClues extent;
    for (const std::vector<glm::dvec3>& ring : rings_)
      for (const glm::dvec3& point : ring) extent.add(point);
    for (std::size_t i = 0; i < rings_.size(); ++i)
      are_roofs_[i] = std::ranges::all_of(
          rings_[i], [&](const glm::dvec3& point) { return point.z > 0.5 * (extent.low.z + extent.high.z); });
  }

  void add_to(CoordinateClues& clues) const {
    for (std::size_t i = 0; i < rings_.size(); ++i)
      if (are_roofs_[i]) clues.add_roof(rings_[i]);
  }

 private:
  std::vector<glm::dvec3> outer_ring(const Json& surface) const {
    std::vector<glm::dvec3> ring;
    each_vertex(element(surface, 0), [&](std::size_t index) {
      if (index < vertices_.size()) ring.push_back(vertices_[index]);
    });
    return ring;
  }

  const std::vector<glm::dvec3>& vertices_;
  std::vector<std::vector<glm::dvec3>> rings_;
  std::vector<bool> are_roofs_;
};

}  // namespace

std::vector<bool> named_vertices(const Json& city, std::size_t vertex_count) {
  std::vector<bool> is_named(vertex_count, false);
  each_geometry(city, [&](const Json&, const Json& geometry) {
    each_vertex(member(geometry, "boundaries"), [&](std::size_t index) {
      if (index < vertex_count) is_named[index] = true;
    });
  });
  return is_named;
}

CoordinateClues coordinate_clues(const Json& city, const std::vector<glm::dvec3>& vertices,
                                 const std::vector<bool>& is_named) {
  CoordinateClues clues;
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (is_named[i]) clues.add(vertices[i]);
  each_geometry(city, [&](const Json& object, const Json& geometry) {
    Roofs roofs(geometry, vertices);
    // Surfaces that are none of a solid are wound either way where their writer did not name them.
    if (!roofs.has_named() && is_solid(geometry) && is_building(text(member(object, "type"))))
      roofs.name_those_above();
    roofs.add_to(clues);
  });
  return clues;
}

}  // namespace parvis::scene
