// How dark shadows are in photographs, so that those of inserted things can be as dark (thesis,
// section 5.3.4: "consistent in intensity with those existing in the textures of the real scene").
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

namespace parvis::photographs {

/// The fraction of light that is left in a shadow where no photograph shows one: about the share of the sky
/// in the light of a level place on a clear day with the sun at 35 degrees.
inline constexpr float kept_in_usual_shadow = 0.3f;

/// One surface in photographs that show it partly in the sun and partly in shadow.
struct LitAndShaded {
  float lit = 1.0f;     ///< luminance in the sun, of the radiance that the display shows as exposed 1
  float kept = 1.0f;    ///< luminance in shadow over that in the sun
  float weight = 0.0f;  ///< how many colours it was found from
};

/// Divides the colours of one surface (linear radiance) into lit and shaded by the threshold that separates
/// the logarithms of their luminance best (Otsu 1979). None where there are not two classes: either holds
/// less than a twentieth, they overlap, or the difference cannot be a shadow's: it leaves between 5 and 65 %
/// of the light, and the sky that lights it is not redder than the sun.
std::optional<LitAndShaded> lit_and_shaded(std::span<const glm::vec3> radiances);

/// The fraction of light that shadows leave in all photographs: the weighted median over surfaces;
/// kept_in_usual_shadow where none shows a shadow.
float kept_in_shadows(std::span<const std::optional<LitAndShaded>> surfaces);

/// A luminance as 8 bits of its logarithm, from 2^-10 to 2^6; 0: it is not known.
std::uint8_t encoded_luminance(float luminance);
/// The luminance that such bits stand for.
float decoded_luminance(std::uint8_t bits);

}  // namespace parvis::photographs
