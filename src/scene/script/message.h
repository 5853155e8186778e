// A message to a node while the scene runs: "show oaks", "position 1 2 0".
#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "scene/script/schema.h"

namespace parvis::scene {

struct Message {
  const MessageSchema* schema = nullptr;
  std::vector<AttributeValue> arguments;  ///< as many as are given
  std::string text;                       ///< as written
};

/// Reads `text` as a message to a node of the type `schema`. Errors at `where` name the messages that it
/// takes. Whether the nodes that arguments name exist is not looked at.
Result<Message> parse_message(const NodeSchema& schema, const std::string& text, const FileLocation& where);

}  // namespace parvis::scene
