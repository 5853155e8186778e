// Arcs that IFC++ follows wrongly, as polylines. A part of the module ifcplusplus.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

class BuildingModel;
class IfcCurve;
class RepresentationConverter;

namespace parvis::scene {

/// The points of a circle or an ellipse between two places on it, metres, along growing angles or against
/// them; a whole turn where they are one place. Nothing where `curve` is neither.
std::optional<std::vector<glm::dvec3>> arc_between(const IfcCurve& curve,
                                                   const std::array<glm::dvec3, 2>& ends, bool is_forward,
                                                   RepresentationConverter& converter, double unit_m);

/// Takes angles of a file that names no unit of angles for radians, as IFC does, or, where a solid turns by
/// more than a whole turn of them, for degrees. IFC++ takes those from half a turn on for degrees.
void settle_unit_of_angles(BuildingModel& building);

/// Replaces what lies below trimmed curves by polylines, before the geometry is converted: IFC++ measures
/// trimming points of circles in the world's axes in place of the conic's, loses those at its height, trims
/// neither ellipses nor B-splines nor polylines, and moves the end of a line that is trimmed at its
/// beginning. B-splines are made straight between their points (ifc_splines.h). Segments of composite curves
/// that run against their curve (SameSense) are turned round.
void replace_trimmed_curves(BuildingModel& building, RepresentationConverter& converter);

}  // namespace parvis::scene
