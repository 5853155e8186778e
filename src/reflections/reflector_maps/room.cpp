#include "base/registries.h"
#include "graphics/render/bake_steps.h"
#include "reflections/reflector_maps/reflector_cache.h"
#include "room_list.h"

namespace parvis::reflector_maps {
namespace {

Result<render::Baked> bake(render::BakeInput& input) {
  Result<BakedReflectors> baked = bake_reflectors(input.scene(), input.processes());
  if (!baked) return baked.errors();
  render::Baked step;
  if (!baked->files.empty())
    step.summary = fmt::format("{} reflectors: {}", baked->files.size(), baked->parts.folder().string());
  step.kept = std::move(baked->files);
  return step;
}

void forget_others(const scene::Scene& scene, const std::set<std::filesystem::path>& kept) {
  forget_other_reflectors({ReflectorCache(scene).parts(), kept});
}

}  // namespace

/// Adds it to Parvis's registries.
void register_room(Registries& registries) {
  registries.get<render::BakeSteps>().add({.name = "reflector maps of curved mirrors and solid glass",
                                           .run = bake,
                                           .forget_others = forget_others});
}

}  // namespace parvis::reflector_maps
