// Any bytes as a transfer of light: one that gives its bytes back and whose light can be found, or none.
#include "graphics/bounced_light/transfer.h"

#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace parvis;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const std::optional<bounced_light::Transfer> transfer = bounced_light::Transfer::from_bytes(bytes);
  if (!transfer) return 0;
  if (transfer->to_bytes() != bytes) std::abort();
  static const shading::SkyLight sky = shading::make_sky_light(ImageF(8, 4, 3, 0.5f), 1.0f, 0.0f);
  const shading::BouncedLight light = transfer->light({}, sky);
  (void)light.cell({0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 1.0f});
  return 0;
}
