#include "scene/script/schema_json.h"

#include <nlohmann/json.hpp>

namespace parvis::scene {
namespace {

using Json = nlohmann::ordered_json;

const char* word_of(AttributeType type) {
  constexpr std::array words{"text",   "number", "integer", "flag", "angle",     "vec3",  "colour",
                             "choice", "path",   "points",  "file", "reference", "child", "event"};
  static_assert(words.size() == std::size_t(AttributeType::event) + 1);
  return words[std::size_t(type)];
}

Json json_of(const AttributeSchema& schema) {
  const AttributeSchema unlimited;
  Json json{{"name", schema.name}, {"type", word_of(schema.type)}, {"help", schema.help}};
  if (!schema.unit.empty()) json["unit"] = schema.unit;
  if (!schema.fallback.empty()) json["default"] = schema.fallback;
  if (schema.minimum != unlimited.minimum) json["minimum"] = schema.minimum;
  if (schema.maximum != unlimited.maximum) json["maximum"] = schema.maximum;
  if (!schema.choices.empty()) json["choices"] = schema.choices;
  if (schema.type == AttributeType::event) json["source"] = word_of(schema.source);
  if (!schema.refers_to.empty()) json["refers_to"] = schema.refers_to;
  if (!schema.spellings.empty()) json["spellings"] = schema.spellings;
  json["is_required"] = schema.is_required;
  json["is_repeatable"] = schema.is_repeatable;
  json["is_live"] = schema.is_live;
  return json;
}

Json json_of(const MessageSchema& schema);

template <class Schemas>
Json list_of(const Schemas& schemas) {
  Json list = Json::array();
  for (const auto& schema : schemas) list.push_back(json_of(schema));
  return list;
}

Json json_of(const MessageSchema& schema) {
  return {{"name", schema.name}, {"help", schema.help}, {"arguments", list_of(schema.arguments)}};
}

Json json_of(const NodeSchema& schema) {
  return {{"type", schema.type},
          {"help", schema.help},
          {"stands_in", schema.stands_in},
          {"is_unique", schema.is_unique},
          {"attributes", list_of(schema.attributes)},
          {"messages", list_of(schema.messages)},
          {"example", schema.example}};
}

}  // namespace

std::string schema_json(const NodeRegistry& registry) {
  Json nodes = Json::array();
  for (const NodeType& type : registry.types()) nodes.push_back(json_of(type.schema));
  return Json{{"nodes", std::move(nodes)}}.dump(2) + "\n";
}

}  // namespace parvis::scene
