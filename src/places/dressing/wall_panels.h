// Walls of a city model as panels: the parts of a house's front that share their storeys.
#pragma once

#include <cstddef>
#include <vector>

#include "places/dressing/model_triangles.h"

namespace parvis::dressing {

/// A wall that goes around a curve in facets, each of which is a panel (round_walls.h), as a panel of it has
/// it. A panel that is no facet is a run by itself.
struct WallRun {
  std::size_t first = 0;  ///< number of the run's first panel
  float place_m = 0.0f;   ///< of that panel, by which the runs of a building differ
  float before_m = 0.0f;  ///< length of the facets before this one
  float length_m = 0.0f;  ///< of all facets
  int facets = 1;
  bool is_ring = false;                             ///< the last facet ends where the first begins
  bool is_even = false;                             ///< all facets are as wide
  glm::vec3 first_normal{0.0f}, last_normal{0.0f};  ///< unit; of the curve, at both ends of this facet
};

/// A part of a wall in one plane, between two vertical lines, whose top has no step.
struct WallPanel {
  std::vector<std::size_t> triangles;  ///< into the walls; they may reach beyond the panel's sides
  glm::vec3 normal{0.0f};              ///< unit, level, outward
  float offset_m = 0.0f;               ///< of its plane from the origin, along the normal
  glm::vec3 along{0.0f};               ///< unit, level
  glm::vec2 low{0.0f}, high{0.0f};     ///< metres: places along `along`, and heights
  float eaves_m = 0.0f;                ///< height up to which the panel has its full width
  std::size_t building = 0;            ///< equal for connected walls
  scene::BuildingKind kind{};          ///< equal within a panel
  bool has_openings = false;           ///< of the model itself
  bool is_party_wall = false;          ///< another house stands right before it
  bool stands_on_ground = true;        ///< false: on a roof, or it hangs
  bool hangs = false;                  ///< in the air, over an underside: of a bridge, above a passage
  WallRun run{};
};

/// Wide and high enough for a window or a door, with its run.
bool is_large(const WallPanel& panel);

/// The panels of all walls. The polygons of the file, kinds of buildings, and steps of their tops, separate
/// the walls of a row of houses in one plane. `openings` are points on the model's own windows and doors.
/// Openings and other houses are sought for large panels alone.
std::vector<WallPanel> wall_panels(const std::vector<ModelTriangle>& walls,
                                   const std::vector<glm::vec3>& openings = {});

}  // namespace parvis::dressing
