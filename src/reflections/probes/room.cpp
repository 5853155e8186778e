#include "base/registries.h"
#include "reflections/methods/registry.h"
#include "reflections/methods/settings.h"
#include "reflections/probes/methods.h"
#include "room_list.h"
#include "scene/script/attribute.h"

namespace parvis::probes {
namespace {

using Made = Result<std::unique_ptr<methods::Reflections>>;

Made make_none(const scene::Scene& scene, render::Renderer&, std::unique_ptr<methods::Reflections>) {
  return std::unique_ptr<methods::Reflections>(std::make_unique<NoReflection>(scene));
}

/// Makes a method of cube maps.
template <class Method>
Made make(const scene::Scene& scene, render::Renderer&, std::unique_ptr<methods::Reflections>) {
  Result<methods::LobeFilter> filter = methods::LobeFilter::create();
  if (!filter) return filter.errors();
  return std::unique_ptr<methods::Reflections>(std::make_unique<Method>(scene, *std::move(filter)));
}

}  // namespace

/// Adds them to Parvis's registries.
void register_room(Registries& registries) {
  using namespace scene::attribute;
  methods::Registry& registry = registries.get<methods::Registry>();
  registry.add(
      {.name = "none", .help = "lights alone: mirrors show the mean light of the sky", .make = make_none});
  registry.add({.name = "rerendered_cube_map",
                .help = "a cube map for each reflector, re-rendered every frame",
                .make = make<RerenderedCubeMap>,
                .is_default = true});
  registry.add({.name = "time_sliced_cube_map",
                .help = "the same maps, a face or a few per frame",
                .make = make<TimeSlicedCubeMap>,
                .attributes = {integer("faces_per_frame",
                                       "of time_sliced_cube_map: how many faces of maps a frame draws, over "
                                       "all reflectors; 0: one for each of them")
                                   .between(0, 1000)
                                   .by_default("0")
                                   .live()},
                .read =
                    [](const scene::Node& node, methods::Settings& settings) {
                      settings.own.get<TimeSlicing>().faces_per_frame = int(node.integer("faces_per_frame"));
                    },
                .needs_earlier_frames = true});
  registry.add({.name = "shared_cube_map",
                .help = "one cube map for all reflectors, drawn about the largest on the screen",
                .make = make<SharedCubeMap>});
  registry.add({.name = "box_projected_probe",
                .help = "cube maps along the roads, looked up as the inside of a box fitted to the street; "
                        "the two nearest are blended",
                .make = make<BoxProjectedProbe>});
}

}  // namespace parvis::probes
