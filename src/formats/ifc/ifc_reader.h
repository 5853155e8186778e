// IFC (ISO 16739), in which architects hand over buildings, through IFC++.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>

#include "base/result.h"
#include "scene/data/file_account.h"
#include "scene/data/model.h"

namespace parvis::scene {

/// IFC 2x3, 4 and, as far as it is like 4, 4X3 in the text form of STEP, in metres, z up. Each storey is a
/// node; the objects of a kind and name ("IfcWindow Casement") are parts of one name on it. Colours and
/// transparency are the file's, else those that objects of the kind usually have. Openings are cut, spaces
/// left out. A place farther than 10 km from the file's origin is moved to the scene's, and one that the file
/// puts on a map (IfcMapConversion) stands there (`Model::origin`), turned to its north. `place_deg` is
/// filled with the site's place on the earth (degrees: east, north) where the file says it. Warnings: objects
/// whose shape cannot be built. Errors: another schema, a file without bodies. IFC++ may crash on damaged
/// files: to be called through formats::isolated.
Result<Model> read_ifc(const std::filesystem::path& file, Errors& warnings,
                       std::optional<glm::dvec2>* place_deg = nullptr, const std::string& map = {},
                       FileAccount* account = nullptr);

}  // namespace parvis::scene
