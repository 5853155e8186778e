// Any bytes as a CityGML file: a model or errors.
#include "formats/city_models/city_gml.h"

#include "base/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static parvis::FuzzFile file(".gml");
  parvis::Errors warnings;
  (void)parvis::scene::read_city_gml(file.with(data, size), warnings);
  return 0;
}
