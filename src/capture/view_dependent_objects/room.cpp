#include <algorithm>
#include <map>
#include <memory>
#include <mutex>

#include "base/registries.h"
#include "capture/view_dependent_objects/model_pairs.h"
#include "capture/view_dependent_objects/object_drawable.h"
#include "capture/view_dependent_objects/placed_object.h"
#include "formats/readers/readers.h"
#include "room_list.h"
#include "scene/script/attribute.h"
#include "scene/script/node_registry.h"
#include "scene/script/placement.h"
#include "scene/script/scene_builder.h"

namespace parvis::view_dependent_objects {
namespace {

scene::NodeSchema vdobject_schema() {
  using namespace scene::attribute;
  scene::NodeSchema schema{
      .type = "vdobject",
      .help =
          "A view-dependent object: models of one thing, each textured from another viewpoint. Every point "
          "shows "
          "the textures of the viewpoints nearest in direction, blended by the angles to them.",
      .attributes =
          {text("name", "by which other nodes refer to it"),
           file("file", "a model; one of camera=, cameraFile= and cameraName= follows")
               .required()
               .repeatable(),
           text("camera",
                "\"x y z h p r fov aspect\": where the textures of the model before it were taken from, z "
                "up; heading, "
                "pitch, roll and horizontal field of view in degrees")
               .repeatable(),
           file("cameraFile", "a VRML or Inventor file with the model's viewpoint").repeatable(),
           text("cameraName", "a viewpoint of the file named last, which is VRML or Inventor").repeatable(),
           flag("cleanModels", "objects without textures are left out").by_default("1"),
           flag("mergeModels",
                "objects of the same name are blended with each other; else all of each model is one object")
               .by_default("1"),
           integer("numBlendPass", "viewpoints that are blended: 2, or 3 to 4 of what is looked at from near")
               .between(1, 4)
               .by_default("2")
               .live(),
           number("brightness",
                  "of the textures' light; 1: they are shown as they are, whatever the exposure")
               .between(0.0, 1000.0)
               .by_default("1")
               .live(),
           number("shadow_strength",
                  "how much of the textures' light the shadows of other things take away, where they fall on "
                  "it; 0: none does. Without it: as much as the shadows that the textures show")
               .between(0.0, 1.0)
               .live()},
      .stands_in = {scene::top_level, "group", "scenario"},
      .example =
          "vdobject(file=\"statue_south.glb\", camera=\"0 -6 1.6 0 0 0 50 1\",\n"
          "  file=\"statue_east.wrl\", cameraName=\"east\", position=\"12 4 0\")"};
  const std::vector<scene::AttributeSchema> placement = scene::placement_attributes();
  schema.attributes.insert(schema.attributes.end(), placement.begin(), placement.end());
  schema.attributes.push_back(scene::visible_attribute());
  return schema;
}

std::shared_ptr<const scene::Model> read_model(const ModelPair& pair, scene::SceneBuilder& builder,
                                               const formats::Readers& readers) {
  return builder.shared_model(pair.file.string() + "?vdobject", [&]() -> std::shared_ptr<const scene::Model> {
    Errors warnings;
    Result<scene::Model> model = readers.read(pair.file, {}, warnings);
    for (const Error& warning : warnings) builder.warn(warning);
    if (model) return std::make_shared<const scene::Model>(*std::move(model));
    builder.fail(model.errors(), pair.where);
    return nullptr;
  });
}

/// Blended models that scenes show now: a node that is rebuilt blends nothing a second time.
class KnownModels {
 public:
  Result<std::shared_ptr<const BlendedModel>> blend(const std::vector<ViewedModel>& models,
                                                    const Merging& merging) {
    ContentHash key;
    for (const ViewedModel& viewed : models) key.add(viewed.model.get()), key.add(viewed.viewpoint);
    key.add(merging.cleans), key.add(merging.merges);
    const std::lock_guard lock(mutex_);
    Known& known = known_[key.value()];
    const auto is_of = [](const std::weak_ptr<const scene::Model>& held, const ViewedModel& viewed) {
      return held.lock() == viewed.model;
    };
    if (auto held = known.blended.lock(); held && std::ranges::equal(known.models, models, is_of))
      return held;
    Result<BlendedModel> blended = blended_model(models, merging);
    if (!blended) return blended.errors();
    find_shadows(*blended);
    auto held = std::make_shared<const BlendedModel>(*std::move(blended));
    known = {held, {}};
    for (const ViewedModel& viewed : models) known.models.push_back(viewed.model);
    return std::shared_ptr<const BlendedModel>(held);
  }

 private:
  struct Known {
    std::weak_ptr<const BlendedModel> blended;
    std::vector<std::weak_ptr<const scene::Model>> models;  ///< an address may become another model's
  };
  std::mutex mutex_;
  std::map<std::uint64_t, Known> known_;
};

void build(const scene::Node& node, scene::SceneBuilder& builder, const formats::Readers& readers,
           KnownModels& known) {
  const Result<std::vector<ModelPair>> pairs = model_pairs(node);
  if (!pairs) return builder.fail(pairs.errors());
  std::vector<ViewedModel> models;
  for (const ModelPair& pair : *pairs) {
    models.push_back({read_model(pair, builder, readers), pair.viewpoint});
    if (!models.back().model) return;
  }
  const Result<std::shared_ptr<const BlendedModel>> blended =
      known.blend(models, {node.flag("cleanModels"), node.flag("mergeModels")});
  if (!blended) return builder.fail(blended.errors(), node.where);
  PlacedObject placed;
  placed.called = node.gives("name") ? node.text("name") : pairs->front().file.stem().string();
  placed.model = *blended;
  placed.world_from_object = builder.world_from_parent() * scene::placement(node);
  placed.passes = int(node.integer("numBlendPass"));
  placed.brightness = float(node.number("brightness"));
  placed.kept_in_shadow = node.gives("shadow_strength") ? 1.0f - float(node.number("shadow_strength"))
                                                        : (*blended)->kept_in_shadows;
  placed.is_visible = builder.is_visible() && node.flag("visible");
  builder.add(std::move(placed));
}

}  // namespace

/// Adds the node vdobject, and what draws and traces it.
void register_room(Registries& registries) {
  const formats::Readers& readers = registries.get<formats::Readers>();
  const auto known = std::make_shared<KnownModels>();
  registries.get<scene::NodeRegistry>().add(
      vdobject_schema(), [&readers, known](const scene::Node& node, scene::SceneBuilder& builder) {
        build(node, builder, readers, *known);
      });
  registries.get<render::Drawables>().add(objects_kind());
}

}  // namespace parvis::view_dependent_objects
