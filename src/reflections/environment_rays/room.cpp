#include "reflections/environment_rays/room.h"

#include "reflections/environment_rays/multiple_environment_maps.h"
#include "reflections/methods/registry.h"
#include "reflections/reference_maps/settings.h"

namespace parvis::environment_rays {

void furnish(House& house) {
  house.get<methods::Registry>().add(
      {.name = "multiple_environment_maps",
       .help = "a ray for each reflecting pixel, looked up in the reference maps that see what it hits",
       .make = make_multiple_environment_maps,
       .attributes = {maps_attribute()},
       .read = read_maps});
}

}  // namespace parvis::environment_rays
