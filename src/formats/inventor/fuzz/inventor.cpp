// Any bytes as an Inventor or VRML file: a model or errors, whatever becomes of the worker that Coin runs in.
#include "base/fuzz_file.h"
#include "formats/inventor/inventor_reader.h"
#include "formats/readers/isolated_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static parvis::FuzzFile file(".iv");
  static const parvis::formats::ReadModel isolated =
      parvis::formats::isolated<parvis::inventor::read_inventor>();
  parvis::Errors warnings;
  (void)isolated(file.with(data, size), {}, warnings);
  return 0;
}
