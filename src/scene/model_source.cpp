#include "scene/model_source.h"

#include "scene/assimp_reader.h"
#include "scene/city_gml.h"
#include "scene/city_json.h"
#include "scene/gltf_reader.h"
#include "scene/osm_reader.h"
#include "scene/terrain.h"

namespace parvis::scene {

Result<Model> model_from_file(const std::filesystem::path& file, const ModelReading& reading,
                              Errors& warnings) {
  const std::string extension = file.extension().string();
  if (extension == ".glb" || extension == ".gltf") return read_gltf(file, warnings);
  if (extension == ".json" || extension == ".jsonl")
    return read_city_model(file, warnings, reading.most_detail);
  if (extension == ".tif" || extension == ".tiff") return read_terrain(file, reading.cell_m, warnings);
  if (extension == ".osm") return read_osm(file, warnings, reading.ground);
  if (extension == ".gml" || extension == ".citygml" || extension == ".xml")
    return read_city_gml(file, warnings, reading.most_detail);
  return read_with_assimp(file, reading.up, warnings);
}

}  // namespace parvis::scene
