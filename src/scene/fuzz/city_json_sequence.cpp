// Any bytes as a CityJSON text sequence: a model or errors.
#include "base/fuzz_file.h"
#include "scene/model_source.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static parvis::FuzzFile file(".city.jsonl");
  parvis::Errors warnings;
  (void)parvis::scene::model_from_file(file.with(data, size), {}, warnings);
  return 0;
}
