// Any bytes as a COLMAP model: a set or errors. Two numbers in front say where the three files begin.
#include <algorithm>
#include <cstring>

#include "capture/photographs/colmap_set.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace parvis::photographs;
  std::uint16_t ends[2] = {};
  if (size < sizeof ends) return 0;
  std::memcpy(ends, data, sizeof ends);
  const std::string_view bytes(reinterpret_cast<const char*>(data) + sizeof ends, size - sizeof ends);
  const std::size_t first = std::min<std::size_t>(ends[0], bytes.size());
  const std::size_t second = std::clamp<std::size_t>(ends[1], first, bytes.size());
  const ColmapFiles files{std::string(bytes.substr(0, first)),
                          std::string(bytes.substr(first, second - first)),
                          std::string(bytes.substr(second))};
  if (const auto model = parse_colmap_binary(files, ""))
    (void)colmap_model_of(photograph_set_of(*model, "").set);
  return 0;
}
