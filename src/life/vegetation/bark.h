// Bark of all grown plants, as brightness about 0.5: each kind multiplies it by twice its colour.
#pragma once

#include "scene/data/model.h"

namespace parvis::vegetation {

/// The texture; made when it is first asked for.
const scene::Texture& bark_texture();

}  // namespace parvis::vegetation
