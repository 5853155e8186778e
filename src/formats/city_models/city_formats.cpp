#include "formats/city_models/city_formats.h"

#include "formats/city_models/city_gml.h"
#include "formats/city_models/city_json.h"
#include "formats/city_models/osm_reader.h"
#include "formats/readers/readers.h"

namespace parvis::scene {

void furnish_city_models(House& house) {
  formats::Readers& readers = house.get<formats::Readers>();
  readers.add({".json", ".jsonl"},
              [](const std::filesystem::path& file, [[maybe_unused]] const formats::ModelReading& reading,
                 Errors& warnings) { return read_city_model(file, warnings, reading.max_detail); });
  readers.add({".gml", ".citygml", ".xml"},
              [](const std::filesystem::path& file, [[maybe_unused]] const formats::ModelReading& reading,
                 Errors& warnings) { return read_city_gml(file, warnings, reading.max_detail); });
  readers.add({".osm", ".pbf"},
              [](const std::filesystem::path& file, [[maybe_unused]] const formats::ModelReading& reading,
                 Errors& warnings) { return read_osm(file, warnings, reading.ground); });
}

}  // namespace parvis::scene
