// A node of a checked script: attribute values have their schema's types, references name existing nodes, and
// files lie in folders that the scene may read.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <list>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "scene/script/schema.h"

namespace parvis::scene {

/// An attribute as given by the script, or set at run time.
struct NodeAttribute {
  const AttributeSchema* schema = nullptr;
  AttributeValue value;
  std::string text;  ///< as the script writes it; empty: the value was set while the scene runs
  FileLocation where;
};

struct Node;
/// Nodes side by side, in the order of the script. Each stays at its address while others come, go or change
/// their order.
using Nodes = std::list<Node>;

/// A checked node. The getters take an attribute name of the node's schema and assert its type; if the script
/// does not give the attribute, they return its default.
struct Node {
  const NodeSchema* schema = nullptr;
  FileLocation where;
  std::vector<NodeAttribute> attributes;  ///< in the order written, repeats included
  Nodes children;                         ///< included files put their nodes in place
  std::vector<NodeAttribute> overrides;   ///< of the node that `schema->takes_attributes_of` names

  /// Sets an attribute to a value of its type.
  void set(const std::string& name, AttributeValue new_value);

  /// True if the script gives the attribute, or it was set.
  bool gives(const std::string& name) const { return find(name) != nullptr; }
  /// Location of the attribute's value; the node's own if the script does not give it.
  const FileLocation& where_of(const std::string& name) const;

  std::string text(const std::string& name) const;  ///< text, choice; empty where there is no default
  double number(const std::string& name) const;     ///< in the attribute's unit; 0 where there is no default
  float angle(const std::string& name) const;       ///< radians
  long integer(const std::string& name) const;      ///< 0 where there is no default
  bool flag(const std::string& name) const;         ///< false where there is no default
  glm::vec3 vec3(const std::string& name) const;    ///< vec3, colour
  /// path, points; those of a repeated attribute follow each other.
  std::vector<glm::vec3> points(const std::string& name) const;
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
const Node* find_node(const Nodes& nodes, const std::string& name);

/// The text of the node and its children, without names and places: equal texts build equal models.
std::string signature(const Node& node);

}  // namespace parvis::scene
