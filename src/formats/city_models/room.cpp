#include "base/registries.h"
#include "formats/city_models/city_gml.h"
#include "formats/city_models/city_json.h"
#include "formats/city_models/osm_file_bytes.h"
#include "formats/city_models/osm_reader.h"
#include "formats/readers/content.h"
#include "formats/readers/isolated_reader.h"
#include "formats/readers/plain_account.h"
#include "room_list.h"

namespace parvis::city_models {
namespace {
using formats::FileContent;
using formats::ModelReading;
namespace fs = std::filesystem;

/// The model that `read` makes while it fills an account, to which what the model shows is added.
template <class Read>
Result<FileContent> with_account(const char* format, const Read& read) {
  scene::FileAccount account(format);
  Result<scene::Model> model = read(&account);
  if (!model) return model.errors();
  formats::count_what_is_shown(*model, account);
  return FileContent{*std::move(model), std::move(account)};
}

Result<FileContent> read_json(const fs::path& file, const ModelReading& reading, Errors& warnings) {
  return with_account("CityJSON", [&](scene::FileAccount* account) {
    return scene::read_city_model(file, warnings, reading.max_detail, reading.place_deg, reading.map,
                                  account);
  });
}

Result<FileContent> read_gml(const fs::path& file, const ModelReading& reading, Errors& warnings) {
  return with_account("CityGML", [&](scene::FileAccount* account) {
    return scene::read_city_gml(file, warnings, reading.max_detail, reading.place_deg, reading.map, account);
  });
}

Result<FileContent> read_map(const fs::path& file, const ModelReading& reading, Errors& warnings) {
  return with_account("OpenStreetMap", [&](scene::FileAccount* account) {
    return scene::read_osm(file, warnings, reading.ground, reading.place_deg, reading.map, account);
  });
}

/// A map on a ground, whose heights only the program knows, is read by a child and assembled here.
Result<FileContent> read_map_on_ground(const fs::path& file, const ModelReading& reading, Errors& warnings) {
  static const formats::ReadModel alone = formats::isolated<read_map>();
  if (!reading.ground) return alone(file, reading, warnings);
  const Result<scene::OsmFile> osm = scene::read_osm_file_isolated(file, reading.map, warnings);
  if (!osm) return osm.errors();
  return with_account("OpenStreetMap", [&](scene::FileAccount* account) {
    return scene::model_of_osm(*osm, file, warnings, reading.ground, reading.place_deg, account);
  });
}

}  // namespace

/// Adds the readers of CityJSON, CityGML and OpenStreetMap.
void register_room(Registries& registries) {
  formats::Readers& readers = registries.get<formats::Readers>();
  constexpr formats::TakesPacked takes_packed = formats::TakesPacked::yes;
  readers.add({".json", ".jsonl", ".cityjson"}, formats::isolated<read_json>(), formats::looks_like_json,
              takes_packed);
  readers.add({".gml", ".citygml", ".xml"}, formats::isolated<read_gml>(), formats::looks_like_xml,
              takes_packed);
  readers.add({".osm"}, read_map_on_ground, formats::looks_like_xml, takes_packed);
  readers.add({".pbf"}, read_map_on_ground, formats::looks_like_osm_pbf, takes_packed);
}

}  // namespace parvis::city_models
