// Any bytes as a layered picture: layers or errors.
#include "capture/facades/psd.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  (void)parvis::facades::read_psd({data, size}, "input");
  return 0;
}
