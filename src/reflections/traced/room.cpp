#include "base/registries.h"
#include "reflections/methods/registry.h"
#include "reflections/traced/traced_reflections.h"
#include "room_list.h"

namespace parvis::traced {
namespace {

Result<std::unique_ptr<methods::Reflections>> make(const scene::Scene& scene, render::Renderer& renderer,
                                                   std::unique_ptr<methods::Reflections>) {
  Result<std::unique_ptr<TracedReflections>> made = TracedReflections::create(scene, renderer);
  if (!made) return made.errors();
  return std::unique_ptr<methods::Reflections>(*std::move(made));
}

}  // namespace

/// Adds it to Parvis's registries.
void register_room(Registries& registries) {
  registries.get<methods::Registry>().add(
      {.name = "traced",
       .help = "exact mirror rays through the scene for each reflecting pixel, on all cores",
       .make = make});
}

}  // namespace parvis::traced
