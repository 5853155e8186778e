// Mattes of photographs: alpha and pure foreground (003_d5b01da2d2f805f6, section 4.4; after Ruzon and
// Tomasi, Alpha Estimation in Natural Images, CVPR 2000).
#pragma once

#include <string>
#include <vector>

#include "base/image.h"
#include "base/result.h"

namespace parvis::trees {

/// The content that a pixel is known to show.
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

/// Zones of a photograph before the sky, whose brightness may change from row to row: background is what
/// continues the colours at the upper edge or looks like the sky beside it, foreground what is far from them.
/// What is below the horizon counts as foreground; paint it where it is no tree. Errors: no sky at the upper
/// edge.
Result<Zones> zones_of_sky(const Image8& photograph, const std::string& name);

/// True where a picture has a matte of its own: an alpha that is neither the same everywhere nor missing.
bool has_matte(const Image8& picture);

/// How alpha is found between the zones.
enum class MatteMethod : std::uint8_t {
  clusters,  ///< the thesis: mixtures of clusters in CIE LAB
  /// The matting Laplacian (matting_laplacian.h): alpha flows along what looks alike. For colours that both
  /// zones have.
  laplacian,
};

/// RGBA of a photograph (RGB or RGBA, sRGB; its own alpha is not used): straight pure foreground and alpha.
/// Colours of both zones are clustered in CIE LAB; an unknown pixel is a mixture of the pair of clusters
/// whose line passes nearest to its colour (equation 4.3). Errors: a matte that is all 0 or all 255.
Result<Image8> matte(const Image8& photograph, const Zones& zones, const std::string& name,
                     MatteMethod method = MatteMethod::clusters);

}  // namespace parvis::trees
