// Edges of large polygons are curved in a curved mirror, and only corners are mirrored exactly (section 8):
// what stands near a reflector is divided until each straight piece is off by less than a pixel.
#pragma once

#include <span>

#include "scene/data/scene.h"

namespace parvis::virtual_objects {

/// A reflector as the ball about it, in the world.
struct ReflectorBall {
  glm::vec3 centre;
  float radius;
  bool is_glass = false;  ///< solid: it enlarges what stands near its focus
};

/// The mesh with long edges halved, again and again: long beside their distance from a ball, so that their
/// image is off by a pixel (720 rows, a viewer at 3 radii). Both sides of an edge are divided alike, so no
/// cracks open. Ends early, still without cracks, before there are more than `max_triangles`.
Mesh with_short_edges(const Mesh& mesh, const glm::mat4& world_from_mesh,
                      std::span<const ReflectorBall> balls, std::size_t max_triangles);

/// Divides what a scene's reflectors show; models that several objects share are divided for all of
/// them. A reflector that moves stands for where it begins.
void divide_long_edges(scene::Scene& scene);

}  // namespace parvis::virtual_objects
