// CityGML 1 to 3 through libcitygml, as the same kind of model as CityJSON
// (formats/city_models/city_assembly.h).
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>

#include "base/result.h"
#include "scene/data/file_account.h"
#include "scene/data/model.h"

namespace parvis::scene {

/// Takes each object's highest level of detail, or the highest not above `max_detail`, of which the surfaces
/// that bound an object (walls, windows) count as its own. Of several themes the first counts. A missing
/// picture is a warning. Errors: XML with a DOCTYPE or that is not well-formed (line named), another
/// outermost element than CityModel, a file without polygons. Coordinates in degrees or feet become metres
/// (city_coordinates.h); `place_deg` is filled with the place on the earth where the file says it.
Result<Model> read_city_gml(const std::filesystem::path& file, Errors& warnings,
                            std::optional<double> max_detail = {},
                            std::optional<glm::dvec2>* place_deg = nullptr, const std::string& map = {},
                            FileAccount* account = nullptr);

}  // namespace parvis::scene
