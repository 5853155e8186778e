// Any bytes as an IFC file: a model or errors.
#include "base/fuzz_file.h"
#include "formats/ifc/ifc_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static parvis::FuzzFile file(".ifc");
  parvis::Errors warnings;
  (void)parvis::scene::read_ifc(file.with(data, size), warnings);
  return 0;
}
