// The syntax tree of a scene script: text and locations, before node types are looked up.
#pragma once

#include <string>
#include <vector>

namespace parvis::scene {

/// Counted from 1; columns count bytes.
struct TextPlace {
  int line = 1;
  int column = 1;
};

/// An attribute as written: `name=value`.
struct ScriptAttribute {
  std::string name;
  std::string value;  ///< without quotes, escapes resolved
  TextPlace name_place;
  TextPlace value_place;
  bool is_quoted = false;
  std::vector<std::size_t> joints;           ///< offsets in the value where adjacent strings were joined
  std::vector<std::string> comments_before;  ///< each from its "//" or "#" to the end of its line
  std::vector<std::string> comments_behind;  ///< on the attribute's own line
};

/// `type(name=value, ...) { children }`; attributes in the order written, repeats included.
struct ScriptNode {
  std::string type;
  TextPlace place;
  std::vector<ScriptAttribute> attributes;
  std::vector<ScriptNode> children;
  std::vector<std::string> comments_before;      ///< an empty one is a blank line
  std::vector<std::string> comments_behind;      ///< on the line of the ")" or "{"
  std::vector<std::string> comments_in_list;     ///< after the last attribute
  std::vector<std::string> comments_at_end;      ///< before the "}"; an empty one is a blank line
  std::vector<std::string> comments_behind_end;  ///< on the line of the "}"
};

}  // namespace parvis::scene
