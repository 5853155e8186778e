#include "scene/script/schema.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/colour.h"
#include "base/known_names.h"
#include "scene/script/named_file.h"
#include "scene/script/performer_file.h"

namespace parvis::scene {
namespace {

constexpr std::string_view separators = " \t\r\n,";
constexpr double longest_delay_s = 86'400.0;

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(separators);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(separators) - first + 1);
}

bool is_within(const AttributeSchema& schema, double value) {
  return value >= schema.minimum && value <= schema.maximum;
}

Error mismatch(const AttributeSchema& schema, const std::string& text, const FileLocation& where) {
  constexpr std::size_t longest_quote = 60;
  const std::string shown = text.size() > longest_quote ? text.substr(0, longest_quote) + "..." : text;
  return error_at(where, "{}=\"{}\": expected {}", schema.name, shown, expectation(schema));
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> pieces;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(separator, start), text.size());
    pieces.push_back(text.substr(start, end - start));
    start = end + 1;
  }
  return pieces;
}

/// Points parted by commas or semicolons, of two or three numbers each; empty where the text is none.
std::vector<glm::vec3> parse_points(const AttributeSchema& schema, std::string text) {
  std::replace(text.begin(), text.end(), ';', ',');
  std::vector<glm::vec3> points;
  for (const std::string_view piece : split(trimmed(text), ',')) {
    const std::vector<double> numbers = parse_numbers(piece);
    if (points.size() == max_points) return {};
    const bool is_point = numbers.size() == 2 || numbers.size() == 3;
    if (!is_point ||
        !std::all_of(numbers.begin(), numbers.end(), [&](double x) { return is_within(schema, x); }))
      return {};
    points.emplace_back(numbers[0], numbers[1], numbers.size() == 3 ? numbers[2] : 0.0);
  }
  return points;
}

Result<AttributeValue> parse_flag(const AttributeSchema& schema, const std::string& text,
                                  const FileLocation& where) {
  for (const char* yes : {"1", "true", "yes", "on"})
    if (text == yes) return AttributeValue(true);
  for (const char* no : {"0", "false", "no", "off"})
    if (text == no) return AttributeValue(false);
  return mismatch(schema, text, where);
}

Result<AttributeValue> parse_number(const AttributeSchema& schema, const std::string& text,
                                    const FileLocation& where) {
  const std::vector<double> numbers = parse_numbers(text);
  if (numbers.size() != 1 || !is_within(schema, numbers[0])) return mismatch(schema, text, where);
  if (schema.type == AttributeType::angle) return AttributeValue(glm::radians(numbers[0]));
  if (schema.type == AttributeType::number) return AttributeValue(numbers[0]);
  if (numbers[0] != std::round(numbers[0])) return mismatch(schema, text, where);
  return AttributeValue(std::lround(numbers[0]));
}

Result<AttributeValue> parse_three(const AttributeSchema& schema, const std::string& text,
                                   const FileLocation& where) {
  if (schema.type == AttributeType::colour && text.starts_with('#')) {
    unsigned rgb = 0;
    const char* end = text.data() + text.size();
    const auto [stop, code] = std::from_chars(text.data() + 1, end, rgb, 16);
    if (text.size() != 7 || stop != end || code != std::errc()) return mismatch(schema, text, where);
    return AttributeValue(linear_from_srgb8(int(rgb >> 16), int(rgb >> 8 & 255), int(rgb & 255)));
  }
  const std::vector<double> n = parse_numbers(text);
  if (n.size() != 3 || !std::all_of(n.begin(), n.end(), [&](double x) { return is_within(schema, x); }))
    return mismatch(schema, text, where);
  return AttributeValue(glm::vec3(n[0], n[1], n[2]));
}

Result<AttributeValue> parse_choice(const AttributeSchema& schema, const std::string& text,
                                    const FileLocation& where) {
  if (std::find(schema.choices.begin(), schema.choices.end(), text) != schema.choices.end())
    return AttributeValue(text);
  Error error = mismatch(schema, text, where);
  error.message += did_you_mean(text, schema.choices);
  return error;
}

}  // namespace

const AttributeSchema* NodeSchema::find(const std::string& name) const {
  const auto found = std::find_if(attributes.begin(), attributes.end(), [&](const AttributeSchema& a) {
    return a.name == name || std::find(a.spellings.begin(), a.spellings.end(), name) != a.spellings.end();
  });
  return found == attributes.end() ? nullptr : &*found;
}

const MessageSchema* NodeSchema::find_message(const std::string& name) const {
  const auto found = std::find_if(messages.begin(), messages.end(),
                                  [&](const MessageSchema& m) { return edit_distance(m.name, name) == 0; });
  if (found != messages.end()) return &*found;
  // Messages that set an attribute go by its other spellings, too.
  const AttributeSchema* attribute = find(name);
  return attribute && attribute->name != name ? find_message(attribute->name) : nullptr;
}

