// The scene of the light in which a place was photographed.
#include <cmath>

#include "base/files.h"
#include "base/image_io.h"
#include "capture/facades/photographed_light.h"

namespace parvis::facades {
namespace {

constexpr const char* light_first_line =
    "// Written by parvis facade light. Take this line out to keep your changes.\n";

std::string light_text(const PhotographedLight& light) {
  std::string text = light_first_line;
  if (light.is_overcast)
    // What a sky of clouds shades is shaded from above: the brightest part of such a sky is the zenith.
    text += fmt::format(
        "// Overcast: what the photographs show in shadow agrees with no sun (best agreement {:.2f}). The "
        "sun in "
        "the zenith gives no light,\n// and says where things that are inserted shade the ground.\n"
        "sun(direction=\"0 0 1\", irradiance=\"0 0 0\")\n",
        light.agreement);
  else
    text += fmt::format(
        "// The sun whose shadows are those of the photographs (agreement {:.2f}).\n"
        "sun(direction=\"{:.4f} {:.4f} {:.4f}\", irradiance=\"{:.3f} {:.3f} {:.3f}\")\n",
        light.agreement, light.to_sun.x, light.to_sun.y, light.to_sun.z, light.sun_irradiance.x,
        light.sun_irradiance.y, light.sun_irradiance.z);
  return text + "sky(file=\"light.hdr\")\nexposure(value=1)  // of the photographs\n";
}

}  // namespace

Status write_photographed_light(const std::filesystem::path& folder, const PhotographedLight& light) {
  const std::filesystem::path scene = folder / "light.xp";
  std::error_code code;
  if (std::filesystem::exists(scene, code)) {
    const Result<std::string> there = read_file(scene);
    if (!there) return there.errors();
    if (!there->starts_with(light_first_line))
      return error("{}: it was changed by hand, and is kept; move it away to have it written again",
                   scene.string());
  }
  if (Status status = write_image(folder / "light.hdr", light.sky); !status) return status;
  return write_file(scene, light_text(light));
}

}  // namespace parvis::facades
