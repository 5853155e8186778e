// Curves of IFC that IFC++ does not know, in the words of those that it knows.
#pragma once

#include <string>

namespace parvis::scene {

/// The text of a file with each IfcIndexedPolyCurve, the usual outline of IFC 4, as an IfcPolyline of the
/// same number: wherever a curve can stand, it is a line of points. Arcs go through their three points, in
/// steps of 7.5 degrees at most, and end at each of the three. Curves whose points cannot be found stay as
/// they are.
std::string with_plain_curves(std::string text);

}  // namespace parvis::scene
