// Any bytes as a PBF file of OpenStreetMap: a model or errors.
#include "base/fuzz_file.h"
#include "formats/city_models/osm_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static parvis::FuzzFile file(".pbf");
  parvis::Errors warnings;
  (void)parvis::scene::read_osm(file.with(data, size), warnings);
  return 0;
}
