// Any bytes as a GeoTIFF grid of heights: a model or errors.
#include "formats/terrain/terrain.h"

#include "base/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static parvis::FuzzFile file(".tif");
  parvis::Errors warnings;
  (void)parvis::scene::read_terrain(file.with(data, size), 1.0, warnings);
  return 0;
}
