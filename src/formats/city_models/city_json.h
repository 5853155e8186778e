// CityJSON 0.2 to 2.0: buildings, terrain, roads and the rest as one model, in metres about a local origin
// that is kept; and its text sequences (.city.jsonl). What becomes of the polygons:
// formats/city_models/city_assembly.h.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>

#include "base/result.h"
#include "scene/data/file_account.h"
#include "scene/data/model.h"

namespace parvis::scene {

/// Takes each object's highest level of detail, or the highest not above `max_detail` (the lowest, where all
/// are above). Of several themes of materials or pictures the file's default one counts, else the first.
/// Surfaces without semantics are named after their object's type, those of buildings by their slope. Objects
/// of extensions ("+Pavilion") are taken by their geometry. Objects without polygons and templates that are
/// not there are named in `warnings`; a file without any polygon, an unknown version and an index out of
/// range are errors. Coordinates in degrees or feet become metres (city_coordinates.h); `place_deg` is filled
/// with the place on the earth (degrees: east, north) where the file says it.
Result<Model> read_city_model(const std::filesystem::path& file, Errors& warnings,
                              std::optional<double> max_detail = {},
                              std::optional<glm::dvec2>* place_deg = nullptr, const std::string& map = {},
                              FileAccount* account = nullptr);

}  // namespace parvis::scene
