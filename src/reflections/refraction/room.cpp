#include "base/registries.h"
#include "reflections/methods/registry.h"
#include "reflections/refraction/refracted_objects.h"
#include "room_list.h"

namespace parvis::refraction {

/// Adds them to Parvis's registries.
void register_room(Registries& registries) {
  registries.get<methods::Registry>().add(
      {.name = "refracted objects",
       .help = "what solid glass lets through",
       .make = make_refracted_objects,
       .is_overlay = true,
       .is_wanted = [](const scene::Scene& scene) { return has_glass(scene); }});
}

}  // namespace parvis::refraction
