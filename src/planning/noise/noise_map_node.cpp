// noiseMap: the map of noise in the scene, over the ground and on facades, with a factor of the traffic that
// may change while the scene runs.
#include "planning/noise/noise_map_node.h"

#include <map>
#include <mutex>

#include "planning/noise/noise_map.h"
#include "scene/script/attribute.h"
#include "scene/script/scene_builder.h"

namespace parvis::noise {
namespace {

using namespace scene::attribute;

/// The item that the node `noiseMap` makes.
struct ShownNoise {
  static constexpr std::string_view name = "noise.shown";
  static constexpr scene::DataRole role = scene::DataRole::settings;  // its picture is an object
  std::string object;                                                 ///< name of the object that shows it
  NoiseOptions options;
  double factor = 1.0;
  FileLocation where;

  /// Adds the members by which maps differ; see SceneData.
  void hash(ContentHash& hash) const { hash.add_text(object), hash.add(factor); }
};

/// Maps of scenes by the name of their object: a node whose traffic changes casts no rays.
class KnownMaps {
 public:
  void put(const std::string& object, std::shared_ptr<const NoiseMap> map) {
    const std::lock_guard lock(mutex_);
    maps_[object] = std::move(map);
  }
  std::shared_ptr<const NoiseMap> find(const std::string& object) {
    const std::lock_guard lock(mutex_);
    const auto found = maps_.find(object);
    return found == maps_.end() ? nullptr : found->second;
  }

 private:
  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<const NoiseMap>> maps_;
};

std::shared_ptr<const scene::Model> model_with_traffic(const NoiseMap& map, double factor, double height_m) {
  NoiseMap changed;
  changed.cell_m = map.cell_m, changed.receivers = map.receivers;
  changed.levels = sum_levels(map.transfers, multiplied(map.sources, factor));
  return std::make_shared<const scene::Model>(noise_model(changed, height_m));
}

scene::NodeSchema map_schema() {
  return {
      .type = "noiseMap",
      .help =
          "The map of noise by CNOSSOS-EU, shown in the colours of its levels over the ground and on "
          "facades. It is computed when the scene is loaded, as parvis noise does; a change of traffic "
          "alone recolours it.",
      .attributes =
          {text("name", "of its object").by_default("noise map"),
           points("area", "two corners; none: the whole place").in("m"),
           number("cell", "size of a cell").in("m").between(1, 200).by_default("10"),
           number("height", "of the receivers over the ground").in("m").between(0.5, 50).by_default("4"),
           integer("reflections", "highest order of reflections at facades").between(0, 3).by_default("1"),
           flag("facades", "colours on facades, too").by_default("1"),
           number("traffic_factor", "multiplies the vehicles of all roads; trams keep their headways")
               .between(0.01, 10)
               .by_default("1")
               .live(),
           flag("visible", "false: it is hidden").by_default("1").live()},
      .example = "noiseMap(area=\"-60 -230 0, 220 20 0\", cell=10)"};
}

void build_map(const scene::Node& node, scene::SceneBuilder& builder, KnownMaps& known) {
  ShownNoise shown;
  shown.object = node.text("name"), shown.where = node.where;
  shown.factor = node.number("traffic_factor");
  shown.options.cell_m = node.number("cell"), shown.options.height_m = node.number("height");
  shown.options.paths.reflections = int(node.integer("reflections"));
  shown.options.has_facades = node.flag("facades");
  if (const std::vector<glm::vec3> corners = node.points("area"); !corners.empty()) {
    if (corners.size() != 2)
      return builder.fail(
          error_at(node.where_of("area"), "noiseMap: expected two corners, as \"-60 -230 0, 220 20 0\""));
    shown.options.area = glm::dvec4(corners[0].x, corners[0].y, corners[1].x, corners[1].y);
  }
  scene::Object object;
  object.name = shown.object;
  object.is_dynamic = true;  // no part of the place: nothing is baked or heard of it
  object.is_visible = builder.is_visible() && node.flag("visible");
  const std::shared_ptr<const NoiseMap> map = known.find(shown.object);
  object.model = map ? model_with_traffic(*map, shown.factor, shown.options.height_m)
                     : std::make_shared<const scene::Model>();
  builder.add(std::move(object));
  builder.add(std::move(shown));
}

void finish_maps(scene::SceneBuilder& builder, KnownMaps& known) {
  for (const ShownNoise& shown : builder.scene.items<ShownNoise>()) {
    Result<NoiseMap> map = compute_noise(builder.scene, shown.options);
    if (!map) {
      builder.fail(map.errors(), shown.where);
      continue;
    }
    const auto kept = std::make_shared<const NoiseMap>(*std::move(map));
    known.put(shown.object, kept);
    const auto object = std::ranges::find(builder.scene.objects, shown.object, &scene::Object::name);
    if (object != builder.scene.objects.end())
      object->model = model_with_traffic(*kept, shown.factor, shown.options.height_m);
  }
}

}  // namespace

void add_map_node(scene::NodeRegistry& registry) {
  const auto known = std::make_shared<KnownMaps>();
  registry.add(map_schema(), [known](const scene::Node& node, scene::SceneBuilder& builder) {
    build_map(node, builder, *known);
  });
  registry.add_finish_step([known](scene::SceneBuilder& builder) { finish_maps(builder, *known); });
}

}  // namespace parvis::noise
