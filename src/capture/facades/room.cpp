#include <map>
#include <memory>
#include <mutex>

#include "base/registries.h"
#include "capture/facades/facade_drawable.h"
#include "capture/facades/facade_gltf.h"
#include "capture/facades/placed_facade.h"
#include "capture/facades/recorded_shadows.h"
#include "room_list.h"
#include "scene/script/attribute.h"
#include "scene/script/node_registry.h"
#include "scene/script/placement.h"
#include "scene/script/scene_builder.h"

namespace parvis::facades {
namespace {

scene::NodeSchema facade_schema() {
  using namespace scene::attribute;
  scene::NodeSchema schema{
      .type = "facade",
      .help =
          "A captured place: surfaces that show photographs, chosen and blended by where they are seen from. "
          "The file is made by parvis facade pack.",
      .attributes =
          {text("name", "by which other nodes refer to it"),
           file("file", "the packed layers (.facade), or the same in a glTF file (.glb)").required(),
           number("brightness",
                  "of the photographs' light; 1: they are shown as they are, whatever the exposure")
               .between(0.0, 1000.0)
               .by_default("1")
               .live(),
           number("shadow_strength",
                  "how much of the photographs' light the shadows of other things take away, where they fall "
                  "on it; 0: none does. Without it: as much as the shadows that the photographs show")
               .between(0.0, 1.0)
               .live(),
           number("texture_mb",
                  "graphics memory for its photographs, megabytes; where all do not fit the nearest to "
                  "the viewer are held")
               .between(1.0, 1048576.0)
               .by_default("1024")},
      .stands_in = {scene::top_level, "group", "scenario"},
      .example = "facade(file=\"layers.facade\", position=\"0 0 0\")"};
  const std::vector<scene::AttributeSchema> placement = scene::placement_attributes();
  schema.attributes.insert(schema.attributes.begin() + 2, placement.begin(), placement.end());
  schema.attributes.push_back(scene::visible_attribute());
  return schema;
}

/// Files that scenes show now: a node that is rebuilt, or stands twice, reads none a second time.
class SharedFiles {
 public:
  Result<std::shared_ptr<const PackedFacade>> read(const std::filesystem::path& file) {
    std::error_code code;
    const auto written = std::filesystem::last_write_time(file, code);
    const std::lock_guard lock(mutex_);
    Known& known = files_[file];
    if (std::shared_ptr<const PackedFacade> held = known.facade.lock(); held && known.written == written)
      return held;
    Result<PackedFacade> facade = file.extension() == ".glb" ? read_facade_gltf(file) : read_facade(file);
    if (!facade) return facade.errors();
    find_shadows(*facade);
    auto held = std::make_shared<const PackedFacade>(*std::move(facade));
    known = {held, written};
    return std::shared_ptr<const PackedFacade>(held);
  }

 private:
  struct Known {
    std::weak_ptr<const PackedFacade> facade;
    std::filesystem::file_time_type written;
  };
  std::mutex mutex_;
  std::map<std::filesystem::path, Known> files_;
};

void build(const scene::Node& node, scene::SceneBuilder& builder, SharedFiles& files) {
  Result<std::shared_ptr<const PackedFacade>> facade = files.read(node.file("file"));
  if (!facade) return builder.fail(facade.errors(), node.where_of("file"));
  PlacedFacade placed;
  placed.called = node.gives("name") ? node.text("name") : node.file("file").stem().string();
  placed.file = node.file("file"), placed.facade = *std::move(facade);
  placed.world_from_facade = builder.world_from_parent() * scene::placement(node);
  placed.brightness = float(node.number("brightness"));
  placed.kept_in_shadow = node.gives("shadow_strength") ? 1.0f - float(node.number("shadow_strength"))
                                                        : placed.facade->kept_in_shadows;
  placed.max_texture_bytes = std::uint64_t(node.number("texture_mb") * 1048576.0);
  placed.is_visible = builder.is_visible() && node.flag("visible");
  builder.add(std::move(placed));
}

}  // namespace

/// facade; its drawable.
void register_room(Registries& registries) {
  const auto files = std::make_shared<SharedFiles>();
  registries.get<scene::NodeRegistry>().add(
      facade_schema(),
      [files](const scene::Node& node, scene::SceneBuilder& builder) { build(node, builder, *files); });
  registries.get<render::Drawables>().add(facades_kind());
}

}  // namespace parvis::facades
