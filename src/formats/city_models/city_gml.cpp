#include "formats/city_models/city_gml.h"

#include "formats/city_models/citygml_module.h"
#include "formats/terrain/map_system.h"

namespace parvis::scene {

Result<Model> read_city_gml(const std::filesystem::path& file, Errors& warnings,
                            std::optional<double> max_detail, std::optional<glm::dvec2>* place_deg,
                            const std::string& map, FileAccount* account) {
  if (const Status known = projections_known(); !known) return known.errors();  // its coordinates need them
  return city_gml.call(&CityGmlFunctions::read, file, warnings, max_detail, place_deg, map, account);
}

}  // namespace parvis::scene
