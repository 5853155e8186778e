// Schemas of node types: attributes with types, units, limits and defaults, and messages. The reader's
// errors, `parvis check` and docs/scene-reference.md are generated from them.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/files.h"
#include "base/result.h"

namespace parvis::scene {

/// Type of an attribute's value; AttributeValue lists the C++ types.
enum class AttributeType : unsigned char {
  text,
  number,
  integer,
  flag,       ///< 1/0, true/false, yes/no, on/off
  angle,      ///< written in degrees (the name ends in _deg), given in radians
  vec3,       ///< "x y z"
  colour,     ///< "#RRGGBB" (sRGB), or three linear numbers; given linear
  choice,     ///< one of `choices`
  path,       ///< "x y z, x y z, ..." or "x y, x y, ..." (z = 0): at least two points
  points,     ///< the same, at least one point
  file,       ///< a file below the scene's folder or a --data folder, see find_named_file; its canonical path
  reference,  ///< the name of another node, or %TYPE for the one node of a unique type
  child,      ///< the name of a node inside this one that can be hidden
  event  ///< "SOURCE, TARGET, MESSAGE, DELAY": when, to which node, what, after how many seconds (0 if left
         ///< out)
};

/// Limit of one path or points attribute.
inline constexpr std::size_t max_points = 100'000;

/// One attribute of a node type.
struct AttributeSchema {
  std::string name = {};
  AttributeType type = AttributeType::text;
  std::string help = {};      ///< one line
  std::string fallback = {};  ///< as a script would write it; empty: the value is absent unless given
  std::string unit = {};      ///< "m", "pixels", ...; empty where there is none
  double minimum = -1e9;
  double maximum = 1e9;
  std::vector<std::string> choices = {};  ///< of a choice, or of an event's sources
  /// An event's source: number (seconds), integer, choice, or reference to an object; or one of `choices`.
  AttributeType source = AttributeType::choice;
  std::vector<std::string> refers_to = {};  ///< types of the nodes that a reference may name; empty: any name
  std::vector<std::string> spellings = {};  ///< other names that are understood
  bool is_live = false;  ///< may change while the scene runs: a message of its name sets it
  bool is_kept = false;  ///< as it was when the scene was loaded: scenarios cannot change it
  std::vector<std::string> in_place_of = {};  ///< attributes that a message to this one clears
  bool is_required = false;
  bool is_repeatable = false;

  // What scene/script/attribute.h chains to the type, name and help of an attribute; each returns the changed
  // schema.

  /// `unit`.
  AttributeSchema in(std::string of_value) && { return unit = std::move(of_value), std::move(*this); }
  /// `fallback`.
  AttributeSchema by_default(std::string value) && { return fallback = std::move(value), std::move(*this); }
  /// `minimum` and `maximum`.
  AttributeSchema between(double min, double max) && {
    return minimum = min, maximum = max, std::move(*this);
  }
  /// `minimum`.
  AttributeSchema from(double min) && { return minimum = min, std::move(*this); }
  /// Words that stand beside the values of the type: `choices`.
  AttributeSchema or_one_of(std::vector<std::string> words) && {
    return choices = std::move(words), std::move(*this);
  }
  /// `spellings`.
  AttributeSchema spelled(std::vector<std::string> also) && {
    return spellings = std::move(also), std::move(*this);
  }
  /// `in_place_of`.
  AttributeSchema replacing(std::vector<std::string> others) && {
    return in_place_of = std::move(others), std::move(*this);
  }
  /// `is_live`.
  AttributeSchema live() && { return is_live = true, std::move(*this); }
  /// `is_kept`.
  AttributeSchema kept() && { return is_kept = true, std::move(*this); }
  /// `is_required`.
  AttributeSchema required() && { return is_required = true, std::move(*this); }
  /// `is_repeatable`.
  AttributeSchema repeatable() && { return is_repeatable = true, std::move(*this); }
};

/// A message that a node accepts while the scene runs: "name argument argument". The last argument takes all
/// remaining words.
struct MessageSchema {
  std::string name = {};
  std::string help = {};                        ///< one line
  std::vector<AttributeSchema> arguments = {};  ///< only the last may be left out
};

/// Stands for the parent of top-level nodes.
inline const std::string top_level = "scene";

struct Node;

/// One node type, as the reader, the checker and the reference know it.
struct NodeSchema {
  std::string type = {};
  std::string help = {};  ///< one line or two
  std::vector<AttributeSchema> attributes = {};
  std::vector<std::string> stands_in{top_level, "group"};  ///< types of the nodes that may hold it
  std::string example = {};                                ///< a script that uses it
  std::vector<MessageSchema> messages = {};                ///< beside those that its live attributes give it
  bool is_unique = false;                                  ///< stands at most once in a scene
  /// Unique, and in every scene: one that is not written has all its defaults. Messages and scenarios may
  /// name it.
  bool is_implied = false;
  bool is_laid_out_once = false;  ///< when the scene is loaded: later it can only be shown or hidden
  /// Name of the attribute that names a node whose attributes this one takes, too; empty: takes none.
  std::string takes_attributes_of = {};
  /// Names of the things that the node makes when the scene runs: others may refer to them.
  std::vector<std::string> (*names_made)(const Node& node) = nullptr;

  /// The attribute of this name or alternative spelling; null if there is none.
  const AttributeSchema* find(const std::string& name) const;
  const MessageSchema* find_message(const std::string& name) const;  ///< without regard to case
  /// True if the node's objects may be replaced while the scene runs.
  bool can_be_built_again() const { return !is_laid_out_once || find("visible") != nullptr; }
  /// Adds the messages that are common to all node types: one for each live attribute; show, hide and toggle
  /// where there is `visible`.
  void complete_messages();
};

/// Value of an event attribute: what happens to which node, and when.
struct Event {
  std::string source, target, message;
  double delay_s = 0.0;
};

/// number and angle: double; integer: long; flag: bool; vec3, colour: vec3; path, points: vector of vec3;
/// file: path; event: Event; text, choice, reference, child: string.
using AttributeValue = std::variant<std::string, double, long, bool, glm::vec3, std::vector<glm::vec3>,
                                    std::filesystem::path, Event>;

/// Parses a value. Errors at `where` say what the attribute expects; files are relative to the script
/// `where.file`, see find_named_file.
Result<AttributeValue> parse_value(const AttributeSchema& schema, const std::string& text, const Roots& roots,
                                   const FileLocation& where);

/// Fails, and says what the attribute expects, where the value is out of its limits or not among its choices.
Status check_value(const AttributeSchema& schema, const AttributeValue& value);

/// The value as a script would spell it: `parse_value` reads it back with seven significant digits.
std::string written_value(const AttributeSchema& schema, const AttributeValue& value);

/// The value that the attribute expects, in words: `a number in m from 0 to 10`.
std::string expectation(const AttributeSchema& schema);

/// How an event is written: "SECONDS, TARGET, MESSAGE, DELAY".
std::string event_pattern(const AttributeSchema& schema);

/// Numbers separated by white space or commas; empty if there is anything else or a number is not finite.
std::vector<double> parse_numbers(std::string_view text);

}  // namespace parvis::scene
