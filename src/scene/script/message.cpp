#include "scene/script/message.h"

#include "base/known_names.h"

namespace parvis::scene {
namespace {

constexpr std::string_view spaces = " \t\r\n";

/// Takes the first `count` words off `rest`; fewer where there are no more.
std::string take_words(std::string_view& rest, std::size_t count) {
  const std::size_t first = std::min(rest.find_first_not_of(spaces), rest.size());
  std::size_t end = first;
  for (std::size_t word = 0; word < count && end < rest.size(); ++word) {
    end = std::min(rest.find_first_not_of(spaces, end), rest.size());
    end = std::min(rest.find_first_of(spaces, end), rest.size());
  }
  const std::string_view words = rest.substr(first, end - first);
  rest.remove_prefix(end);
  return std::string(words.substr(0, words.find_last_not_of(spaces) + 1));
}

std::size_t word_count(const AttributeSchema& argument) {
  return argument.type == AttributeType::vec3 ? 3 : 1;
}

Error unknown_message(const NodeSchema& schema, const std::string& name, const FileLocation& where) {
  if (schema.messages.empty()) return error_at(where, "{} takes no messages", schema.type);
  std::vector<std::string> known;
  known.reserve(schema.messages.size());
  for (const MessageSchema& message : schema.messages) known.push_back(message.name);
  return error_at(where, "{} takes no message \"{}\"{}", schema.type, name.substr(0, 40),
                  names_that_exist(name, known));
}

}  // namespace

Result<Message> parse_message(const NodeSchema& schema, const std::string& text, const FileLocation& where) {
  std::string_view rest = text;
  const std::string name = take_words(rest, 1);
  const MessageSchema* found = schema.find_message(name);
  if (!found) return unknown_message(schema, name, where);

  Message message{found, {}, text};
  for (const AttributeSchema& argument : found->arguments) {
    const bool is_last = &argument == &found->arguments.back();
    const std::string words = take_words(rest, is_last ? text.size() : word_count(argument));
    const bool sets_attribute = argument.name == found->name;  // its name says what the message is
    if (words.empty()) {
      if (!argument.is_required) break;
      return error_at(where, "message \"{}\" needs {}{}", found->name,
                      sets_attribute ? "" : argument.name + ": ", expectation(argument));
    }
    Result<AttributeValue> value = parse_value(argument, words, Roots(""), where);
    if (!value)
      return error_at(where, "{}{}", sets_attribute ? "" : fmt::format("message \"{}\": ", found->name),
                      value.errors().front().message);
    message.arguments.push_back(*std::move(value));
  }
  if (const std::string more = take_words(rest, text.size()); !more.empty())
    return error_at(where, "message \"{}\": \"{}\" is one word too many", found->name, more.substr(0, 40));
  return message;
}

}  // namespace parvis::scene
