// Appearance of the panel: colours, spacing and fonts of Dear ImGui.
#pragma once

#include <imgui.h>

namespace parvis::viewer {

/// Fonts of the panel; owned by ImGui's font atlas.
struct Fonts {
  ImFont* text = nullptr;
  ImFont* heading = nullptr;
};

/// Colours that are not ImGui's own.
inline const ImVec4 accent(0.91f, 0.66f, 0.33f, 1.0f);     ///< the ochre of a sunlit wall
inline const ImVec4 dim_text(0.60f, 0.62f, 0.65f, 1.0f);   ///< labels and remarks
inline const ImVec4 error_text(1.0f, 0.50f, 0.42f, 1.0f);  ///< error messages

/// Applies colours, spacing and fonts to the current ImGui context: sizes are multiplied by `scale`, glyphs
/// are rasterised for `pixels_per_point` framebuffer pixels per unit. Fonts are Inter, else DejaVu Sans, else
/// ImGui's own. May be called again between frames when the scale changes.
Fonts apply_theme(float scale, float pixels_per_point = 1.0f);

}  // namespace parvis::viewer
