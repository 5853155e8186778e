// Draws vdobject(...) nodes: all viewpoints' textures in one array, chosen and blended in each pixel.
#pragma once

#include "graphics/render/drawables.h"

namespace parvis::view_dependent_objects {

/// The kind of all view-dependent objects of a scene: its drawable, and its counterpart in the ray tracer.
render::DrawableKind objects_kind();

}  // namespace parvis::view_dependent_objects
