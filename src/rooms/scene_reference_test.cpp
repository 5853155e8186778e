#include "scene/script/scene_reference.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/files.h"
#include "base/test_data.h"
#include "rooms/rooms.h"
#include "scene/script/schema_json.h"
#include "scene/script/script_reader.h"
#include "stage/stage.h"

namespace parvis::rooms {
namespace {

using namespace scene;  // all of it is about this room

TEST(SceneReference, TheCommittedFileIsUpToDate) {
  const std::string expected = scene_reference(node_registry());
  const std::filesystem::path file = source_folder() / "docs/scene-reference.md";
  const auto committed = read_file(file);
  ASSERT_TRUE(committed) << to_string(committed.errors());
  EXPECT_TRUE(*committed == expected) << "docs/scene-reference.md is out of date: write it again with\n"
                                         "  parvis check --reference > docs/scene-reference.md";
}

TEST(SceneReference, NamesEveryNodeAttributeAndMessage) {
  const NodeRegistry& registry = node_registry();
  const std::string text = scene_reference(registry);
  for (const NodeType& type : registry.types()) {
    EXPECT_NE(text.find("\n## " + type.schema.type + "\n"), std::string::npos);
    for (const AttributeSchema& attribute : type.schema.attributes)
      EXPECT_NE(text.find("| `" + attribute.name + "` |"), std::string::npos) << attribute.name;
    for (const MessageSchema& message : type.schema.messages)
      EXPECT_NE(text.find("| `" + message.name), std::string::npos) << message.name;
  }
}

TEST(SchemaJson, HoldsEveryNodeAttributeAndMessage) {
  const NodeRegistry& registry = node_registry();
  const auto json = nlohmann::json::parse(schema_json(registry));
  ASSERT_EQ(json["nodes"].size(), registry.types().size());
  for (std::size_t i = 0; i < registry.types().size(); ++i) {
    const NodeSchema& schema = registry.types()[i].schema;
    const nlohmann::json& node = json["nodes"][i];
    EXPECT_EQ(node["type"], schema.type);
    ASSERT_EQ(node["attributes"].size(), schema.attributes.size());
    EXPECT_EQ(node["messages"].size(), schema.messages.size());
    for (std::size_t k = 0; k < schema.attributes.size(); ++k) {
      const AttributeSchema& attribute = schema.attributes[k];
      EXPECT_EQ(node["attributes"][k]["name"], attribute.name);
      EXPECT_EQ(node["attributes"][k].value("default", ""), attribute.fallback);
      EXPECT_EQ(node["attributes"][k].value("unit", ""), attribute.unit);
    }
  }
}

TEST(SceneReference, EveryExampleParsesAndUsesKnownAttributes) {
  const NodeRegistry& registry = node_registry();
  for (const NodeType& type : registry.types()) {
    const auto nodes = parse_script(type.schema.example, type.schema.type);
    ASSERT_TRUE(nodes) << to_string(nodes.errors());
    std::vector<const ScriptNode*> open;
    for (const ScriptNode& node : *nodes) open.push_back(&node);
    bool shows_itself = false;
    while (!open.empty()) {
      const ScriptNode& node = *open.back();
      open.pop_back();
      for (const ScriptNode& child : node.children) open.push_back(&child);
      shows_itself |= node.type == type.schema.type;
      ASSERT_NE(registry.find(node.type), nullptr) << node.type;
      if (!registry.find(node.type)->schema.takes_attributes_of.empty()) continue;
      for (const ScriptAttribute& attribute : node.attributes)
        EXPECT_NE(registry.find(node.type)->schema.find(attribute.name), nullptr) << attribute.name;
    }
    EXPECT_TRUE(shows_itself) << type.schema.type;
  }
}

TEST(NodeRegistry, DefaultsAreValuesOfTheirType) {
  const NodeRegistry& registry = node_registry();
  for (const NodeType& type : registry.types())
    for (const AttributeSchema& attribute : type.schema.attributes) {
      if (attribute.fallback.empty()) continue;
      const auto value = parse_value(attribute, attribute.fallback, Roots(""), {});
      EXPECT_TRUE(value) << type.schema.type << " " << (value ? "" : to_string(value.errors()));
    }
}

}  // namespace
}  // namespace parvis::rooms
