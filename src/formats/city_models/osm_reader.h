// OpenStreetMap files (.osm, .osm.pbf) to a Model: buildings, what lies and stands on the ground, and roads
// as centre lines.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>

#include "base/result.h"
#include "formats/city_models/osm_file.h"
#include "formats/readers/ground_on_map.h"
#include "scene/data/file_account.h"
#include "scene/data/model.h"

namespace parvis::scene {

/// Metres on `map`, or on that of the file's UTM zone, about the middle of its bounds: `Model::origin` says
/// where that is. All stands on the ground that is given, else on a level one at z = 0, which is added with
/// what lies on it. What is incomplete is reported in `warnings` by its id, and the rest is read. `place_deg`
/// is filled with the middle of the bounds (degrees: east, north), and `account` with what is not drawn.
Result<Model> read_osm(const std::filesystem::path& file, Errors& warnings, const GroundOnMap& ground = {},
                       std::optional<glm::dvec2>* place_deg = nullptr, const std::string& map = {},
                       FileAccount* account = nullptr);
/// The same from the content of `file`, which has been read.
Result<Model> model_of_osm(const OsmFile& osm, const std::filesystem::path& file, Errors& warnings,
                           const GroundOnMap& ground = {}, std::optional<glm::dvec2>* place_deg = nullptr,
                           FileAccount* account = nullptr);

}  // namespace parvis::scene
