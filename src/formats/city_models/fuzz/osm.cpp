// Any bytes as an OpenStreetMap file: a model or errors.
#include "base/fuzz_file.h"
#include "formats/city_models/osm_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static parvis::FuzzFile file(".osm");
  parvis::Errors warnings;
  (void)parvis::scene::read_osm(file.with(data, size), warnings);
  return 0;
}
