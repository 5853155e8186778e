// Arcs that IFC++ follows wrongly, as polylines. A part of the module ifcplusplus.
#pragma once

class BuildingModel;
class RepresentationConverter;

namespace parvis::scene {

/// Replaces the circles and ellipses below trimmed curves by polylines, before the geometry is converted:
/// IFC++ measures trimming points in the world's axes in place of the conic's, loses those at its height, and
/// trims no ellipse. Segments of composite curves that run against their curve (SameSense) are turned round.
void replace_arcs(BuildingModel& building, RepresentationConverter& converter);

}  // namespace parvis::scene
