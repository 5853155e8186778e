// The module `citygml`: what of this room knows libcitygml.
#pragma once

#include "base/module.h"
#include "formats/city_models/city_gml.h"

namespace parvis::scene {

/// The functions of the module that calls libcitygml.
struct CityGmlFunctions {
  Result<Model> (*read)(const std::filesystem::path& file, Errors& warnings, std::optional<double> max_detail,
                        std::optional<glm::dvec2>* place_deg, const std::string& map, FileAccount* account);
};

/// Loaded in the workers' server when the first CityGML file is read.
inline constexpr Module<CityGmlFunctions> city_gml("citygml");

}  // namespace parvis::scene
