#include <algorithm>

#include "base/registries.h"
#include "reflections/environment_rays/multiple_environment_maps.h"
#include "reflections/methods/registry.h"
#include "reflections/reference_maps/settings.h"
#include "room_list.h"

namespace parvis::environment_rays {
namespace {

/// Reference maps stand along streets, and only what mirrors looks into them.
bool suits(const scene::Scene& scene) {
  return !scene.roads.empty() && std::ranges::any_of(scene.objects, &scene::Object::takes_reflection);
}

}  // namespace

/// Adds them to Parvis's registries.
void register_room(Registries& registries) {
  registries.get<methods::Registry>().add(
      {.name = "multiple_environment_maps",
       .help = "a ray for each reflecting pixel, looked up in the reference maps that see what it hits",
       .make = make_multiple_environment_maps,
       .suits = suits,
       .suits_where = "where there are streets and something that mirrors",
       .attributes = {maps_attribute()},
       .read = read_maps});
}

}  // namespace parvis::environment_rays
