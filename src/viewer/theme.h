// How the panel looks: colours, spacing and fonts of Dear ImGui.
#pragma once

#include <imgui.h>

namespace parvis::viewer {

struct Fonts {
  ImFont* text = nullptr;
  ImFont* heading = nullptr;
};

/// Colours that are not ImGui's own.
inline const ImVec4 accent(0.91f, 0.66f, 0.33f, 1.0f);  ///< the ochre of a sunlit wall
inline const ImVec4 dim_text(0.60f, 0.62f, 0.65f, 1.0f);
inline const ImVec4 error_text(1.0f, 0.50f, 0.42f, 1.0f);

/// Dresses the current ImGui context: sizes times `scale`, letters drawn for `pixels_a_point` pixels of the
/// framebuffer a unit. Fonts are Inter, else DejaVu Sans, else ImGui's own. May be called again when the
/// scale changes, before a frame.
Fonts apply_theme(float scale, float pixels_a_point = 1.0f);

}  // namespace parvis::viewer
