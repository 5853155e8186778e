// Reflection points in double precision, all of them: the truth that searches are judged by.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace parvis::reflection_search {

/// Points of the unit ball about the origin where a viewer sees a vertex reflected: the roots of Alhazen's
/// quartic on which both lie before the tangent plane (behind it, if the ball is concave). Neither point lies
/// at the origin.
std::vector<glm::dvec3> reflections_on_ball(glm::dvec3 viewer, glm::dvec3 vertex, bool is_concave);

/// Points of the ellipsoid of these radii about the origin, seen from outside, by Newton's method from
/// `starts` places all over it.
std::vector<glm::dvec3> reflections_on_ellipsoid(glm::dvec3 radii, glm::dvec3 viewer, glm::dvec3 vertex,
                                                 int starts = 100);

/// Points of the torus about the z axis, a tube of radius `tube` round a circle of radius `ring`; in the same
/// way.
std::vector<glm::dvec3> reflections_on_torus(double ring, double tube, glm::dvec3 viewer, glm::dvec3 vertex);

/// Radians between the bisector of the directions to viewer and vertex and the normal; pi for a vertex and a
/// viewer that are on different sides of the surface, unless the vertex stands for its mirror image.
double bisector_angle(glm::dvec3 position, glm::dvec3 normal, glm::dvec3 viewer, glm::dvec3 vertex);

}  // namespace parvis::reflection_search
