// All rooms of the program. A room joins by one line in src/room_list.h.
#pragma once

#include <span>

#include "base/registries.h"
#include "graphics/render/drawables.h"
#include "reflections/methods/registry.h"
#include "scene/script/node_registry.h"

namespace parvis::rooms {

/// The function through which a room registers what it brings.
using RegisterRoom = void (*)(Registries&);

/// The registries filled by all rooms, and of `more` rooms, which come last in the list.
Registries make_registries(std::span<const RegisterRoom> more = {});

/// The registries, filled by all rooms; made when first asked for, then always the same.
const Registries& all_registries();

/// The types of nodes that scripts may use.
inline const scene::NodeRegistry& node_registry() { return all_registries().get<scene::NodeRegistry>(); }
/// The drawables that rooms register. They are attached to every scene before it is drawn or traced.
inline const render::Drawables& drawables() { return all_registries().get<render::Drawables>(); }
/// The methods of reflection.
inline const methods::Registry& method_registry() { return all_registries().get<methods::Registry>(); }

}  // namespace parvis::rooms
