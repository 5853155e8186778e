// The bodies of an IFC file, as IFC++ builds them: all that is known of that library stands in its module
// (ifcplusplus_module, ifc_styles, ifc_arcs, ifc_breps, ifc_edge_loops, ifc_face_sets, ifc_primitives,
// ifc_profiles, ifc_sweeps, ifc_textures, ifc_georeference, ifc_text).
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "formats/ifc/ifc_georeference.h"
#include "formats/ifc/ifc_textures.h"
#include "scene/data/file_account.h"

namespace parvis::scene {

/// How a body looks, by a surface style of the file: its own, or that of the material it is made of.
struct IfcLook {
  glm::vec3 colour{0.8f};                             ///< sRGB, 0..1
  float alpha = 1.0f;                                 ///< 1: opaque
  std::optional<std::size_t> picture = std::nullopt;  ///< of IfcBodies::pictures; the colour multiplies it
};

/// Triangles of one object.
struct IfcShape {
  std::string storey;               ///< name of the storey; empty: in none
  std::string kind;                 ///< entity, "IfcWindow"
  std::string name;                 ///< of the object, without the number that modelling programs add
  std::optional<IfcLook> look;      ///< none: the file has no style for it
  bool is_closed = false;           ///< a solid, whose back is never seen
  bool is_below_ground = false;     ///< of a cellar, or a foundation
  std::vector<glm::dvec3> corners;  ///< metres in the file's world; three a triangle, counter-clockwise
  std::vector<glm::vec2> uvs;       ///< one per corner where its look has a picture, v down; else empty
};

/// The bodies of a file and its account.
struct IfcBodies {
  FileAccount account{"IFC"};
  std::vector<IfcShape> shapes;
  std::vector<IfcPicture> pictures;
  IfcGeoreference place;
};

/// The bodies of `text`, a whole file in the text form of STEP; `name` stands in errors and warnings. Every
/// triangle is finite. Spaces, openings and grids are left out, and, with a warning, what IFC 4X3 has and
/// IFC 4 has not. Errors: a schema that is none of IFC 2x3, 4 and 4X3; text that IFC++ cannot read.
Result<IfcBodies> ifc_bodies(std::string text, const std::string& name, Errors& warnings);

}  // namespace parvis::scene
