#include "scene/script/scene_reference.h"

#include <algorithm>

namespace parvis::scene {
namespace {

constexpr const char* introduction = R"(# Scene reference

*Generated from the node types of the program (`parvis check --reference`); do not edit.*

A scene is a text file, `NAME.xp`, of nodes:

```
// a comment; so is # this
type(attribute=value, attribute="a value with spaces") {
  child(...)
}
```

- Words without spaces, brackets, commas, quotes, `#` or `//` need no quotes. In quotes, `\"`, `\\`, `\n` and `\t` stand
  for themselves. A text ends on its line; texts that follow each other are joined.
- Metres, x east, y north, z up. Angles are written in degrees (`..._deg`), headings clockwise from above.
- Colours are `"#RRGGBB"` (sRGB) or three linear numbers. Flags are `1` or `0`.
- Files lie below the scene's folder or below a folder given by `--data`, and paths may not lead out of it. A path is
  relative to the script that names the file, included ones too, or else to one of these folders.
- Names (`name=`) are unique in a scene. The one node of a type that stands once in a scene is also called `%TYPE`:
  `%sun`.
- A node takes messages while the scene runs: its section lists them. The last argument takes the rest of the message.
- An event attribute sends one: `onPress="button2, trees, show oaks, 0.5"`: what must happen, the node that receives the
  message, the message, and how many seconds later (none if left out).
)";

std::string type_name(AttributeType type) {
  switch (type) {
    case AttributeType::text:
      return "text";
    case AttributeType::number:
      return "number";
    case AttributeType::integer:
      return "whole number";
    case AttributeType::flag:
      return "flag";
    case AttributeType::angle:
      return "angle";
    case AttributeType::vec3:
      return "three numbers";
    case AttributeType::colour:
      return "colour";
    case AttributeType::choice:
      return "choice";
    case AttributeType::path:
      return "path";
    case AttributeType::points:
      return "points";
    case AttributeType::file:
      return "file";
    case AttributeType::reference:
      return "name of a node";
    case AttributeType::child:
      return "name of a node inside";
    case AttributeType::event:
      return "event";
  }
  return "";
}

std::string escaped(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, 1, '\\');
  return text;
}

std::string limits(const AttributeSchema& schema) {
  const AttributeSchema unlimited;
  const bool from = schema.minimum != unlimited.minimum, to = schema.maximum != unlimited.maximum;
  if (from && to) return fmt::format(" {} to {}", schema.minimum, schema.maximum);
  if (from) return fmt::format(" >= {}", schema.minimum);
  if (to) return fmt::format(" <= {}", schema.maximum);
  return "";
}

std::string choices_of(const AttributeSchema& schema) {
  constexpr std::size_t few = 12;
  if (schema.choices.size() <= few) return fmt::format(" (`{}`)", fmt::join(schema.choices, "`, `"));
  return fmt::format(" ({} names: `{}`, ..., `{}`)", schema.choices.size(), schema.choices.front(),
                     schema.choices.back());
}

std::string attribute_row(const AttributeSchema& schema) {
  std::string type = type_name(schema.type) + limits(schema);
  if (!schema.unit.empty()) type += ", " + schema.unit;
  if (schema.type == AttributeType::event) type += fmt::format(", `{}`", event_pattern(schema));
  if (schema.is_repeatable) type += "; may repeat";
  std::string fallback = schema.is_required ? "*required*" : "";
  if (!schema.fallback.empty()) fallback = fmt::format("`{}`", schema.fallback);
  std::string help = schema.help;
  if (!schema.choices.empty()) help += choices_of(schema);
  if (!schema.spellings.empty())
    help += fmt::format("; also spelt `{}`", fmt::join(schema.spellings, "`, `"));
  return fmt::format("| `{}` | {} | {} | {} |\n", schema.name, type, fallback, escaped(help));
}

std::string message_row(const MessageSchema& schema) {
  std::string pattern = schema.name;
  std::string types;
  for (const AttributeSchema& argument : schema.arguments) {
    pattern += argument.is_required ? " " + argument.name : fmt::format(" [{}]", argument.name);
    types += (types.empty() ? "" : "; ") + type_name(argument.type) + limits(argument);
    if (!argument.unit.empty()) types += ", " + argument.unit;
  }
  return fmt::format("| `{}` | {} | {} |\n", pattern, types, escaped(schema.help));
}

std::string place_in_tree(const NodeSchema& schema) {
  std::vector<std::string> places;
  places.reserve(schema.stands_in.size());
  for (const std::string& parent : schema.stands_in)
    places.push_back(parent == top_level ? "at the top level" : fmt::format("in `{}`", parent));
  return fmt::format("Stands {}{}.", fmt::join(places, ", "), schema.is_unique ? ", once in a scene" : "");
}

std::string node_section(const NodeSchema& schema, const NodeRegistry& registry) {
  std::string text = fmt::format("\n## {}\n\n{}\n\n{}", schema.type, schema.help, place_in_tree(schema));
  const std::vector<std::string> children = registry.children_of(schema.type);
  if (!children.empty()) text += fmt::format(" Takes `{}`.", fmt::join(children, "`, `"));
  text += "\n";
  if (!schema.attributes.empty()) text += "\n| attribute | type | default | |\n| --- | --- | --- | --- |\n";
  for (const AttributeSchema& attribute : schema.attributes) text += attribute_row(attribute);
  if (!schema.messages.empty()) text += "\n| message | arguments | |\n| --- | --- | --- |\n";
  for (const MessageSchema& message : schema.messages) text += message_row(message);
  return text + fmt::format("\n```\n{}\n```\n", schema.example);
}

}  // namespace

std::string scene_reference(const NodeRegistry& registry) {
  std::string text = introduction;
  for (const NodeType& type : registry.types()) text += node_section(type.schema, registry);
  return text;
}

}  // namespace parvis::scene
