#include "viewer/node_rows.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/test_folder.h"
#include "formats/gltf/gltf_writer.h"
#include "rooms/rooms.h"
#include "scene/action/actions.h"
#include "scene/data/test_scene.h"
#include "scene/script/attribute.h"
#include "stage/stage.h"

namespace parvis::viewer {
namespace {

constexpr const char* script =
    "sun(azimuth_deg=140, elevation_deg=40)\n"
    "group(name=trees, visible=0) {\n"
    "  model(name=oak, file=\"box.glb\", position=\"1 2 0\") { material(preset=paint, target=\"part\") }\n"
    "  group() { model(file=\"box.glb\", positions=\"0 0\", positions=\"4 0, 5 0\") }\n"
    "}\n"
    "camera(name=eye)\n"
    "timer(name=clock, onTime=\"5, trees, show\")\n";

class NodeRowsTest : public testing::Test {
 protected:
  NodeRowsTest() {
    EXPECT_TRUE(scene::write_gltf(folder_.path() / "box.glb",
                                  *scene::model_of(scene::box(glm::vec3(0.0f), glm::vec3(1.0f)), {})));
    Result<stage::Simulation> simulation =
        stage::open_simulation(rooms::all_registries(), folder_.write("scene.xp", script), {});
    EXPECT_TRUE(simulation) << to_string(simulation.errors());
    if (simulation) simulation_ = std::make_unique<stage::Simulation>(*std::move(simulation));
  }

  scene::LiveScene& live() { return simulation_->live(); }
  const scene::Node& node(const std::string& name) { return *live().find(name); }

  /// "group trees" for each row, a dash before it for each level.
  std::string tree(const std::set<const scene::Node*>& open, const std::string& filter = "") {
    std::string text;
    for (const NodeRow& row : node_rows(live(), open, filter))
      text += std::string(std::size_t(row.depth), '-') + row.kind + " " +
              (row.name.empty() ? row.says : row.name) + "\n";
    return text;
  }
  AttributeRow row(const std::string& of, const std::string& attribute) {
    for (const AttributeRow& each : attribute_rows(live(), node(of)))
      if (each.schema->name == attribute) return each;
    ADD_FAILURE() << of << " has no " << attribute;
    return {};
  }

