// Profiles that IFC++ draws wrongly or not at all, as polylines. A part of the module ifcplusplus.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <vector>

class BuildingModel;
class IfcProfileDef;
class RepresentationConverter;

namespace parvis::scene {

/// A closed polygon in the plane of a profile, metres.
using Outline = std::vector<glm::dvec2>;

/// The rings of a profile, the outer one counter-clockwise, the others clockwise. Throws what IFC++ throws.
std::vector<Outline> rings_of(std::shared_ptr<IfcProfileDef> profile, RepresentationConverter& converter);

/// Replaces IfcAsymmetricIShapeProfileDef, which IFC++ does not know, IfcMirroredProfileDef, which it does
/// not mirror, and IfcCenterLineProfileDef, whose corners it cuts, by IfcArbitraryClosedProfileDef wherever a
/// profile stands, before the geometry is converted. Fillets of the first are left out.
void replace_profiles(BuildingModel& building, RepresentationConverter& converter);

}  // namespace parvis::scene
