// Any bytes as a picture: pixels or errors. The decoder itself, not the child process that protects users
// from it.
#include <string>

#include "base/picture_codec.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  for (const std::string name : {"a.png", "a.tga"}) {
    (void)parvis::decode_image8({data, size}, name);
    (void)parvis::decode_image_float({data, size}, name);
  }
  return 0;
}