  TestFolder folder_;
  std::unique_ptr<stage::Simulation> simulation_;
};

TEST_F(NodeRowsTest, ShowWhatIsOpen) {
  const std::string closed = "sun 140\ngroup trees\ncamera eye\ntimer clock\n";
  EXPECT_EQ(tree({}), closed);
  const scene::Node* trees = &node("trees");
  EXPECT_EQ(tree({trees}), "sun 140\ngroup trees\n-model oak\n-group \ncamera eye\ntimer clock\n");
  EXPECT_EQ(tree({trees, &*std::next(trees->children.begin())}),
            "sun 140\ngroup trees\n-model oak\n-group \n--model box.glb\ncamera eye\ntimer clock\n");
}

TEST_F(NodeRowsTest, FindByNameAndKindWithWhatIsAroundThem) {
  EXPECT_EQ(tree({}, "OAK"), "group trees\n-model oak\n");
  EXPECT_EQ(tree({}, "model"), "group trees\n-model oak\n-group \n--model box.glb\n");
  EXPECT_EQ(tree({}, "palm"), "");
}

TEST_F(NodeRowsTest, TellWhatIsInSight) {
  const auto rows = node_rows(live(), {&node("trees")}, "");
  EXPECT_FALSE(rows[0].can_hide) << "a sun";
  EXPECT_TRUE(rows[1].can_hide);
  EXPECT_FALSE(rows[1].is_visible);
  EXPECT_TRUE(rows[2].is_visible) << "by itself";
  EXPECT_FALSE(rows[2].is_in_sight) << "but its group is hidden";
}

TEST_F(NodeRowsTest, AttributesComeWithTheirEditors) {
  EXPECT_EQ(row("%sun", "elevation_deg").editor, Editor::number);
  EXPECT_EQ(row("%sun", "elevation_deg").label, "elevation");
  EXPECT_NEAR(row("%sun", "elevation_deg").numbers[0], 40.0, 1e-9) << "degrees, as the script";
  EXPECT_EQ(row("%sun", "irradiance").editor, Editor::colour);
  EXPECT_EQ(row("oak", "position").editor, Editor::three_numbers);
  EXPECT_EQ(row("oak", "position").numbers, (std::array<double, 3>{1, 2, 0}));
  EXPECT_EQ(row("trees", "visible").editor, Editor::flag);
  EXPECT_EQ(row("trees", "visible").numbers[0], 0.0);
  EXPECT_EQ(row("oak", "up").editor, Editor::choice);
  EXPECT_TRUE(row("oak", "position").is_given);
  EXPECT_FALSE(row("oak", "scale").is_given);
  EXPECT_EQ(row("oak", "scale").numbers[0], 1.0) << "its default";
  const scene::Node& copies = std::next(node("trees").children.begin())->children.front();
  for (const AttributeRow& each : attribute_rows(live(), copies))
    if (each.schema->name == "positions") {
      EXPECT_EQ(each.text, "2 values: 0 0");
    }
}

TEST_F(NodeRowsTest, FixedAttributesSayWhy) {
  EXPECT_EQ(row("oak", "position").fixed_because, "");
  EXPECT_NE(row("oak", "file").fixed_because, "");
  EXPECT_NE(row("oak", "name").fixed_because, "");
  EXPECT_NE(row("oak", "reflective").fixed_because, "");
  EXPECT_NE(row("clock", "onTime").fixed_because.find("event"), std::string::npos);
  const scene::Node& material = node("oak").children.front();
  for (const AttributeRow& each : attribute_rows(live(), material))
    EXPECT_NE(each.fixed_because.find("part of the node around it"), std::string::npos) << each.label;
}

TEST_F(NodeRowsTest, EditsAreValuesThatTheNodeTakes) {
  const auto edited = [this](const char* of, const char* attribute, std::array<double, 3> numbers) {
    AttributeRow edit = row(of, attribute);
    edit.numbers = numbers;
    return simulation_->clock.send(node(of), *edit.schema, *edited_value(edit));
  };
  const double third = double(1.0f / 3.0f);
  EXPECT_TRUE(edited("oak", "position", {third, -2, 1e-3}));
  EXPECT_TRUE(edited("%sun", "elevation_deg", {12.5}));
  EXPECT_TRUE(edited("%sun", "irradiance", {1, 2, 3}));
  EXPECT_TRUE(edited("trees", "visible", {1}));
  const Status refused = edited("%sun", "elevation_deg", {200});
  EXPECT_NE(to_string(refused.errors()).find("from -90 to 90"), std::string::npos);
  simulation_->advance(0.1);
  EXPECT_EQ(row("oak", "position").numbers[0], third) << "every bit of it";
  EXPECT_NEAR(row("%sun", "elevation_deg").numbers[0], 12.5, 1e-9);
  EXPECT_EQ(simulation_->scene.sun.irradiance, glm::vec3(1, 2, 3));
  EXPECT_EQ(row("trees", "visible").numbers[0], 1.0);
}

TEST_F(NodeRowsTest, AnEmptyTextIsRefusedWhereAValueIsNeeded) {
  const auto edited = [](scene::AttributeSchema schema, const char* text) {
    AttributeRow row;
    row.schema = &schema, row.text = text;
    const Result<scene::AttributeValue> value = edited_value(row);
    return value ? "" : value.errors().front().message;
  };
  using scene::attribute::reference, scene::attribute::text, scene::attribute::choice;
  for (const char* empty : {"", " \t\n"}) {
    EXPECT_EQ(edited(text("title", "").required(), empty), "title is empty; expected a text");
    EXPECT_EQ(edited(reference("target", "", {"model"}), empty),
              "target is empty; expected the name of a model");
    EXPECT_EQ(edited(choice("kind", "", {"oak", "beech"}).required(), empty).find("kind is empty"), 0u);
    EXPECT_EQ(edited(text("title", ""), empty), "") << "it may be left out";
  }
  EXPECT_EQ(edited(text("title", "").required(), "oaks"), "");
}

/// The panel can edit whatever is live in any node type there is.
TEST_F(NodeRowsTest, EveryLiveAttributeTakesBackItsOwnValue) {
  for (const scene::NodeType& type : rooms::node_registry().types())
    for (const scene::AttributeSchema& schema : type.schema.attributes) {
      EXPECT_FALSE(drag_style(schema).format.empty());
      if (!schema.is_live) continue;
      scene::Node node;
      node.schema = &type.schema;
      if (schema.is_required && !schema.choices.empty()) node.set(schema.name, schema.choices.front());
      if (schema.is_required && schema.type == scene::AttributeType::points)
        node.set(schema.name, std::vector<glm::vec3>{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}});
      for (const AttributeRow& each : attribute_rows(live(), node)) {
        if (each.schema != &schema) continue;
        const Result<scene::AttributeValue> value = edited_value(each);
        ASSERT_TRUE(value) << type.schema.type << ": " << to_string(value.errors());
        const Status status = check_value(schema, *value);
        EXPECT_TRUE(status) << type.schema.type << ": " << to_string(status.errors());
      }
    }
}

}  // namespace
}  // namespace parvis::viewer
