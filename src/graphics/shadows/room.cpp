#include "graphics/shadows/room.h"

#include "graphics/shadows/chosen_light.h"

namespace parvis::shadows {

void furnish(House& house) { house.get<render::Lights>().make = ChosenLight::create; }

}  // namespace parvis::shadows
