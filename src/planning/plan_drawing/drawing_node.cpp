// planDrawing: a DXF file as lines under a place.
#include <map>
#include <mutex>

#include "formats/drawings/drawing_account.h"
#include "formats/drawings/drawing_facts.h"
#include "formats/drawings/drawing_reader.h"
#include "planning/plan_drawing/drawn_layer.h"
#include "planning/plan_drawing/layer_choice.h"
#include "planning/plan_drawing/placed_blocks.h"
#include "planning/plan_drawing/placed_drawing.h"
#include "planning/plan_drawing/plan_nodes.h"
#include "planning/plan_drawing/text_outlines.h"
#include "scene/script/attribute.h"
#include "scene/script/node_registry.h"
#include "scene/script/scene_builder.h"

namespace parvis::plan_drawing {
namespace {

using namespace scene::attribute;

scene::NodeSchema drawing_schema() {
  scene::NodeSchema schema{
      .type = "planDrawing",
      .help =
          "A plan drawing (DXF) as lines, areas and texts that lie flat under the place or over it. A "
          "drawing "
          "in map coordinates stands where they say; the first georeferenced thing gives the scene its "
          "origin.",
      .attributes =
          {text("name", "by which other nodes refer to it"), file("file", "the drawing, .dxf").required(),
           choice("unit", "of the drawing's coordinates; \"file\": the one that it names",
                  {"file", "mm", "cm", "dm", "m", "km", "in", "ft"})
               .by_default("file"),
           text("layers",
                "layers to show, and with a - to hide, beside those that the drawing shows: names with * and "
                "?, separated by commas; \"-*, BATI, ARBRES\" shows two alone")
               .live(),
           text("blocks",
                "blocks that stand for objects, each with a kind: \"ARBRE*=tree, BANC=bench\"; plans and "
                "tables list them"),
           number("line_width", "of lines that have none of their own")
               .in("m")
               .between(0.001, 10.0)
               .by_default("0.05")},
      .stands_in = {scene::top_level, "group", "scenario"},
      .example = "planDrawing(name=\"survey\", file=\"plans/square.dxf\", layers=\"-COTES\")"};
  add_plan_attributes(schema);
  return schema;
}

/// Drawings that scenes show now, by file and unit: a node whose layers change reads nothing again.
class KnownDrawings {
 public:
  std::shared_ptr<const formats::Drawing> read(const scene::Node& node, scene::SceneBuilder& builder) {
    const std::string unit = node.text("unit");
    const std::filesystem::path file = node.file("file");
    std::error_code code;
    const auto changed = std::filesystem::last_write_time(file, code).time_since_epoch().count();
    const std::string key = fmt::format("{}?{}&{}", file.string(), unit, changed);
    const std::lock_guard lock(mutex_);
    if (auto held = drawings_[key].lock()) return held;
    Errors warnings;
    Result<formats::Drawing> read = formats::read_drawing(file, formats::metres_of_unit(unit), warnings);
    for (const Error& warning : warnings) builder.warn(warning);
    if (!read) {
      builder.fail(read.errors(), node.where_of("file"));
      return nullptr;
    }
    for (const Error& warning : formats::account_of(*read, file.string()).warnings()) builder.warn(warning);
    const auto drawing = std::make_shared<const formats::Drawing>(*std::move(read));
    drawings_[key] = drawing;
    return drawing;
  }

 private:
  std::mutex mutex_;
  std::map<std::string, std::weak_ptr<const formats::Drawing>> drawings_;
};

/// One object for each layer that draws something, those that are hidden included: showing one loads nothing.
void add_layers(const scene::Node& node, const PlacedDrawing& placed, scene::SceneBuilder& builder) {
  const double width_m = node.number("line_width");
  const auto account = std::make_shared<const scene::FileAccount>(
      formats::account_of(*placed.drawing, node.file("file").string()));
  for (std::size_t i = 0; i < placed.drawing->layers.size(); ++i) {
    const std::string& layer = placed.drawing->layers[i].name;
    const std::string key = fmt::format("{}?plan&unit={}&width={}&layer={}", node.file("file").string(),
                                        node.text("unit"), width_m, i);
    const auto model = builder.shared_model(key, [&] {
      scene::Model made = layer_model(*placed.drawing, int(i), placed.origin, width_m);
      made.account = account;
      return std::make_shared<const scene::Model>(std::move(made));
    });
    if (model->parts.empty()) continue;
    scene::Object object;
    object.name = fmt::format("{} {}", placed.called, layer);
    object.model = model;
    object.world_from_model = placed.world_from_plan;
    object.is_visible = placed.is_visible && placed.shows_layer[i];
    builder.add(std::move(object));
  }
}

void build(const scene::Node& node, scene::SceneBuilder& builder, KnownDrawings& known) {
  PlacedDrawing placed;
  placed.drawing = known.read(node, builder);
  if (!placed.drawing) return;
  if (const Status letters = placed.drawing->texts.empty() ? Status(Ok{}) : letters_known(); !letters)
    return builder.fail(letters.errors(), node.where_of("file"));
  const Result<std::vector<bool>> shown =
      shown_layers(*placed.drawing, node.gives("layers") ? node.text("layers") : "");
  if (!shown) return builder.fail(shown.errors(), node.where_of("layers"));
  const auto kinds = block_kinds(node.gives("blocks") ? node.text("blocks") : "");
  if (!kinds) return builder.fail(kinds.errors(), node.where_of("blocks"));
  placed.shows_layer = *shown, placed.block_kinds = *kinds;
  placed.called = node.gives("name") ? node.text("name") : node.file("file").stem().string();
  placed.origin = placed.drawing->local_origin();
  placed.world_from_plan = world_from_plan(node, placed.origin, builder);
  placed.is_visible = builder.is_visible() && node.flag("visible");
  add_layers(node, placed, builder);
  builder.add(std::move(placed));
}

}  // namespace

void add_drawing_node(scene::NodeRegistry& registry) {
  const auto known = std::make_shared<KnownDrawings>();
  registry.add(drawing_schema(), [known](const scene::Node& node, scene::SceneBuilder& builder) {
    build(node, builder, *known);
  });
}

}  // namespace parvis::plan_drawing
