// A design in a photograph: what it shows, what it hides, and its shade on what the photograph shows.
#pragma once

#include <optional>
#include <string>

#include "base/image.h"
#include "capture/photographs/photograph.h"
#include "stage/stage.h"

namespace parvis::photomontage {

/// A photograph and the scene that is set into it.
struct MontageJob {
  photographs::Photograph photograph;  ///< its camera, in the scene's world
  Image8 picture;                      ///< sRGB RGBA, of the size of its lens
  Image8 in_front;  ///< grey, of the same size: 255 where something stands before the design that the scene
                    ///< does not hold; empty: nothing
  std::string design;  ///< name of the design to set in
  /// A pixel of something grey or white, from which follows the colour of the photograph's light; not given:
  /// the scene's.
  std::optional<glm::ivec2> grey;
  std::optional<double> brightness;  ///< photograph over scene, linear; not given: by what both show
};

/// The picture, and what is known of it.
struct Montage {
  Image8 picture;           ///< sRGB RGB
  double brightness = 1.0;  ///< what light of the scene was multiplied by, in luminance
  double covered = 0.0;     ///< fraction of the photograph's area that shows the design
  double shaded = 0.0;      ///< fraction that the design makes darker or brighter by more than a hundredth
};

/// Traces the scene with and without the design from the photograph's place (differential rendering: Debevec
/// 1998, section 6). Where a ray hits the design, the picture shows it in the photograph's brightness;
/// elsewhere it shows the photograph times the ratio of the two tracings: the design's shade, and light that
/// it reflects. Pixels that the design does not change keep the photograph's value. What the scene holds and
/// the photograph shows (walls, cars) hides the design behind it. Needs a current context. Errors: no such
/// design, a lens too wide, a photograph that shows nothing of the scene so that no brightness can be found,
/// a design out of sight.
Result<Montage> make_montage(stage::Stage& stage, const MontageJob& job);

}  // namespace parvis::photomontage
