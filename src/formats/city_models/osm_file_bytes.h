// OpenStreetMap's elements as flat bytes, and a file of them read in a child process.
#pragma once

#include <string>
#include <string_view>

#include "formats/city_models/osm_file.h"

namespace parvis::scene {

/// All elements; numbers as they lie in memory.
std::string bytes_of(const OsmFile& osm);

/// The elements that `bytes_of` has written. The bytes are not trusted: counts end with them, and places must
/// be finite. `subject` stands in errors.
Result<OsmFile> osm_file_of(std::string_view bytes, const std::string& subject);

/// `read_osm_file` in a child process (isolated_reader.h), for models that the program itself assembles
/// because they stand on a ground whose heights only it knows.
Result<OsmFile> read_osm_file_isolated(const std::filesystem::path& file, const std::string& map,
                                       Errors& warnings);

}  // namespace parvis::scene
