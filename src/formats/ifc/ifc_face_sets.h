// Polygonal face sets with holes. A part of the module ifcplusplus.
#pragma once

class BuildingModel;

namespace parvis::scene {

/// Replaces IfcPolygonalFaceSet that has faces with holes (IfcIndexedPolygonalFaceWithVoids), which end
/// IFC++, by IfcFacetedBrep of the same number and style, before the geometry is converted.
void replace_face_sets(BuildingModel& building);

}  // namespace parvis::scene
