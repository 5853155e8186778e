// Turning a set's world: z up, metres.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "capture/photographs/oriented_points.h"

namespace parvis::photographs {

/// The direction against gravity in the world of a set, from its cameras alone: photographs are taken level,
/// so that the pictures' rows lie flat whatever the pitch. Least squares over the rows' directions (after
/// Szeliski 2006, section 2.3), with the columns' directions where all photographs look the same way; how a
/// picture was held is what EXIF says, and without it cameras turned by a quarter are recognised among
/// others. Nothing without photographs.
std::optional<glm::dvec3> up_of_cameras(const PhotographSet& set);

/// The same, corrected by the walls: their normals lie level, too, and say what pictures that all look the
/// same way leave open. Points whose normals are level to 25 degrees, then fewer, down to 3.
std::optional<glm::dvec3> up_of_place(const PhotographSet& set, const std::vector<OrientedPoint>& points);

/// Moves cameras and points: position -> scale * rotation * position + translation. `world_from_given`
/// follows.
void transform(PhotographSet& set, const glm::dmat3& rotation, double scale, glm::dvec3 translation);

/// Makes z up (`up_of_place`) by the shortest rotation. Where the frame is measured and one of its axes lies
/// within 10 degrees of up, it is turned by whole quarters and stays measured. Returns the angle between up
/// and z before, radians.
double make_z_up(PhotographSet& set, bool is_measured);

/// The factor that makes the distance between two photographs' positions `metres`. Errors name what is not in
/// the set.
Result<double> scale_of_distance(const PhotographSet& set, const std::string& a, const std::string& b,
                                 double metres);

}  // namespace parvis::photographs
