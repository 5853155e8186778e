// model: a model file, placed.
#include <algorithm>
#include <cstdio>

#include "base/known_names.h"
#include "base/progress.h"
#include "formats/meshes/glass_pane.h"
#include "formats/meshes/mesh_nodes.h"
#include "formats/meshes/model_node.h"
#include "formats/readers/local_origin.h"
#include "formats/readers/packed_file.h"
#include "formats/readers/readers.h"
#include "land/heights/terrain_heights.h"
#include "scene/data/object_animation.h"
#include "scene/data/object_names.h"
#include "scene/script/attribute.h"
#include "scene/script/node_registry.h"
#include "scene/script/placement.h"
#include "scene/script/scene_builder.h"

namespace parvis::scene {
namespace {

using namespace attribute;

NodeSchema model_schema() {
  NodeSchema schema{
      .type = "model",
      .help =
          "A model file (glTF, OBJ, CityJSON, CityGML, OpenStreetMap, GeoTIFF terrain and others), placed. "
          "Its children change its materials or add wheels.",
      .attributes =
          {text("name", "by which other nodes refer to it"), file("file", "the model file").required(),
           choice("up", "the file's upward axis; \"file\": what its format says", {"file", "y", "z"})
               .by_default("file"),
           number("lod", "of city models: the level of detail, or the next one below; else the highest")
               .between(0.0, 4.0),
           number("cell", "of a terrain grid (GeoTIFF) without a place on the earth: between its samples")
               .in("m")
               .between(0.001, 10'000.0),
           reference("ground",
                     "of OpenStreetMap: the terrain, a model before it, on which buildings and roads stand, "
                     "by their coordinates; else they stand on a level ground",
                     {"model"}),
           flag("dynamic", "it may move: stands in nothing that is computed once").by_default("0"),
           flag("reflective", "its paint, glass and chrome take the scene's reflection method")
               .by_default("0"),
           text("animation",
                "the one of the file's animations that it plays, over and over; else the first; \"none\": it "
                "stands as at rest"),
           number("animation_speed", "how fast; 1: as the file says").between(-100.0, 100.0).by_default("1"),
           number("animation_start",
                  "how far the animation is when the scene begins; copies are further, each by another part")
               .in("s")
               .by_default("0"),
           points("positions", "many copies, one at each point (relative to position=)")
               .in("m")
               .repeatable()},
      .stands_in = {top_level, "group", "scenario"},
      .example =
          "model(name=\"taxi\", file=\"cars/van.glb\", position=\"3 4 0\", heading_deg=90, dynamic=1, "
          "reflective=1) {\n"
          "  material(target=\"body\", preset=\"paint\")\n"
          "}"};
  const std::vector<AttributeSchema> placement = placement_attributes();
  schema.attributes.insert(schema.attributes.begin() + 2, placement.begin(), placement.end());
  schema.attributes.push_back(visible_attribute());
  return schema;
}

/// Key of the attributes that decide how the node's file is read.
std::string reading_key(const Node& node) {
  const std::string level = node.gives("lod") ? fmt::format("&lod={}", node.number("lod")) : "";
  const std::string cell = node.gives("cell") ? fmt::format("&cell={}", node.number("cell")) : "";
  const std::string ground = node.gives("ground") ? "&ground=" + node.text("ground") : "";
  return node.file("file").string() + "?up=" + node.text("up") + level + cell + ground;
}

/// The ground of ground=, and the map that it lies on; it counts places beyond it. Empty, with the errors in
/// `builder`, where there is none.
GroundOnMap ground_below(const Node& node, SceneBuilder& builder, std::string& map,
                         std::size_t& places_beyond) {
  const std::string name = node.text("ground");
  const std::string extension = formats::model_extension(node.file("file"));
  if (extension != ".osm" && extension != ".pbf") {
    builder.fail(error_at(node.where_of("ground"),
                          "ground= is for OpenStreetMap (.osm, .pbf); this file has heights of its own"));
    return {};
  }
  const auto object = std::ranges::find(builder.scene.objects, name, &Object::name);
  if (object == builder.scene.objects.end()) {
    builder.fail(error_at(node.where_of("ground"), "no model called \"{}\" stands before this node{}", name,
                          names_that_exist(name, scene::object_names(builder.scene))));
    return {};
  }
  map = object->model->map;
  const auto heights = std::make_shared<const TerrainHeights>(*object->model);
  const std::optional<double> lowest_m = heights->lowest();
  if (!lowest_m) {
    builder.fail(error_at(node.where_of("ground"), "the model \"{}\" has no terrain to stand on", name));
    return {};
  }
  return [heights, lowest = *lowest_m, &places_beyond](glm::dvec2 on_map) {
    const std::optional<double> height_m = heights->at(on_map);
    if (!height_m) ++places_beyond;
    return height_m.value_or(lowest);
  };
}

/// The position as the script writes it: coordinates of a national grid have more digits than floats.
glm::dvec3 exact_position(const Node& node) {
  const glm::vec3 rounded = node.vec3("position");
  const auto given = std::ranges::find(node.attributes, "position",
                                       [](const NodeAttribute& each) { return each.schema->name; });
  glm::dvec3 exact(0.0);
  const bool is_written =
      given != node.attributes.end() &&
      std::sscanf(given->text.c_str(), " %lf%*[, ]%lf%*[, ]%lf", &exact.x, &exact.y, &exact.z) == 3 &&
      glm::vec3(exact) == rounded;
  return is_written ? exact : glm::dvec3(rounded);
}

/// placement(node), and a move before it, in double precision.
glm::mat4 placed_with(const Node& node, glm::dvec3 offset) {
  glm::mat4 placed = placement(node);
  placed[3] = glm::vec4(glm::vec3(exact_position(node) + glm::dmat3(glm::mat3(placed)) * offset), 1.0f);
  return placed;
}

/// Georeferenced models stand as their coordinates say: the first one's origin is the scene's, and the others
/// stand about it, so that tiles of one city meet. Its map is the scene's: files that know where they are on
/// the earth are laid on it.
glm::dvec3 offset_in_scene(const Model& model, const Node& node, SceneBuilder& builder) {
  constexpr double far_m = 50'000.0;  // floats end at millimetres there, and no city is so large
  if (model.origin == glm::dvec3(0.0)) return model.origin;
  // A script may take the coordinates of a national grid off itself, by the node or by a group about it.
  const glm::dmat4 placed(builder.world_from_parent() * placement(node));
  const glm::dvec3 position(placed[3]);
  if (glm::length(glm::dvec2(position)) > formats::max_local_m &&
      glm::length(position + glm::dmat3(placed) * model.origin) < far_m)
    return model.origin;
  Scene& scene = builder.scene;
  if (scene.origin == glm::dvec3(0.0)) scene.origin = model.origin;
  if (scene.map.empty() && !model.map.empty())
    scene.map = model.map, scene.true_north_deg = model.true_north_deg;
  const glm::dvec3 offset = model.origin - builder.scene.origin;
  if (glm::length(offset) < far_m) return offset;
  builder.warn(error_at(node.where_of("file"),
                        "\"{}\" lies {:.0f} km from the scene's first georeferenced model; their coordinate "
                        "systems may differ. It is put beside it instead",
                        model.name, glm::length(offset) / 1000.0));
  return glm::dvec3(0.0);
}

std::shared_ptr<const Model> read_model_file(const Node& node, SceneBuilder& builder,
                                             const formats::Readers& readers) {
  const std::filesystem::path file = node.file("file");
  using formats::UpAxis;
  formats::ModelReading reading;
  reading.up = node.text("up") == "y" ? UpAxis::y : node.text("up") == "z" ? UpAxis::z : UpAxis::file;
  if (node.gives("lod")) reading.max_detail = node.number("lod");
  if (node.gives("cell")) reading.cell_m = node.number("cell");
  reading.map = builder.scene.map;
  return builder.shared_model(reading_key(node), [&]() -> std::shared_ptr<const Model> {
    Errors warnings;
    std::size_t places_beyond = 0;
    if (node.gives("ground")) {
      reading.ground = ground_below(node, builder, reading.map, places_beyond);
      if (!reading.ground) return nullptr;
    }
    Result<Model> model = readers.read(file, reading, warnings);
    for (const Error& warning : warnings) builder.warn(warning);
    if (places_beyond > 0)
      builder.warn(error_at(node.where_of("ground"),
                            "{} corners and road points lie beyond \"{}\" or in its holes; they stand at its "
                            "lowest height",
                            places_beyond, node.text("ground")));
    if (model) return std::make_shared<const Model>(std::move(*model));
    builder.fail(model.errors(), node.where_of("file"));
    return nullptr;
  });
}

/// Which animation the node asks for; none where the model has none.
PlayedAnimation animation_of(const Model& model, const Node& node, SceneBuilder& builder) {
  PlayedAnimation played{no_index, float(node.number("animation_speed")), node.number("animation_start")};
  const std::string wanted = node.gives("animation") ? node.text("animation") : "";
  if (wanted == "none") return played;
  std::vector<std::string> names;
  names.reserve(model.animations.size());
  for (const Animation& animation : model.animations) names.push_back(animation.name);
  const auto found = std::find(names.begin(), names.end(), wanted);
  if (found != names.end()) {
    played.animation = int(found - names.begin());
  } else if (wanted.empty() && !names.empty()) {
    played.animation = 0;
  } else if (!wanted.empty()) {
    builder.fail(error_at(node.where_of("animation"), "the file has no animation \"{}\"{}", wanted,
                          names_that_exist(wanted, names)));
  }
  return played;
}

/// The golden section spreads any number of copies over the animation: they do not keep step.
PlayedAnimation of_copy(PlayedAnimation played, const Model& model, std::size_t copy) {
  constexpr double golden_section = 0.61803398875;
  played.start_s +=
      double(copy) * golden_section * double(model.animations[std::size_t(played.animation)].duration_s);
  return played;
}

void build_model(const Node& node, SceneBuilder& builder, const formats::Readers& readers) {
  Object object;
  object.model = model_of(node, builder, readers);
  if (!object.model) return;
  object.is_dynamic = node.flag("dynamic");
  object.takes_reflection = node.flag("reflective");
  object.is_visible = builder.is_visible() && node.flag("visible");
  const std::string name = node.gives("name") ? node.text("name") : formats::model_stem(node.file("file"));
  const glm::mat4 placed_from_model = placed_with(node, offset_in_scene(*object.model, node, builder));
  const PlayedAnimation played = animation_of(*object.model, node, builder);
  std::vector<glm::vec3> positions = node.points("positions");
  if (positions.empty()) positions.emplace_back(0.0f);
  Progress progress(fmt::format("placing {}", name), positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i, progress.advance()) {
    object.name = i == 0 ? name : fmt::format("{} {}", name, i + 1);
    glm::mat4 moved(1.0f);
    moved[3] = glm::vec4(positions[i], 1.0f);
    object.world_from_model = builder.world_from_parent() * moved * placed_from_model;
    Object copy = object;
    if (played.animation != no_index) play(copy, of_copy(played, *object.model, i));
    builder.add(std::move(copy));
  }
}

}  // namespace

std::shared_ptr<const Model> model_of(const Node& node, SceneBuilder& builder,
                                      const formats::Readers& readers) {
  std::shared_ptr<const Model> as_read = read_model_file(node, builder, readers);
  const auto refracts = [](const Material& material) { return material.refracts(); };
  if (!as_read || (node.children.empty() && std::ranges::none_of(as_read->materials, refracts)))
    return as_read;
  std::string key = reading_key(node) + "#changed";
  for (const Node& child : node.children) key += signature(child);
  return builder.shared_model(key, [&] {
    Model model = *as_read;
    for (const Node& child : node.children) builder.change(model, child);
    if (const std::set<std::string> panes = settle_glass(model); !panes.empty())
      builder.warn(error_at(node.where_of("file"),
                            "the solid glass of {} is open, and bounds no body that light could be followed "
                            "through: it is drawn as panes. Close its holes, or give it no thickness",
                            fmt::join(panes, ", ")));
    return std::make_shared<const Model>(std::move(model));
  });
}

void add_model_node(NodeRegistry& registry, const formats::Readers& readers) {
  registry.add(model_schema(),
               [&readers](const Node& node, SceneBuilder& builder) { build_model(node, builder, readers); });
}

}  // namespace parvis::scene
