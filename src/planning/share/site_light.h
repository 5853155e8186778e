// The light of a place as a page needs it: sun, sky and exposure of moments, and the grids that say how much
// of the sky each place sees and what light surfaces reflect onto each other.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "graphics/light/day_light.h"
#include "graphics/shading/bounced_light.h"
#include "graphics/shading/sky.h"
#include "graphics/shading/sky_visibility.h"
#include "scene/data/scene.h"

namespace parvis::share {

/// Three numbers.
nlohmann::json array_of(glm::vec3 v);

/// Bytes for the GPU, and where each piece begins: JSON refers to them by offsets.
class LightBytes {
 public:
  /// Appends bytes and returns their offset, a multiple of 4.
  std::size_t add(std::string_view piece);
  const std::string& bytes() const { return bytes_; }  ///< all that were appended

 private:
  std::string bytes_;
};

/// The moment that a scene shows: sun, sky with its blurred levels (RGB9_E5), exposure.
nlohmann::json moment_json(const scene::Scene& scene, const shading::SkyLight& sky, LightBytes& bytes);

/// The sky that each cell sees, as the renderer has it (RGBA8).
nlohmann::json visibility_json(const shading::SkyVisibility& visibility, LightBytes& bytes);

/// Bounced light (RGBA16F; lobes, colours and skies above each other); null where there is none.
nlohmann::json bounced_json(const shading::BouncedLight* light, LightBytes& bytes);

/// Days of the scene's place, each with moments from dawn to dusk: the scene's own day, the equinox of March
/// and both solstices. Empty where the scene has no place on the earth. Errors: those of the sky's model.
Result<nlohmann::json> days_json(const scene::Scene& scene, LightBytes& bytes);

}  // namespace parvis::share