void NodeSchema::complete_messages() {
  const auto add = [this](MessageSchema message) {
    if (!find_message(message.name)) messages.push_back(std::move(message));
  };
  if (find("visible")) {
    add({"show", "makes it visible", {}});
    add({"hide", "makes it invisible", {}});
    add({"toggle", "shows it if it is hidden, hides it if it is shown", {}});
  }
  for (const AttributeSchema& attribute : attributes) {
    if (!attribute.is_live) continue;
    AttributeSchema argument = attribute;
    argument.is_required = true;
    add({attribute.name, "sets the attribute", {std::move(argument)}});
  }
}

std::vector<double> parse_numbers(std::string_view text) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  const auto is_separator = [](char c) { return separators.find(c) != std::string_view::npos; };
  while (true) {
    while (at != end && is_separator(*at)) ++at;
    if (at == end) return numbers;
    if (*at == '+' && at + 1 != end && at[1] != '-') ++at;
    double number = 0.0;
    const auto [stop, code] = std::from_chars(at, end, number);
    if (code != std::errc() || !std::isfinite(number) || (stop != end && !is_separator(*stop))) return {};
    numbers.push_back(number);
    at = stop;
  }
}

std::string event_pattern(const AttributeSchema& schema) {
  const bool is_time = schema.source == AttributeType::number,
             is_index = schema.source == AttributeType::integer;
  return fmt::format("{}, TARGET, MESSAGE, DELAY", is_time ? "SECONDS" : is_index ? "NUMBER" : "SOURCE");
}

namespace {

/// The whole list if it is short, else its first and last names.
std::string some_of(const std::vector<std::string>& choices) {
  constexpr std::size_t few = 12;
  if (choices.size() <= few) return fmt::format("{}", fmt::join(choices, ", "));
  return fmt::format("{}, {}, {}, ..., {}", choices[0], choices[1], choices[2], choices.back());
}

std::string source_help(const AttributeSchema& schema) {
  switch (schema.source) {
    case AttributeType::number:
      return "when, in seconds";
    case AttributeType::integer:
      return "which, counted from 1";
    case AttributeType::reference:
      return schema.choices.empty()
                 ? "the name of a node"
                 : fmt::format("{} or the name of a node", fmt::join(schema.choices, ", "));
    default:
      return "one of " + some_of(schema.choices);
  }
}

Result<AttributeValue> parse_event(const AttributeSchema& schema, const std::string& text,
                                   const FileLocation& where) {
  const std::vector<std::string_view> fields = split(text, ',');
  if (fields.size() != 3 && fields.size() != 4) return mismatch(schema, text, where);
  Event event{std::string(trimmed(fields[0])), std::string(trimmed(fields[1])),
              std::string(trimmed(fields[2]))};
  if (event.source.empty() || event.target.empty() || event.message.empty())
    return mismatch(schema, text, where);
  if (fields.size() == 4) {
    const std::vector<double> delay = parse_numbers(fields[3]);
    if (delay.size() != 1 || delay[0] < 0.0 || delay[0] > longest_delay_s)
      return error_at(where, "{}: the delay \"{}\" is no number of seconds from 0 to {}", schema.name,
                      trimmed(fields[3]), longest_delay_s);
    event.delay_s = delay[0];
  }
  AttributeSchema source{
      .name = schema.name + ", its source", .type = schema.source, .choices = schema.choices};
  if (source.type == AttributeType::number) source.minimum = 0, source.unit = "seconds";
  if (source.type == AttributeType::integer) source.minimum = 1;
  const Result<AttributeValue> checked = parse_value(source, event.source, Roots(""), where);
  if (!checked) return checked.errors();
  return AttributeValue(std::move(event));
}

}  // namespace

std::string expectation(const AttributeSchema& schema) {
  const auto limits = [&] {
    const AttributeSchema unlimited;
    std::string text = schema.unit.empty() ? "" : " in " + schema.unit;
    if (schema.minimum != unlimited.minimum && schema.maximum != unlimited.maximum)
      return text + fmt::format(" from {} to {}", schema.minimum, schema.maximum);
    if (schema.minimum != unlimited.minimum) return text + fmt::format(", at least {}", schema.minimum);
    if (schema.maximum != unlimited.maximum) return text + fmt::format(", at most {}", schema.maximum);
    return text;
  };
  switch (schema.type) {
    case AttributeType::text:
      return "a text";
    case AttributeType::number:
      return "a number" + limits();
    case AttributeType::integer:
      return "a whole number" + limits();
    case AttributeType::flag:
      return "1 or 0 (also true/false, yes/no, on/off)";
    case AttributeType::angle:
      return "an angle" + limits();
    case AttributeType::vec3:
      return "three numbers \"x y z\"" + limits();
    case AttributeType::colour:
      return "a colour: \"#RRGGBB\" (sRGB), or three linear numbers \"r g b\"" + limits();
    case AttributeType::choice:
      return "one of " + some_of(schema.choices);
    case AttributeType::path:
      return "two or more points \"x y z, x y z, ...\" (z may be left out), at most 100000" + limits();
    case AttributeType::points:
      return "points \"x y z, x y z, ...\" (z may be left out), at most 100000" + limits();
    case AttributeType::file:
      return "the name of a file";
    case AttributeType::reference:
      return schema.refers_to.empty()
                 ? "the name of a node"
                 : fmt::format("the name of a {}", fmt::join(schema.refers_to, " or a "));
    case AttributeType::child:
      return "the name of a node inside it";
    case AttributeType::event:
      return fmt::format(
          "\"{}\": {}, the node that receives a message, the message, and after how "
          "many seconds (0 if left out)",
          event_pattern(schema), source_help(schema));
  }
  return "";
}

