// streetTrees, parkedCars, streetFurniture: what stands along the kerbs of every street, in one node each.
#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <map>

#include "base/bounds.h"
#include "base/content_hash.h"
#include "base/known_names.h"
#include "base/memory_budget.h"
#include "base/random.h"
#include "base/registries.h"
#include "life/vegetation/scene_plant.h"
#include "places/kerbside/kerb_places.h"
#include "places/kerbside/nodes_map_trees.h"
#include "places/kerbside/street_models.h"
#include "room_list.h"
#include "scene/data/name_pattern.h"
#include "scene/data/object_names.h"
#include "scene/script/attribute.h"
#include "scene/script/node_registry.h"
#include "scene/script/placement.h"
#include "scene/script/scene_builder.h"
#include "synthesis/place_seed.h"

namespace parvis::kerbside {
namespace {

constexpr std::size_t max_objects = 50'000;
constexpr float crown_share = 0.45f;  // of a tree's height: its widest crown's radius

/// A series that a script asks for.
struct PlannedSeries {
  static constexpr std::string_view name = "kerbside.planned_series";
  static constexpr scene::DataRole role = scene::DataRole::settings;  // what stands is among the objects
  KerbSeries series;
  std::string object_name;  ///< of each; a number follows
  std::string of;           ///< pattern of the objects that are repeated; empty: `models`
  FileLocation where_of;
  /// Makes what is repeated at so many places where `of` is empty.
  std::function<StreetModels(std::size_t places)> models;
  /// Grown plants in place of models; a null kind: none.
  vegetation::PlantRecipe plant = {};
  bool turns_at_random = false;  ///< as trees do
  bool is_visible = true;
  bool is_car = false;  ///< takes reflections and is dynamic: reference maps leave it out

