#include "formats/city_models/room.h"

#include "formats/city_models/city_gml.h"
#include "formats/city_models/city_json.h"
#include "formats/city_models/osm_file_bytes.h"
#include "formats/city_models/osm_reader.h"
#include "formats/readers/content.h"
#include "formats/readers/isolated_reader.h"
#include "formats/readers/plain_account.h"

namespace parvis::city_models {
namespace {
using formats::FileContent;
using formats::ModelReading;
namespace fs = std::filesystem;

Result<FileContent> read_json(const fs::path& file, const ModelReading& reading, Errors& warnings) {
  return formats::with_plain_account(
      "CityJSON", scene::read_city_model(file, warnings, reading.max_detail, reading.place_deg, reading.map));
}

Result<FileContent> read_gml(const fs::path& file, const ModelReading& reading, Errors& warnings) {
  return formats::with_plain_account(
      "CityGML", scene::read_city_gml(file, warnings, reading.max_detail, reading.place_deg, reading.map));
}

Result<FileContent> read_map(const fs::path& file, const ModelReading& reading, Errors& warnings) {
  return formats::with_plain_account(
      "OpenStreetMap", scene::read_osm(file, warnings, reading.ground, reading.place_deg, reading.map));
}

/// On a ground, of which only the program knows the heights, the map is read by a child and assembled here.
Result<FileContent> read_map_on_ground(const fs::path& file, const ModelReading& reading, Errors& warnings) {
  static const formats::ReadModel alone = formats::isolated<read_map>();
  if (!reading.ground) return alone(file, reading, warnings);
  const Result<scene::OsmFile> osm = scene::read_osm_file_isolated(file, reading.map, warnings);
  if (!osm) return osm.errors();
  return formats::with_plain_account(
      "OpenStreetMap", scene::model_of_osm(*osm, file, warnings, reading.ground, reading.place_deg));
}

}  // namespace

void furnish(House& house) {
  formats::Readers& readers = house.get<formats::Readers>();
  constexpr formats::TakesPacked takes_packed = formats::TakesPacked::yes;
  readers.add({".json", ".jsonl", ".cityjson"}, formats::isolated<read_json>(), formats::looks_like_json,
              takes_packed);
  readers.add({".gml", ".citygml", ".xml"}, formats::isolated<read_gml>(), formats::looks_like_xml,
              takes_packed);
  readers.add({".osm"}, read_map_on_ground, formats::looks_like_xml, takes_packed);
  readers.add({".pbf"}, read_map_on_ground, formats::looks_like_osm_pbf, takes_packed);
}

}  // namespace parvis::city_models