Result<AttributeValue> parse_value(const AttributeSchema& schema, const std::string& text, const Roots& roots,
                                   const FileLocation& where) {
  switch (schema.type) {
    case AttributeType::number:
    case AttributeType::integer:
    case AttributeType::angle:
      return parse_number(schema, text, where);
    case AttributeType::flag:
      return parse_flag(schema, text, where);
    case AttributeType::vec3:
    case AttributeType::colour:
      return parse_three(schema, text, where);
    case AttributeType::choice:
      return parse_choice(schema, text, where);
    case AttributeType::path:
    case AttributeType::points: {
      std::vector<glm::vec3> points = parse_points(schema, text);
      if (points.size() < (schema.type == AttributeType::path ? 2 : 1)) return mismatch(schema, text, where);
      return AttributeValue(std::move(points));
    }
    case AttributeType::file: {
      Result<std::filesystem::path> file = is_performer_file(text)
                                               ? in_place_of_performer_file(text, roots, where)
                                               : find_named_file(text, roots, where);
      if (!file) return file.errors();
      if (!std::filesystem::is_regular_file(*file))
        return error_at(where, "{}=\"{}\" is a folder; expected a file", schema.name, text);
      return AttributeValue(std::move(*file));
    }
    case AttributeType::event:
      return parse_event(schema, text, where);
    case AttributeType::text:
    case AttributeType::reference:
    case AttributeType::child:
      break;
  }
  return AttributeValue(text);
}

namespace {

std::string written_number(double number) { return fmt::format("{:.7g}", number); }

std::string written_vec3(const glm::vec3& v) { return fmt::format("{:.7g} {:.7g} {:.7g}", v.x, v.y, v.z); }

/// Writes the alternative of an attribute's value as the schema's type is written.
struct Writer {
  const AttributeSchema& schema;

  std::string operator()(const std::string& text) const { return text; }
  std::string operator()(double number) const {
    return written_number(schema.type == AttributeType::angle ? glm::degrees(number) : number);
  }
  std::string operator()(long number) const { return fmt::format("{}", number); }
  std::string operator()(bool flag) const { return flag ? "1" : "0"; }
  std::string operator()(const glm::vec3& v) const { return written_vec3(v); }
  std::string operator()(const std::vector<glm::vec3>& points) const {
    std::string text;
    for (const glm::vec3& point : points) text += (text.empty() ? "" : ", ") + written_vec3(point);
    return text;
  }
  std::string operator()(const std::filesystem::path& file) const { return file.string(); }
  std::string operator()(const Event& event) const {
    return fmt::format("{}, {}, {}, {}", event.source, event.target, event.message,
                       written_number(event.delay_s));
  }
};

}  // namespace

std::string written_value(const AttributeSchema& schema, const AttributeValue& value) {
  return std::visit(Writer{schema}, value);
}

Status check_value(const AttributeSchema& schema, const AttributeValue& value) {
  bool is_right = true;
  const auto check_number = [&](double number) { is_right = is_right && is_within(schema, number); };
  const auto check_point = [&](const glm::vec3& point) {
    for (int axis = 0; axis < 3; ++axis) check_number(double(point[axis]));
  };
  if (const auto* number = std::get_if<double>(&value))
    check_number(schema.type == AttributeType::angle ? glm::degrees(*number) : *number);
  else if (const auto* whole = std::get_if<long>(&value))
    check_number(double(*whole));
  else if (const auto* point = std::get_if<glm::vec3>(&value))
    check_point(*point);
  else if (const auto* points = std::get_if<std::vector<glm::vec3>>(&value))
    std::ranges::for_each(*points, check_point);
  else if (const auto* text = std::get_if<std::string>(&value); text && schema.type == AttributeType::choice)
    is_right = std::ranges::find(schema.choices, *text) != schema.choices.end();
  if (!is_right) return mismatch(schema, written_value(schema, value), {});
  return Ok{};
}

}  // namespace parvis::scene