  /// Adds the name alone: all that follows from the script is in the objects.
  void hash(ContentHash& hash) const { hash.add_text(object_name); }
};

/// Repeated things: models, and how each is turned and scaled.
struct Repeated {
  StreetModel look;
  glm::mat3 turn{1.0f};
};

scene::AttributeSchema of_attribute(const std::string& else_what) {
  using namespace scene::attribute;
  return text("of",
              "names of objects of the scene, with * and ?, of which one stands at each place; they may "
              "be hidden themselves. Without it: " +
                  else_what);
}
scene::AttributeSchema spacing_attribute(const std::string& help, double min_m) {
  using namespace scene::attribute;
  return number("spacing", help).in("m").between(min_m, 500);
}

/// The circle in which a series stands, where a script gives one, and whether it is to be seen.
std::vector<scene::AttributeSchema> circle_attributes() {
  using namespace scene::attribute;
  return {scene::visible_attribute(),
          scene::attribute::vec3(
              "around", "with `within`: the middle of the circle in plan where they stand; else everywhere"),
          number("within", "of `around`, in plan").in("m").between(5, 1e5)};
}

/// Its attributes and those of the circle.
scene::NodeSchema with_circle(scene::NodeSchema schema) {
  std::ranges::move(circle_attributes(), std::back_inserter(schema.attributes));
  return schema;
}

/// Whether the node and all groups around it are to be seen.
bool is_visible(const scene::Node& node, const scene::SceneBuilder& builder) {
  return builder.is_visible() && node.flag("visible");
}

/// Reads those. False, and an error of the builder, where one is without the other.
bool read_circle(const scene::Node& node, scene::SceneBuilder& builder, KerbSeries& series) {
  if (node.gives("around") != node.gives("within")) {
    builder.fail(error_at(node.where_of(node.gives("around") ? "around" : "within"),
                          "around=\"x y z\" and within=METRES name a circle together: give both"));
    return false;
  }
  if (node.gives("around")) series.circle = {glm::vec2(node.vec3("around")), float(node.number("within"))};
  return true;
}

scene::NodeSchema street_trees_schema() {
  using namespace scene::attribute;
  return {
      .type = "streetTrees",
      .help =
          "Trees along both kerbs of every street of at most 80 km/h, where neither walls nor anything else "
          "is in the way.",
      .attributes =
          {of_attribute("trees of `height`"),
           choice("kind", "light trees of the paper's city, or grown plants (plant) with every leaf",
                  {"paper_city", "orange", "oak", "plane", "spruce", "pine"})
               .by_default("paper_city"),
           spacing_attribute("between trees", 2).by_default("10"),
           number("clear", "from the trunk to walls and all else").in("m").between(0.2, 10).by_default("1.6"),
           number("height", "of the trees").in("m").between(2, 30).by_default("8")},
      .example = "road(path=\"0 0, 120 0\")\nstreetTrees(spacing=9, height=7)",
      .is_laid_out_once = true};
}

void build_street_trees(const scene::Node& node, scene::SceneBuilder& builder) {
  if (node.gives("of") && node.gives("kind"))
    return builder.fail(
        error_at(node.where_of("kind"),
                 "of=\"{}\" names what stands here, kind=\"{}\" names something else: give one "
                 "of the two",
                 node.text("of"), node.text("kind")));
  const float height_m = float(node.number("height"));
  PlannedSeries planned;
  planned.is_visible = is_visible(node, builder);
  planned.series = {.spacing_m = float(node.number("spacing")),
                    .radius_m = float(node.number("clear")),
                    .from_decks_m = crown_share * height_m};
  planned.object_name = "street tree";
  planned.of = node.text("of"), planned.where_of = node.where_of("of");
  planned.models = [height_m](std::size_t) { return street_trees(height_m, synthesis::place_seed); };
  if (planned.of.empty())
    planned.plant = {vegetation::find_kind(node.text("kind")), height_m, 0.0f, synthesis::place_seed};
  planned.turns_at_random = true;
  if (read_circle(node, builder, planned.series)) builder.add(std::move(planned));
}

scene::NodeSchema parked_cars_schema() {
  using namespace scene::attribute;
  return {
      .type = "parkedCars",
      .help =
          "Cars parked along the kerbs of every street of at most 80 km/h: on lanes of 4.8 m and more, else "
          "beside the lane. "
          "They take reflections.",
      .attributes = {of_attribute("cars of the paper's city"),
                     number("share", "of the places that are taken").between(0, 1).by_default("0.6"),
                     spacing_attribute("from the middle of a place to that of the next", 5).by_default("6")},
      .example = "road(path=\"0 0, 120 0\")\nparkedCars(share=0.4)",
      .is_laid_out_once = true};
}

void build_parked_cars(const scene::Node& node, scene::SceneBuilder& builder) {
  PlannedSeries planned;
  planned.is_visible = is_visible(node, builder);
  planned.series = {.spacing_m = float(node.number("spacing")),
                    .beside_m = 1.0f,
                    .half_length_m = 1.5f,
                    .radius_m = 0.9f,
                    .from_lanes_m = 0.7f,
                    .stands_on_wide_lanes = true};
  planned.object_name = "parked car";
  planned.of = node.text("of"), planned.where_of = node.where_of("of");
  planned.models = parked_cars;
  planned.series.share = float(node.number("share"));
  planned.is_car = true;
  if (read_circle(node, builder, planned.series)) builder.add(std::move(planned));
}

scene::NodeSchema street_furniture_schema() {
  using namespace scene::attribute;
  std::vector<std::string> kinds;
  for (const FurnitureKind& kind : furniture_kinds()) kinds.push_back(kind.name);
  return {.type = "streetFurniture",
          .help =
              "Lamps, benches, bins or bollards along both kerbs of every street of at most 80 km/h. A "
              "lamp(of=\"street lamp *\") "
              "lights the lamps.",
          .attributes = {choice("kind", "what stands there", kinds).by_default("lamps"),
                         of_attribute("generated ones"),
                         spacing_attribute("between two of them; else what is usual for the kind", 1)},
          .example =
              "road(path=\"0 0, 120 0\")\nstreetFurniture(kind=\"lamps\")\n"
              "lamp(of=\"street lamp *\", position=\"0 0 4.45\", flux_lm=5000)",
          .is_laid_out_once = true};
}

void build_street_furniture(const scene::Node& node, scene::SceneBuilder& builder) {
  const FurnitureKind& kind = *std::ranges::find(furniture_kinds(), node.text("kind"), &FurnitureKind::name);
  PlannedSeries planned;
  planned.is_visible = is_visible(node, builder);
  planned.series = {.spacing_m = node.gives("spacing") ? float(node.number("spacing")) : kind.spacing_m,
                    .beside_m = kind.beside_m,
                    .half_length_m = kind.half_length_m,
                    .radius_m = 0.28f};
  planned.object_name = kind.object_name;
  planned.of = node.text("of"), planned.where_of = node.where_of("of");
  planned.models = [make = kind.make](std::size_t) {
    return StreetModels{{std::make_shared<scene::Model>(make())}};
  };
  if (read_circle(node, builder, planned.series)) builder.add(std::move(planned));
}

/// The things repeated at so many places. Empty, and an error of the builder, where no object has such a
/// name.
std::vector<Repeated> what_is_repeated(const PlannedSeries& planned, std::size_t places,
                                       scene::SceneBuilder& builder) {
  std::vector<Repeated> repeated;
  if (planned.of.empty()) {
    if (places == 0) return repeated;  // nothing is made for them
    for (const StreetModel& look : planned.models(places)) repeated.push_back({look});
    return repeated;
  }
  for (const scene::Object& object : builder.scene.objects)
    if (scene::matches(planned.of, object.name))
      repeated.push_back({{object.model, object.paint}, glm::mat3(object.world_from_model)});
  if (repeated.empty())
    builder.fail(error_at(planned.where_of,
                          "no object is called \"{}\", to be repeated here: give one this name, and "
                          "hide it with visible=0{}",
                          planned.of, names_that_exist(planned.of, scene::object_names(builder.scene))));
  return repeated;
}

/// A grown plant at each place, of a few shapes.
void plant_series(const PlannedSeries& planned, int maker, FreeGround& ground, scene::SceneBuilder& builder) {
  constexpr int shapes = 3;
  Random random(synthesis::place_seed, 300);
  std::vector<vegetation::ScenePlant> plants;
  const std::size_t before = vegetation::scene_plants(builder.scene).size();
  for (const KerbPlace& place : take_kerb_places(builder.scene.roads, planned.series, ground)) {
    vegetation::PlantRecipe recipe = planned.plant;
    recipe.seed += std::uint64_t(random.index(shapes));
    auto shape = vegetation::shared_plant(builder.scene.data<vegetation::PlantCache>(), recipe);
    if (!shape) return builder.fail(shape.errors(), planned.where_of);
    if (before + plants.size() >= max_objects)
      return builder.fail(
          error_at(planned.where_of, "more than {} plants: give a wider spacing", max_objects));
    plants.push_back({*std::move(shape),
                      glm::rotate(glm::translate(glm::mat4(1.0f), place.foot),
                                  random.uniform(0.0f, 6.2831853f), {0.0f, 0.0f, 1.0f}),
                      planned.is_visible, maker});
  }
  builder.add_all(std::move(plants));
}

void set_up(const PlannedSeries& planned, int maker, FreeGround& ground, scene::SceneBuilder& builder) {
  const std::vector<KerbPlace> places = take_kerb_places(builder.scene.roads, planned.series, ground);
  const std::vector<Repeated> repeated = what_is_repeated(planned, places.size(), builder);
  if (repeated.empty()) return;
  Random random(synthesis::place_seed, 300);
  if (builder.scene.objects.size() + places.size() > max_objects)
    return builder.fail(error_at(planned.where_of,
                                 "{} places for a {} with {} objects in the scene; {} is the most. "
                                 "Give a wider spacing",
                                 places.size(), planned.object_name, builder.scene.objects.size(),
                                 max_objects));
  std::vector<scene::Object> objects;
  for (const KerbPlace& place : places) {
    const Repeated& chosen = repeated[std::size_t(random.index(int(repeated.size())))];
    const float turn = random.uniform(0.0f, 6.2831853f);
    // Cars look where the lane leads; what has a back turns it, and its y, to the houses.
    const glm::vec2 x = planned.is_car || place.is_left ? place.along : -place.along;
    const float angle = planned.turns_at_random ? turn : std::atan2(x.y, x.x);
    scene::Object object;
    object.name = fmt::format("{} {}", planned.object_name, objects.size() + 1);
    object.model = chosen.look.model, object.paint = chosen.look.paint;
    glm::mat4 stands = glm::rotate(glm::translate(glm::mat4(1.0f), place.foot), angle, {0.0f, 0.0f, 1.0f});
    if (planned.is_car) stands = glm::rotate(stands, -std::atan(place.rise), {0.0f, 1.0f, 0.0f});
    object.world_from_model = stands * glm::mat4(chosen.turn);
    object.is_dynamic = object.takes_reflection = planned.is_car;
    object.is_visible = planned.is_visible;
    objects.push_back(std::move(object));
  }
  builder.add_for(maker, std::move(objects));
}

/// The area that the circles of all series cover; everything where one has none.
Bounds area_of(const std::vector<PlannedSeries>& all) {
  constexpr float margin_m = 5.0f;  // for what stands at the edge
  Bounds area;
  for (const PlannedSeries& planned : all) {
    if (!planned.series.circle) return FreeGround::everywhere();
    const float reach_m = planned.series.circle->radius_m + margin_m;
    area.add(glm::vec3(planned.series.circle->middle - reach_m, 0.0f));
    area.add(glm::vec3(planned.series.circle->middle + reach_m, 0.0f));
  }
  return area;
}

/// Series in the order of the script: what comes first takes its places first.
void finish(scene::SceneBuilder& builder) {
  const scene::ItemsOf<PlannedSeries> planned_series = builder.scene.data<scene::ItemsOf<PlannedSeries>>();
  const std::vector<PlannedSeries>& all = planned_series.items;
  if (all.empty() || !builder.errors().empty()) return;
  if (builder.scene.roads.empty())
    return builder.warn(error_at(all.front().where_of,
                                 "the scene has no streets along which a {} could stand; "
                                 "road() and streets() make them",
                                 all.front().object_name));
  const Bounds area = area_of(all);
  if (const Status enough =
          check_memory(FreeGround::bytes(builder.scene.roads, area), "the plan of all streets");
      !enough)
    return builder.fail(enough.errors(), all.front().where_of);
  FreeGround ground(builder.scene, area);
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i].plant.kind ? plant_series(all[i], planned_series.makers[i], ground, builder)
                      : set_up(all[i], planned_series.makers[i], ground, builder);
}

/// Plants of a series whose node has been rebuilt are shown or hidden; models are with their node.
void show_or_hide(scene::SceneBuilder& builder) {
  const auto& planned = builder.scene.data<scene::ItemsOf<PlannedSeries>>();
  std::map<int, bool> is_visible;
  for (std::size_t i = 0; i < planned.items.size(); ++i)
    is_visible[planned.makers[i]] = planned.items[i].is_visible;
  for (vegetation::ScenePlant& plant : builder.scene.data<vegetation::ScenePlants>().items)
    if (const auto series = is_visible.find(plant.series); series != is_visible.end())
      plant.is_visible = series->second;
}

}  // namespace

/// Adds the node types of this room and their finish step, which comes after that of roads: things stand
/// beside lanes that are laid.
void register_room(Registries& registries) {
  scene::NodeRegistry& registry = registries.get<scene::NodeRegistry>();
  registry.add(with_circle(street_trees_schema()), build_street_trees);
  registry.add(with_circle(parked_cars_schema()), build_parked_cars);
  registry.add(with_circle(street_furniture_schema()), build_street_furniture);
  add_map_tree_nodes(registry);
  registry.add_finish_step(plant_map_trees);  // first: what grows there takes its place
  registry.add_rebuild_step(plant_rebuilt_map_trees);
  registry.add_finish_step(finish);
  registry.add_rebuild_step(show_or_hide);
}

}  // namespace parvis::kerbside
