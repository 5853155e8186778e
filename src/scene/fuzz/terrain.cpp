// Any bytes as a GeoTIFF grid of heights: a model or errors.
#include "base/fuzz_file.h"
#include "scene/model_source.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static parvis::FuzzFile file(".tif");
  parvis::Errors warnings;
  (void)parvis::scene::model_from_file(file.with(data, size), {.cell_m = 1.0}, warnings);
  return 0;
}
