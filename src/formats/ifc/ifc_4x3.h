// IFC 4X3, which IFC++ does not know, in the words of IFC 4: buildings are described alike in both.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace parvis::scene {

enum class IfcSchema : std::uint8_t {
  known,   ///< to IFC++
  ifc_4x3  ///< to be written as IFC 4 first
};

/// The schema in a file's header, "FILE_SCHEMA(('IFC4'))"; empty: nothing.
std::string schema_of_ifc(std::string_view text);

/// Kinds of objects and shapes that a file holds, but IFC 4 does not know, with their numbers:
/// "12 IFCPAVEMENT, 1 IFCROAD". Empty: none.
std::string kinds_beyond_ifc_4(std::string_view text);

/// The text with IFC 4's name in its header, and with the attributes of triangulated faces in IFC 4's order:
/// 4X3 has the second and the third exchanged. Faces that are written as in IFC 4 stay.
std::string ifc_4_of_4x3(std::string text);

}  // namespace parvis::scene
