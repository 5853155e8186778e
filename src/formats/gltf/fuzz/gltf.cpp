// Any bytes as a glTF file: a model or errors.
#include "base/fuzz_file.h"
#include "formats/gltf/gltf_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static parvis::FuzzFile file(".glb");
  parvis::Errors warnings;
  (void)parvis::scene::read_gltf(file.with(data, size), warnings);
  return 0;
}
