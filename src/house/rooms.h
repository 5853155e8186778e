// All rooms of the house. A room joins by one line in src/room_list.h.
#pragma once

#include <span>

#include "base/house.h"
#include "graphics/render/drawables.h"
#include "reflections/methods/registry.h"
#include "scene/script/node_registry.h"

namespace parvis::house {

/// The function through which a room registers what it brings.
using Furnish = void (*)(House&);

/// A house of all rooms, and of `more` rooms, which come last in the list.
House make_house(std::span<const Furnish> more = {});

/// The registries, filled by all rooms; made when first asked for, then always the same.
const House& all_rooms();

/// The types of nodes that scripts may use.
inline const scene::NodeRegistry& node_registry() { return all_rooms().get<scene::NodeRegistry>(); }
/// The drawables that rooms register. Every scene that is to be drawn or traced is furnished with it first.
inline const render::Drawables& drawables() { return all_rooms().get<render::Drawables>(); }
/// The methods of reflection.
inline const methods::Registry& method_registry() { return all_rooms().get<methods::Registry>(); }

}  // namespace parvis::house
