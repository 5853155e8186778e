// Any text as a scene script: it is read or refused, and what is read is formatted without loss.
#include <cstdlib>

#include "scene/script/message.h"
#include "scene/script/node_registry.h"
#include "scene/script/script_format.h"
#include "scene/script/script_reader.h"
#include "scene/script/test_registries.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace parvis::scene;
  static const parvis::Registries registries = test_registries();
  const NodeRegistry& registry = registries.get<NodeRegistry>();
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto tree = parse_script_file(text, "fuzz.xp");
  if (!tree) return 0;
  const std::string once = format_script(*tree);
  const auto again = parse_script_file(once, "fuzz.xp");
  if (!again || format_script(*again) != once) std::abort();
  for (const ScriptNode& node : tree->children) {
    const NodeType* type = registry.find(node.type);
    if (!type) continue;
    for (const ScriptAttribute& attribute : node.attributes) {
      if (const AttributeSchema* schema = type->schema.find(attribute.name))
        (void)parse_value(*schema, attribute.value, parvis::Roots("/nonexistent"), {});
      (void)parse_message(type->schema, attribute.value, {});
    }
  }
  return 0;
}
