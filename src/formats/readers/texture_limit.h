// Pictures no larger than what a graphics driver holds.
#pragma once

#include "scene/data/file_account.h"
#include "scene/data/model.h"

namespace parvis::formats {

/// Side of the largest texture that every driver of OpenGL 4.5 holds, pixels.
inline constexpr int max_texture_side = 16'384;

/// Replaces pictures that are larger by the first of their mipmap levels that is not, and names them in the
/// account.
void limit_textures(scene::Model& model, scene::FileAccount& account);

}  // namespace parvis::formats
