// Bodies whose faces are bounded by edges. A part of the module ifcplusplus.
#pragma once

#include <functional>
#include <string>

class BuildingModel;
class RepresentationConverter;

namespace parvis::scene {

/// Replaces breps and surface models whose faces are bounded by edges or a vertex (IfcEdgeLoop: every
/// IfcAdvancedBrep), of which IFC++ makes nothing, and those with voids, which it loses, by IfcFacetedBrep of
/// the same number and style, before the geometry is converted: plane faces with their holes, and curved ones
/// in strips (ifc_curved_surfaces.h). Bodies with faces on other surfaces stand without these; `complain`
/// gets the number of each such entity and its fault.
void replace_edge_loops(BuildingModel& building, RepresentationConverter& converter,
                        const std::function<void(int, const std::string&)>& complain);

}  // namespace parvis::scene
