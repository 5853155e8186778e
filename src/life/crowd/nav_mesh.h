// Where people can walk, and the way from one place to another: a navigation mesh (Recast) and searches
// through it (Detour).
//
// Recast measures heights in cells from the lowest point of its input, so that whether a kerb counts as a
// step may change with what lies below it. Here the cells are those of one lattice of the world, and the
// climb has a margin of a cell: steps up to 0.2 m connect and steps from 0.31 m on do not, at every level of
// the street. The mesh is made of tiles: memory is bounded by the tile, and an edit builds again those that
// it touches.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/result.h"
#include "life/crowd/walls.h"

namespace parvis::crowd {

/// The meaning of a triangle to people.
enum class GroundKind : std::uint8_t {
  obstacle,  ///< nobody walks on it: cars, roofs, planters
  floor,     ///< pavements, squares, steps
  road,      ///< crossed where there is nothing better
  crossing,  ///< marked for people
};

/// A straight piece of carriageway on the ground.
struct RoadStrip {
  glm::vec3 a, b;  ///< ends of its middle line
  float width_m = 3.0f;
};

/// The ground and all that stands on it, world frame, metres, z up.
struct WalkingGround {
  std::vector<glm::vec3> corners;  ///< three of each triangle; both sides count
  std::vector<GroundKind> kinds;   ///< one for each triangle
  std::vector<RoadStrip> roads;    ///< where ground is road, whatever its triangles say
  /// Where people cross those roads; with any of them nobody walks on roads elsewhere.
  std::vector<RoadStrip> crossings;
};

/// How the mesh is made.
struct NavMeshOptions {
  float cell_m = 0.12f;         ///< of the raster, in plan
  float body_radius_m = 0.24f;  ///< the mesh ends so far from walls
  float headroom_m = 1.9f;
  float max_slope_deg = 40.0f;
  float road_cost = 6.0f;  ///< of a metre of road against one of pavement
};

/// A way as corners to be walked to one after the other; the first is the start.
using Way = std::vector<glm::vec3>;

/// Where people can walk.
class NavMesh {
 public:
  /// Errors: no triangle, or none on which anybody can walk; more than 16 km from side to side or 400 m in
  /// height within a tile; positions that are not finite.
  static Result<NavMesh> create(const WalkingGround& ground, const NavMeshOptions& options = {});
  NavMesh(NavMesh&&) noexcept;
  NavMesh& operator=(NavMesh&&) noexcept;
  ~NavMesh();

  /// The shortest way by cost. Nothing where start or goal lies farther than a metre from the mesh, or there
  /// is no way.
  std::optional<Way> way(glm::vec3 from, glm::vec3 to) const;
  /// Rebuilds the tiles that the box from `low` to `high` (in plan) touches, from what `ground` holds there
  /// now.
  void update(const WalkingGround& ground, glm::vec2 low, glm::vec2 high);
  /// The place on the mesh nearest to `p`, within `reach_m` in plan and `reach_z_m` in height; nothing where
  /// there is none.
  std::optional<glm::vec3> nearest(glm::vec3 p, float reach_m = 1.0f, float reach_z_m = 1.2f) const;
  /// A place beside roads on the widest ground that hangs together, all of its area alike, by three numbers
  /// in 0..1.
  glm::vec3 place(float pick, float u, float v) const;

  /// The borders of the mesh: where the middles of bodies may not pass.
  std::vector<Wall> borders() const;
  float area_m2() const;  ///< of that ground, in plan

 private:
  struct Data;
  explicit NavMesh(std::unique_ptr<Data> data);
  std::unique_ptr<Data> data_;
};

}  // namespace parvis::crowd
