// A layer of a drawing as a model: lines as strips that lie flat, areas, and texts.
#pragma once

#include "formats/drawings/drawing.h"
#include "scene/data/model.h"

namespace parvis::plan_drawing {

/// The layer as a model about `origin`, a point of the drawing. Everything lies at heights of 0 to 2 cm, so
/// that lines lie over areas and layers over each other; it casts no shadow and no ground is found on it.
/// `line_width_m`: of lines without a width of their own. No parts: the layer draws nothing.
scene::Model layer_model(const formats::Drawing& drawing, int layer, const glm::dvec3& origin,
                         double line_width_m);

}  // namespace parvis::plan_drawing
