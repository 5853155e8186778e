// Capital letters and digits for shop signs and number plates.
#pragma once

#include <string_view>

#include "synthesis/surface_canvas.h"

namespace parvis::synthesis {

/// Width in metres of `text` in letters of `height_m`.
float lettering_width(std::string_view text, float height_m);

/// Paints `text` (A-Z, 0-9, spaces) with its foot at the left corner `(x_m, y_m)`.
void paint_lettering(SurfaceCanvas& canvas, std::string_view text, float x_m, float y_m, float height_m,
                     const Texel& material);

}  // namespace parvis::synthesis
