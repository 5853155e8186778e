// Any bytes as a packed file: their content or errors.
#include "formats/readers/packed_file.h"

#include "base/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static parvis::FuzzFile file(".gz");
  const std::filesystem::path& path = file.with(data, size);
  constexpr std::size_t front_bytes = 4096;
  (void)parvis::formats::unpacked_front(path, front_bytes);
  (void)parvis::formats::read_unpacked(path);
  return 0;
}
