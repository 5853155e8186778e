// The syntax tree of a scene script: what was written, and where, before anything is known about node types.
#pragma once

#include <string>
#include <vector>

namespace parvis::scene {

/// Counted from 1; columns count bytes.
struct TextPlace {
  int line = 1;
  int column = 1;
};

struct ScriptAttribute {
  std::string name;
  std::string value;  ///< without quotes, escapes resolved
  TextPlace name_place;
  TextPlace value_place;
};

/// `type(name=value, ...) { children }`; attributes in the order written, repeats included.
struct ScriptNode {
  std::string type;
  TextPlace place;
  std::vector<ScriptAttribute> attributes;
  std::vector<ScriptNode> children;
};

}  // namespace parvis::scene
