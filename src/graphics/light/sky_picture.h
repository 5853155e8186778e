// Pictures of the whole sky, which the nodes sky and skyDome name.
#pragma once

#include <optional>

#include "base/image.h"
#include "scene/script/node.h"

namespace parvis::scene {
class SceneBuilder;
}

namespace parvis::light {

/// The picture in linear light that the attribute `name` of `node` refers to, its sun dimmed. Pixels that are
/// infinite, as those of a captured sun may be, or no numbers are replaced by finite ones, with a warning.
/// None, with the errors in `builder`, where the file cannot be read.
std::optional<ImageF> read_sky_picture(const scene::Node& node, const char* name,
                                       scene::SceneBuilder& builder);

}  // namespace parvis::light
