// Primitives of constructive solid geometry. A part of the module ifcplusplus.
#pragma once

class BuildingModel;
class RepresentationConverter;

namespace parvis::scene {

/// Replaces blocks and pyramids, which IFC++ centres on their corner (a pyramid at half its height), spheres,
/// whose radius it takes for metres, cylinders and cones, all of which it leaves out where they stand in no
/// boolean, by IfcFacetedBrep of the same number and style, before the geometry is converted; and
/// IfcBoxedHalfSpace, whose box only helps to compute it, by the half space.
void replace_primitives(BuildingModel& building, RepresentationConverter& converter);

}  // namespace parvis::scene
