// Bodies of plane faces that stand in the place of bodies that IFC++ builds wrongly or not at all. A part of
// the module ifcplusplus.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <unordered_map>
#include <vector>

class BuildingEntity;
class BuildingModel;
class IfcBooleanOperand;
class IfcFacetedBrep;
class IfcPositiveLengthMeasure;

namespace parvis::scene {

/// The corners of a closed polygon, metres.
using Ring = std::vector<glm::dvec3>;

/// Plane faces: the first ring of each runs counter-clockwise seen from outside, the others are holes.
using Faces = std::vector<std::vector<Ring>>;

/// The same polygon, which faces the other way.
Ring reversed(Ring ring);

/// Appends the side between two rings of the same number of corners, the first below the second where they
/// run counter-clockwise seen from above: of quadrilaterals where they are plane, else of triangles.
void add_side(const Ring& below, const Ring& above, bool is_plane, Faces& faces);

/// A body of `faces` in the file's unit.
std::shared_ptr<IfcFacetedBrep> brep_of(const Faces& faces, double metres_per_unit);

/// Metres; zero where the file does not say, or no finite number.
double metres_of(const std::shared_ptr<IfcPositiveLengthMeasure>& length, double metres_per_unit);

/// Bodies by the entities of the file that they replace.
class ReplacedBodies {
 public:
  /// Lets `body` have number, style and layer of `entity`, a representation item.
  void add(const BuildingEntity& entity, const std::shared_ptr<IfcFacetedBrep>& body);

  /// Puts all of them wherever a body can stand: representations, operands of booleans, styles.
  void put_into(BuildingModel& building) const;

 private:
  std::unordered_map<const BuildingEntity*, std::shared_ptr<IfcFacetedBrep>> bodies_;
};

}  // namespace parvis::scene
