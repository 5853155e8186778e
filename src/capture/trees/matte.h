// Mattes of photographs: alpha and pure foreground (003_d5b01da2d2f805f6, section 4.4; after Ruzon and
// Tomasi, Alpha Estimation in Natural Images, CVPR 2000).
#pragma once

#include <string>
#include <vector>

#include "base/image.h"
#include "base/result.h"

namespace parvis::trees {

/// What a pixel is known to show.
enum class Zone : std::uint8_t { unknown, background, foreground };

/// Zones of a photograph's pixels, row by row.
struct Zones {
  int width = 0, height = 0;
  std::vector<Zone> pixels;
};

/// Zones painted roughly by the user: red is background, green is foreground, all else unknown. The picture
/// may be smaller than the photograph; it is stretched. Errors: no background, or no foreground.
Result<Zones> zones_of_scribbles(const Image8& scribbles, int width, int height, const std::string& name);

/// Zones of a photograph before a plain background (white cabin, sheet, clear sky): background is what looks
/// like most of the picture's border, foreground what is far from it. Errors: a border without a common
/// colour.
Result<Zones> zones_of_plain_background(const Image8& photograph, const std::string& name);

/// RGBA of a photograph (RGB or RGBA, sRGB; its own alpha is not used): straight pure foreground and alpha.
/// Colours of both zones are clustered in CIE LAB; an unknown pixel is a mixture of the pair of clusters
/// whose line passes nearest to its colour (equation 4.3). Errors: a matte that is all 0 or all 255.
Result<Image8> matte(const Image8& photograph, const Zones& zones, const std::string& name);

}  // namespace parvis::trees
