// Any bytes as the content of a packed facade: one whose points can be looked up, or errors.
#include "capture/facades/facade_lookup.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace parvis::facades;
  const auto facade = facade_of({reinterpret_cast<const char*>(data), size}, "input");
  if (!facade || facade->triangle_count() == 0 || facade->slot_count() > 64) return 0;
  const FacadeTexels texels(*facade);
  FacadeLookup lookup(*facade, &texels);
  for (std::uint32_t t = 0; t < std::min<std::size_t>(facade->triangle_count(), 8); ++t)
    (void)lookup.colour(t, facade->corners[3 * t], {0, 0, 1}, 0.01f, {0.3f, 0.3f});
  return 0;
}
