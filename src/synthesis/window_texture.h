// Windows painted into facade textures: reveal, frame, panes with a hint of the room behind, sill, surround,
// shutters, railing. Curtains, blinds and shutters are random, so windows differ.
#pragma once

#include <cstdint>

#include "base/random.h"
#include "synthesis/surface_canvas.h"

namespace parvis::synthesis {

/// Moulding above a window.
enum class Hood : std::uint8_t { none, flat, keystone };

/// Dimensions and colours of a facade's windows.
struct WindowStyle {
  float width_m = 1.1f, height_m = 1.9f;
  float foot_m = 0.9f;  ///< of the opening, above the floor
  int panes_across = 2, panes_up = 3;
  Hood hood = Hood::none;
  float surround_m = 0.14f;  ///< 0: no surround
  bool has_shutters = false, has_railing = false;
  glm::vec3 trim{0.6f}, frame{0.65f}, shutter{0.2f};  ///< linear
};

/// A texel of a non-metallic material.
Texel matt(glm::vec3 colour, float height_m, float roughness = 0.8f);

/// Glass in front of a room: dark and smooth, in some windows with curtains or a blind.
void paint_glass(SurfaceCanvas& canvas, const Rect& rect, Random& random);

/// Panes in a frame, set back by `depth_m`, with occlusion by the reveal.
void paint_casement(SurfaceCanvas& canvas, const Rect& opening, int panes_across, int panes_up,
                    glm::vec3 frame, float depth_m, Random& random);

/// A window centred above `(x_m, floor_m)`, the middle of its bay at floor level.
void paint_window(SurfaceCanvas& canvas, const WindowStyle& style, float x_m, float floor_m, Random& random);

}  // namespace parvis::synthesis
