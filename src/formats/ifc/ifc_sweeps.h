// Swept bodies that IFC++ builds wrongly or not at all, as bodies of plane faces. A part of the
// module ifcplusplus.
#pragma once

#include <functional>
#include <string>

class BuildingModel;
class RepresentationConverter;

namespace parvis::scene {

/// Replaces swept disks (railings, pipes), which IFC++ gives no surface where they begin upright or shorter
/// than 0.3 m, tapered extrusions, whose end it takes for their beginning, extrusions of several profiles, of
/// which it takes all but the first for holes, and sweeps by a fixed reference or along a plane, which it
/// does not know, and sectioned spines, of which it makes nothing, by IfcFacetedBrep of the same number and
/// style, before the geometry is converted. Extrusions whose direction has another length than 1, by which
/// IFC++ multiplies their depth, take a unit one. What stays as IFC++ builds it is passed to `complain`: the
/// number of the entity, and what is wrong.
void replace_sweeps(BuildingModel& building, RepresentationConverter& converter,
                    const std::function<void(int, const std::string&)>& complain);

}  // namespace parvis::scene
