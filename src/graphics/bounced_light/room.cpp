#include "base/progress.h"
#include "base/registries.h"
#include "graphics/bounced_light/bounced_over.h"
#include "graphics/bounced_light/transfer_cache.h"
#include "graphics/render/bake_steps.h"
#include "graphics/render/light_source.h"
#include "room_list.h"
#include "scene/data/baked_folder.h"
#include "scene/data/bounced_settings.h"
#include "scene/script/attribute.h"
#include "scene/script/node_registry.h"
#include "scene/script/scene_builder.h"

namespace parvis::bounced_light {
namespace {

scene::NodeSchema bounced_light_schema() {
  using namespace scene::attribute;
  return {
      .type = "bouncedLight",
      .help =
          "Light that streets and facades reflect onto each other, under sun and sky of any hour: without "
          "this "
          "node a constant stands for it.",
      .attributes = {number("spacing",
                            "of the places where light is kept, from side to side; more than "
                            "150,000 of them are spaced wider")
                         .in("m")
                         .between(0.5, 50)
                         .by_default("8"),
                     integer("rays", "from each place, once: when the scene is baked, else when it is loaded")
                         .between(min_rays, max_rays)
                         .by_default("64")},
      .example = "dayLight(timeOfDay=13)\nbouncedLight(spacing=6)",
      .is_unique = true,
      .is_laid_out_once = true};
}

void build(const scene::Node& node, scene::SceneBuilder& builder) {
  builder.scene.data<scene::BouncedSettings>() = {true, float(node.number("spacing")),
                                                  int(node.integer("rays"))};
}

/// Keeps the transfer of a state that has none yet.
Result<render::Baked> bake(render::BakeInput& input) {
  const scene::Scene& scene = input.scene();
  if (!scene.data<scene::BouncedSettings>().is_on) return render::Baked();
  const TransferCache cache(scene);
  if (!cache.parts().keeps_parts()) return scene::no_baked_folder(scene);
  if (!cache.read()) {
    Progress progress("tracing bounced light", 1);
    if (Status status = cache.keep(trace_transfer(scene)); !status) return status.errors();
    progress.advance();
  }
  return render::Baked{{cache.file()}, fmt::format("bounced light: {}", cache.file().string())};
}

void forget_others(const scene::Scene& scene, const std::set<std::filesystem::path>& kept) {
  TransferCache(scene).parts().remove(kept);
}

}  // namespace

/// The node bouncedLight, and its light over that of render::Lights. After the room that chooses that light.
void register_room(Registries& registries) {
  registries.get<scene::NodeRegistry>().add(bounced_light_schema(), build);
  render::MakeLight& make = registries.get<render::Lights>().make;
  make = with_bounced_light(std::move(make));
  registries.get<render::BakeSteps>().add(
      {.name = "what bounced light hits", .run = bake, .forget_others = forget_others});
}

}  // namespace parvis::bounced_light
