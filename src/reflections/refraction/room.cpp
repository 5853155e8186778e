#include "reflections/refraction/room.h"

#include "reflections/methods/registry.h"
#include "reflections/refraction/refracted_objects.h"

namespace parvis::refraction {

void furnish(House& house) {
  house.get<methods::Registry>().add(
      {.name = "refracted objects",
       .help = "what solid glass lets through",
       .make = make_refracted_objects,
       .is_overlay = true,
       .is_wanted = [](const scene::Scene& scene) { return has_glass(scene); }});
}

}  // namespace parvis::refraction
