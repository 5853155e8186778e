// A node of a checked script: its attributes have values of their schema's types, its references name nodes
// that exist, its files lie where a scene may read.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "scene/script/schema.h"

namespace parvis::scene {

struct NodeAttribute {
  const AttributeSchema* schema = nullptr;
  AttributeValue value;
  std::string text;  ///< as the script writes it; empty: the value was set while the scene runs
  FileLocation where;
};

/// The getters take the name of an attribute of the node's schema and assert that it has that type; where the
/// script does not give it they return its default.
struct Node {
  const NodeSchema* schema = nullptr;
  FileLocation where;
  std::vector<NodeAttribute> attributes;  ///< in the order written, repeats included
  std::vector<Node> children;             ///< included files put their nodes in place
  std::vector<NodeAttribute> overrides;   ///< of the node that `schema->takes_attributes_of` names

  /// Changes the attribute from now on. The value must be of the attribute's type.
  void set(const std::string& name, AttributeValue new_value);

  /// The script gives the attribute.
  bool gives(const std::string& name) const { return find(name) != nullptr; }
  /// Where the attribute's value stands; the node's own place if the script does not give it.
  const FileLocation& where_of(const std::string& name) const;

  std::string text(const std::string& name) const;  ///< text, choice; empty where there is no default
  double number(const std::string& name) const;
  float angle(const std::string& name) const;  ///< radians
  long integer(const std::string& name) const;
  bool flag(const std::string& name) const;
  glm::vec3 vec3(const std::string& name) const;  ///< vec3, colour
  /// path, points; those of a repeated attribute follow each other.
  std::vector<glm::vec3> points(const std::string& name) const;
  /// All values of a repeatable event, in the order written.
  std::vector<Event> events(const std::string& name) const;
  /// The canonical path; empty where the script does not give it.
  std::filesystem::path file(const std::string& name) const;

 private:
  const NodeAttribute* find(const std::string& name) const;
  template <class T>
  std::optional<T> value(const std::string& name) const;
};

/// The attribute's value as a script writes it.
std::string written(const NodeAttribute& attribute);

/// The node called `name` among `nodes` and those inside them, or null. "%TYPE" is the one node of a unique
/// type.
const Node* find_node(const std::vector<Node>& nodes, const std::string& name);

/// What the node and its children say, without names and places: equal texts build equal models.
std::string signature(const Node& node);

}  // namespace parvis::scene
