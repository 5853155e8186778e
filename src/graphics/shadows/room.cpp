#include "base/house.h"
#include "graphics/shadows/chosen_light.h"
#include "room_list.h"

namespace parvis::shadows {

/// Replaces the light in render::Lights.
void furnish(House& house) { house.get<render::Lights>().make = ChosenLight::create; }

}  // namespace parvis::shadows
