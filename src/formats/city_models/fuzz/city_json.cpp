// Any bytes as a CityJSON file: a model or errors.
#include "formats/city_models/city_json.h"

#include "base/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static parvis::FuzzFile file(".city.json");
  parvis::Errors warnings;
  (void)parvis::scene::read_city_model(file.with(data, size), warnings);
  return 0;
}
