#include "planning/design/design_nodes.h"

#include <algorithm>
#include <functional>
#include <map>
#include <tuple>

#include "formats/readers/readers.h"
#include "life/people/person_object.h"
#include "life/vegetation/scene_plant.h"
#include "planning/design/shape_models.h"
#include "scene/script/attribute.h"
#include "scene/script/placement.h"
#include "scene/script/scene_builder.h"

namespace parvis::design {
namespace {

using namespace scene::attribute;
using scene::Node, scene::SceneBuilder;

scene::NodeSchema design_schema() {
  return {.type = design_type,
          .help =
              "A project: objects and ground surfaces that people place, move and compare. A scene holds any "
              "number.",
          .attributes = {text("name", "by which commands and scenarios call it").required(),
                         text("label", "what people call it"),
                         integer("version",
                                 "of the form in which it is written; one that is newer than the "
                                 "program is refused")
                             .between(1, 1'000'000)
                             .by_default("1"),
                         scene::visible_attribute()},
          .stands_in = {scene::top_level, "group", "scenario"},
          .example =
              "design(name=\"stone\") {\n"
              "  placed(kind=\"bench_stone\", name=\"bench_1\", position=\"12.4 3.05 0\", heading_deg=90)\n"
              "  surface(name=\"court\", material=paving, outline=\"0 0, 8 0, 8 6, 0 6\")\n"
              "}"};
}

scene::AttributeSchema length(const char* name, const char* help) {
  return number(name, help).in("m").between(0.01, 1000.0).live();
}

scene::NodeSchema placed_schema() {
  std::vector<std::string> materials = material_names();
  return {.type = placed_type,
          .help = "An object of a design. What is not given is as usual for its kind.",
          .attributes = {text("name", "by which commands call it"),
                         text("kind", "of the catalogue; parvis plan --kinds lists them").required(),
                         vec3("position", "where its foot stands").in("m").by_default("0 0 0").live(),
                         angle("heading_deg", "to which its front looks, clockwise from north")
                             .in("degrees")
                             .by_default("0")
                             .live(),
                         length("width", "along its front"), length("depth", "across its front"),
                         length("height", "of all of it"), colour("colour", "of its main part").live(),
                         choice("material", "of its main part", std::move(materials)).live(),
                         text("group", "objects of one group are selected together"),
                         flag("locked", "commands leave it as it is").by_default("0"),
                         scene::visible_attribute()},
          .stands_in = {design_type},
          .example = "design(name=\"a\") { placed(kind=\"umbrella\", position=\"4 2 0\", height=3) }"};
}

scene::NodeSchema surface_schema() {
  return {.type = surface_type,
          .help = "A ground surface of a design, within an outline that does not cross itself.",
          .attributes =
              {text("name", "by which commands call it"),
               points("outline", "its corners").in("m").required().live(),
               choice("material", "what it is covered with", surface_names()).by_default("paving").live(),
               colour("colour", "of a plain one; tints the others").by_default("#FFFFFF").live(),
               text("group", "objects of one group are selected together"),
               flag("locked", "commands leave it as it is").by_default("0"), scene::visible_attribute()},
          .stands_in = {design_type},
          .example = "design(name=\"a\") { surface(material=lawn, outline=\"0 0, 8 0, 8 6\") }"};
}

scene::NodeSchema measured_schema() {
  return {
      .type = measured_type,
      .help =
          "A ruler, area, height or slope of a design: planners see it in the window, on plans and in "
          "tables, and "
          "move its ends. Pictures do not show it.",
      .attributes =
          {text("name", "by which commands call it"),
           choice("kind",
                  "distance: along two points or more; area: in plan, within three points or more; height "
                  "and slope: from the first of two points to the second",
                  quantity_names())
               .required(),
           points("points", "what is measured").in("m").required().live(),
           text("group", "objects of one group are selected together"),
           flag("locked", "commands leave it as it is").by_default("0"), scene::visible_attribute()},
      .stands_in = {design_type},
      .example = "design(name=\"a\") { measured(kind=distance, points=\"0 0 0, 3 4 0\") }"};
}

/// The size as given, else as usual for the kind. The depth of a round or square plan follows the
/// width.
glm::dvec3 size_of(const Node& node, const Kind& kind) {
  glm::dvec3 size = kind.size_m;
  if (node.gives("width")) size.x = node.number("width");
  if (node.gives("depth"))
    size.y = node.number("depth");
  else if (kind.is_round && node.gives("width"))
    size.y = size.x * kind.size_m.y / kind.size_m.x;
  if (node.gives("height")) size.z = node.number("height");
  return size;
}

Status check_size(const Node& node, const Kind& kind, const glm::dvec3& size) {
  constexpr const char* axes[]{"wide", "deep", "high"};
  constexpr const char* attributes[]{"width", "depth", "height"};
  for (int axis = 0; axis < 3; ++axis)
    if (node.gives(attributes[axis]) && (size[axis] < kind.min_m[axis] || size[axis] > kind.max_m[axis]))
      return error_at(node.where_of(attributes[axis]), "a {} is {:g} to {:g} m {}, not {:g} m", kind.name,
                      kind.min_m[axis], kind.max_m[axis], axes[axis], size[axis]);
  return Ok{};
}

/// A seed of 1 to `count`, by the name of an object.
std::uint64_t seed_of(const std::string& name, std::uint64_t count) {
  ContentHash hash;
  hash.add_text(name);
  return 1 + hash.value() % count;
}

void add_plant(const Node& node, const Kind& kind, const glm::dvec3& size, const glm::mat4& world_from_object,
               SceneBuilder& builder) {
  vegetation::PlantRecipe recipe;
  recipe.kind = vegetation::find_kind(kind.plant);
  if (!recipe.kind)
    return builder.fail(
        error_at(node.where, "kind \"{}\": no plant is called \"{}\"", kind.name, kind.plant));
  const bool has_bed = !kind.shape.empty();
  recipe.height_m = has_bed ? recipe.kind->height_m : float(size.z);
  recipe.length_m = has_bed ? float(size.x) - 0.24f : float(size.x);
  constexpr int plant_shapes = 5;
  recipe.seed = seed_of(node.text("name"), plant_shapes);
  auto shape = vegetation::shared_plant(builder.scene.data<vegetation::PlantCache>(), recipe);
  if (!shape) return builder.fail(shape.errors(), node.where);
  vegetation::ScenePlant plant;
  plant.shape = *std::move(shape);
  const float bed_m = has_bed ? float(size.z) - 0.04f : 0.0f;
  plant.world_from_plant = world_from_object * glm::translate(glm::mat4(1.0f), glm::vec3(0.0f, 0.0f, bed_m));
  plant.is_visible = builder.is_visible() && node.flag("visible");
  builder.add(std::move(plant));
}

/// The user's own model, as large as asked for. Its front, towards -y, is turned ahead.
void add_file(const Node& node, const Kind& kind, const glm::dvec3& size, scene::Object object,
              const formats::Readers& readers, SceneBuilder& builder) {
  object.model = builder.shared_model(kind.file + "?design", [&]() -> std::shared_ptr<const scene::Model> {
    Errors warnings;
    Result<scene::Model> model = readers.read(kind.file, {}, warnings);
    for (const Error& warning : warnings) builder.warn(warning);
    if (model) return std::make_shared<const scene::Model>(std::move(*model));
    builder.fail(model.errors(), node.where);
    return nullptr;
  });
  if (!object.model) return;
  const glm::vec3 own = glm::max(bounds(*object.model).size(), glm::vec3(1e-3f));
  object.world_from_model *= glm::scale(scene::turned(glm::pi<float>()), glm::vec3(size) / own);
  builder.add(std::move(object));
}

/// Somebody who stands there and looks ahead.
void add_person(const Node& node, const Kind& kind, scene::Object object, SceneBuilder& builder) {
  constexpr int people = 1000;  // of whom each place has one
  constexpr float grown_up = 18.0f;
  const std::uint64_t seed = seed_of(node.text("name"), people);
  const float age = kind.age.value_or(std::max(people::someone(seed).person.age, grown_up));
  scene::Object person =
      people::person_object({.seed = seed, .age = age, .does = kind.person, .is_still = true}, builder);
  person.name = std::move(object.name), person.is_visible = object.is_visible;
  person.world_from_model =
      glm::rotate(object.world_from_model, glm::half_pi<float>(), glm::vec3(0.0f, 0.0f, 1.0f));
  builder.add(std::move(person));
}

void build_placed(const Node& node, SceneBuilder& builder, const formats::Readers& readers) {
  const Kind* kind = find_kind(builder.scene, node.text("kind"));
  if (!kind)
    return builder.fail(
        error_at(node.where_of("kind"), "{}", no_such_kind(builder.scene, node.text("kind"))));
  const glm::dvec3 size = size_of(node, *kind);
  if (Status status = check_size(node, *kind, size); !status) return builder.fail(status.errors());
  scene::Object object;
  object.name = node.text("name");
  object.world_from_model = builder.world_from_parent() *
                            glm::translate(glm::mat4(1.0f), node.vec3("position")) *
                            scene::turned(node.angle("heading_deg"));
  object.is_visible = builder.is_visible() && node.flag("visible");
  if (!kind->plant.empty()) add_plant(node, *kind, size, object.world_from_model, builder);
  if (!kind->file.empty()) return add_file(node, *kind, size, std::move(object), readers, builder);
  if (!kind->person.empty()) return add_person(node, *kind, std::move(object), builder);
  if (kind->shape.empty()) return;
  const ShapeRequest request{glm::vec3(size), node.gives("colour") ? node.vec3("colour") : kind->colour,
                             node.gives("material") ? node.text("material") : ""};
  const std::string key =
      fmt::format("design:{}:{:.4f}:{:.4f}:{:.4f}:{:.4f}:{:.4f}:{:.4f}:{}", kind->shape, size.x, size.y,
                  size.z, request.colour.x, request.colour.y, request.colour.z, request.material);
  object.model = builder.shared_model(key, [&] {
    auto model = std::make_shared<scene::Model>(shape_model(kind->shape, request));
    model->name = kind->name;
    return model;
  });
  builder.add(std::move(object));
}

/// Commands refuse a place that an object of the kind has; scripts may say what they like, and are warned.
void warn_of_shared_places(const Node& design, SceneBuilder& builder) {
  std::map<std::tuple<std::string, int, int, int>, const Node*> known;
  for (const Node& node : design.children) {
    if (node.schema->type != placed_type) continue;
    const glm::ivec3 cm(glm::round(100.0f * glm::clamp(node.vec3("position"), -1e6f, 1e6f)));
    const auto [first, is_new] = known.try_emplace({node.text("kind"), cm.x, cm.y, cm.z}, &node);
    if (!is_new)
      builder.warn(error_at(node.where, "\"{}\" stands where \"{}\" stands; move it, or take one of them out",
                            node.text("name"), first->second->text("name")));
  }
}

void build_surface(const Node& node, SceneBuilder& builder) {
  const std::vector<glm::vec3> outline = node.points("outline");
  const std::string signature = scene::signature(node);
  scene::Object object;
  object.model = builder.shared_model("design:surface:" + signature, [&] {
    return std::make_shared<scene::Model>(surface_model(outline, node.text("material"), node.vec3("colour")));
  });
  if (object.model->parts.empty())
    return builder.fail(
        error_at(node.where_of("outline"),
                 "the outline has no area or crosses itself; give at least three corners in order"));
  object.name = node.text("name");
  object.world_from_model = builder.world_from_parent();
  object.is_visible = builder.is_visible() && node.flag("visible");
  builder.add(std::move(object));
}

void check_measured(const Node& node, SceneBuilder& builder) {
  const Measurement made = measurement(node, "");
  if (Status status = check_measurement(made.quantity, made.points); !status)
    builder.fail(error_at(node.where_of("points"), "{}", status.errors().front().message));
}

void check_version(const Node& node, SceneBuilder& builder) {
  constexpr int known = 1;
  if (const std::int64_t version = node.integer("version"); version > known)
    builder.fail(error_at(node.where_of("version"),
                          "the design is of version {}, newer than this program ({}); open it with that one",
                          version, known));
}

void find_designs(const scene::Nodes& nodes, std::vector<const Node*>& found) {
  for (const Node& node : nodes)
    if (node.schema->type == design_type)
      found.push_back(&node);
    else
      find_designs(node.children, found);
}

}  // namespace

void add_design_nodes(Registries& registries) {
  auto& registry = registries.get<scene::NodeRegistry>();
  add_kind_node(registry);
  registry.add(design_schema(), [](const Node& node, SceneBuilder& builder) {
    check_version(node, builder);
    warn_of_shared_places(node, builder);
    builder.build(node.children, glm::mat4(1.0f), node.flag("visible"));
  });
  registry.add(placed_schema(),
               [readers = &registries.get<formats::Readers>()](const Node& node, SceneBuilder& builder) {
                 build_placed(node, builder, *readers);
               });
  registry.allow(view_type, design_type);
  registry.add(surface_schema(), build_surface);
  registry.add(measured_schema(), check_measured);
}

bool is_thing(const Node& node) {
  return node.schema->type == placed_type || node.schema->type == surface_type ||
         node.schema->type == measured_type;
}

std::vector<const Node*> designs_of(const scene::LiveScene& live) {
  std::vector<const Node*> found;
  find_designs(live.nodes(), found);
  return found;
}

PlacedObject placed_object(const scene::Scene& scene, const Node& node, const std::string& design) {
  PlacedObject object;
  object.name = node.text("name"), object.design = design, object.group = node.text("group");
  object.is_locked = node.flag("locked"), object.is_visible = node.flag("visible");
  if (node.gives("material")) object.material = node.text("material");
  if (node.schema->type == surface_type) {
    object.kind = "ground", object.label = "Ground surface", object.colour = node.vec3("colour");
    object.material = node.text("material");
    glm::dvec3 low(1e30), high(-1e30);
    for (const glm::vec3& corner : node.points("outline")) {
      const glm::dvec3 at = exact_decimals(corner);
      object.outline.emplace_back(at), low = glm::min(low, at), high = glm::max(high, at);
    }
    if (signed_area_m2(object.outline) < 0.0) std::ranges::reverse(object.outline);
    object.position = 0.5 * (low + high), object.size_m = high - low;
    return object;
  }
  object.kind = node.text("kind");
  if (node.schema->type == measured_type) {
    for (const glm::vec3& point : node.points("points")) object.outline.emplace_back(exact_decimals(point));
    object.label = object.kind;
    if (!object.outline.empty()) object.position = exact_decimals(node.points("points").front());
    return object;
  }
  object.position = exact_decimals(node.vec3("position"));
  object.heading_deg = exact_decimal(float(glm::degrees(node.number("heading_deg"))));
  const Kind* kind = find_kind(scene, object.kind);
  object.label = kind ? kind->label : object.kind;
  if (kind) object.label_fr = kind->label_fr;
  object.size_m = kind ? size_of(node, *kind) : glm::dvec3(1.0);
  object.is_round = kind && kind->is_round;
  object.colour = node.gives("colour") ? node.vec3("colour") : kind ? kind->colour : glm::vec3(0.5f);
  const glm::dvec2 at(object.position), plan(object.size_m);
  object.outline = object.is_round ? ellipse_outline(at, plan, object.heading_deg)
                                   : rectangle_outline(at, plan, object.heading_deg);
  return object;
}

std::vector<PlacedObject> placed_objects(const scene::Scene& scene, const scene::LiveScene& live,
                                         const std::string& design, bool only_visible) {
  std::vector<PlacedObject> all;
  for (const Node* node : designs_of(live)) {
    const std::string name = node->text("name");
    const bool is_shown = live.frame_of(*node).is_visible && node->flag("visible");
    if ((!design.empty() && name != design) || (only_visible && !is_shown)) continue;
    for (const Node& child : node->children) {
      if (child.schema->type == measured_type || !is_thing(child)) continue;
      PlacedObject object = placed_object(scene, child, name);
      object.is_visible = object.is_visible && is_shown;
      if (!only_visible || object.is_visible) all.push_back(std::move(object));
    }
  }
  return all;
}

Measurement measurement(const scene::Node& node, const std::string& design) {
  Measurement made;
  made.name = node.text("name"), made.design = design;
  made.quantity = Quantity(std::ranges::find(quantity_names(), node.text("kind")) - quantity_names().begin());
  for (const glm::vec3& point : node.points("points")) made.points.push_back(exact_decimals(point));
  made.is_locked = node.flag("locked"), made.is_visible = node.flag("visible");
  return made;
}

std::vector<Measurement> measurements(const scene::LiveScene& live, const std::string& design,
                                      bool only_visible) {
  std::vector<Measurement> all;
  for (const Node* node : designs_of(live)) {
    const std::string name = node->text("name");
    const bool is_shown = live.frame_of(*node).is_visible && node->flag("visible");
    if ((!design.empty() && name != design) || (only_visible && !is_shown)) continue;
    for (const Node& child : node->children) {
      if (child.schema->type != measured_type) continue;
      Measurement made = measurement(child, name);
      made.is_visible = made.is_visible && is_shown;
      const bool is_whole = check_measurement(made.quantity, made.points).ok();  // messages may break it
      if (is_whole && (!only_visible || made.is_visible)) all.push_back(std::move(made));
    }
  }
  return all;
}

}  // namespace parvis::design
