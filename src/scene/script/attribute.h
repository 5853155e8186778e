// Attributes of node types in one or two lines each:
//   number("radius", "of the wheel").in("m").between(0.1, 2).by_default("0.3").live()
// One function per type; further properties are chained to it (AttributeSchema).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "scene/script/schema.h"

namespace parvis::scene::attribute {

/// An attribute of the given type; `help`: one line.
inline AttributeSchema of_type(AttributeType type, std::string name, std::string help) {
  AttributeSchema schema;
  schema.name = std::move(name);
  schema.type = type;
  schema.help = std::move(help);
  return schema;
}

/// AttributeType::text.
inline AttributeSchema text(std::string name, std::string help) {
  return of_type(AttributeType::text, std::move(name), std::move(help));
}
/// AttributeType::number.
inline AttributeSchema number(std::string name, std::string help) {
  return of_type(AttributeType::number, std::move(name), std::move(help));
}
/// AttributeType::integer.
inline AttributeSchema integer(std::string name, std::string help) {
  return of_type(AttributeType::integer, std::move(name), std::move(help));
}
/// AttributeType::flag.
inline AttributeSchema flag(std::string name, std::string help) {
  return of_type(AttributeType::flag, std::move(name), std::move(help));
}
/// AttributeType::angle: the name ends in _deg.
inline AttributeSchema angle(std::string name, std::string help) {
  return of_type(AttributeType::angle, std::move(name), std::move(help));
}
/// AttributeType::vec3.
inline AttributeSchema vec3(std::string name, std::string help) {
  return of_type(AttributeType::vec3, std::move(name), std::move(help));
}
/// AttributeType::colour.
inline AttributeSchema colour(std::string name, std::string help) {
  return of_type(AttributeType::colour, std::move(name), std::move(help));
}
/// AttributeType::choice: one of `choices`.
inline AttributeSchema choice(std::string name, std::string help, std::vector<std::string> choices = {}) {
  AttributeSchema schema = of_type(AttributeType::choice, std::move(name), std::move(help));
  schema.choices = std::move(choices);
  return schema;
}
/// AttributeType::path.
inline AttributeSchema path(std::string name, std::string help) {
  return of_type(AttributeType::path, std::move(name), std::move(help));
}
/// AttributeType::points.
inline AttributeSchema points(std::string name, std::string help) {
  return of_type(AttributeType::points, std::move(name), std::move(help));
}
/// AttributeType::file.
inline AttributeSchema file(std::string name, std::string help) {
  return of_type(AttributeType::file, std::move(name), std::move(help));
}
/// AttributeType::reference to a node of one of these types; empty: of any type.
inline AttributeSchema reference(std::string name, std::string help, std::vector<std::string> types = {}) {
  AttributeSchema schema = of_type(AttributeType::reference, std::move(name), std::move(help));
  schema.refers_to = std::move(types);
  return schema;
}
/// AttributeType::child.
inline AttributeSchema child(std::string name, std::string help) {
  return of_type(AttributeType::child, std::move(name), std::move(help));
}

}  // namespace parvis::scene::attribute
