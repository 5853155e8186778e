#include "base/registries.h"
#include "graphics/shadows/chosen_light.h"
#include "room_list.h"

namespace parvis::shadows {

/// Replaces the light in render::Lights.
void register_room(Registries& registries) { registries.get<render::Lights>().make = ChosenLight::create; }

}  // namespace parvis::shadows
