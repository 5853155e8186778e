// Any bytes as a picture: pixels or errors.
#include "base/fuzz_file.h"
#include "base/image_io.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static parvis::FuzzFile png(".png"), jpeg(".jpg"), hdr(".hdr");
  for (parvis::FuzzFile* file : {&png, &jpeg, &hdr}) (void)parvis::read_image_float(file->with(data, size));
  return 0;
}
