#include "scene/scene_reference.h"

#include <gtest/gtest.h>

#include "base/files.h"
#include "scene/script_reader.h"

namespace parvis::scene {
namespace {

TEST(SceneReference, TheCommittedFileIsUpToDate) {
  const std::string expected = scene_reference(core_nodes());
  const std::filesystem::path file = std::filesystem::path(PARVIS_SOURCE_DIR) / "docs/scene-reference.md";
  const auto committed = read_file(file);
  ASSERT_TRUE(committed) << to_string(committed.errors());
  EXPECT_TRUE(*committed == expected) << "docs/scene-reference.md is out of date: write it anew with\n"
                                         "  parvis check --reference > docs/scene-reference.md";
}

TEST(SceneReference, NamesEveryNodeAndAttribute) {
  const NodeRegistry registry = core_nodes();
  const std::string text = scene_reference(registry);
  for (const NodeType& type : registry.types()) {
    EXPECT_NE(text.find("\n## " + type.schema.type + "\n"), std::string::npos);
    for (const AttributeSchema& attribute : type.schema.attributes)
      EXPECT_NE(text.find("| `" + attribute.name + "` |"), std::string::npos) << attribute.name;
  }
}

TEST(SceneReference, EveryExampleParsesAndUsesKnownAttributes) {
  const NodeRegistry registry = core_nodes();
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
      for (const ScriptAttribute& attribute : node.attributes)
        EXPECT_NE(registry.find(node.type)->schema.find(attribute.name), nullptr) << attribute.name;
    }
    EXPECT_TRUE(shows_itself) << type.schema.type;
  }
}

TEST(NodeRegistry, DefaultsAreValuesOfTheirType) {
  const NodeRegistry registry = core_nodes();
  for (const NodeType& type : registry.types())
    for (const AttributeSchema& attribute : type.schema.attributes) {
      if (attribute.fallback.empty()) continue;
      const auto value = parse_value(attribute, attribute.fallback, Roots(""), {});
      EXPECT_TRUE(value) << type.schema.type << " " << (value ? "" : to_string(value.errors()));
    }
}

}  // namespace
}  // namespace parvis::scene
