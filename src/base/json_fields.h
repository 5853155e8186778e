// Values of JSON objects that users write, asked for by name: what is wrong or unknown becomes an error in
// words.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/json_guard.h"
#include "base/known_names.h"

namespace parvis {

/// JSON whose objects keep their order.
using OrderedJson = nlohmann::ordered_json;

/// The object of a file that says, by its value `marker`, of which version of which format it is. Errors: no
/// JSON, none of that format, another version.
inline Result<OrderedJson> read_versioned_json(const std::string& text, const std::string& file,
                                               const char* marker, int version) {
  if (Status status = check_json_depth(text, file); !status) return status.errors();
  OrderedJson whole;
  try {
    whole = OrderedJson::parse(text);
  } catch (const OrderedJson::exception& exception) {
    return error("{}: {}", file, json_reason(exception.what()));
  }
  if (!whole.is_object() || !whole.contains(marker))
    return error("{}: expected an object with \"{}\": {}", file, marker, version);
  if (whole[marker] != version)
    return error("{}: \"{}\" is of version {}; this program reads version {}", file, marker,
                 whole[marker].dump(), version);
  return whole;
}

/// One object of such a file. It adds what is wrong to a list of errors, which outlives it.
class JsonFields {
 public:
  JsonFields(const OrderedJson& object, std::string where, Errors& errors)
      : object_(object), where_(std::move(where)), errors_(errors) {
    if (!object.is_object()) wrong("", "expected an object {...}");
  }
  /// The end, when all values have been asked for: others are errors.
  void finish() {
    if (!object_.is_object()) return;
    for (const auto& [key, value] : object_.items())
      if (std::ranges::find(known_, key) == known_.end())
        wrong("", fmt::format("\"{}\" is no name of a value here{}", key, did_you_mean(key, known_)));
  }
  /// Adds an error about a value; an empty key: about the object.
  void wrong(const std::string& key, const std::string& what) {
    errors_.push_back(error("{}{}{}: {}", where_, key.empty() ? "" : ".", key, what));
  }
  /// The value of that name; null: there is none.
  const OrderedJson* find(const char* key) {
    known_.emplace_back(key);
    return object_.is_object() && object_.contains(key) ? &object_[key] : nullptr;
  }
  /// A text.
  std::string text(const char* key, std::string otherwise = "") {
    const OrderedJson* value = find(key);
    if (!value) return otherwise;
    if (value->is_string()) return value->get<std::string>();
    wrong(key, "expected a text in quotes");
    return otherwise;
  }
  /// True or false.
  bool flag(const char* key, bool otherwise) {
    const OrderedJson* value = find(key);
    if (!value) return otherwise;
    if (value->is_boolean()) return value->get<bool>();
    wrong(key, "expected true or false");
    return otherwise;
  }
  /// A number within two limits.
  double number(const char* key, double otherwise, double least, double most) {
    const OrderedJson* value = find(key);
    if (!value) return otherwise;
    if (value->is_number() && value->get<double>() >= least && value->get<double>() <= most)
      return value->get<double>();
    wrong(key, fmt::format("expected a number from {} to {}", least, most));
    return otherwise;
  }
  /// A list of `count` numbers, whose magnitude is `most` at most; nothing where there is none, or where it
  /// is wrong.
  std::optional<std::vector<double>> numbers(const char* key, std::size_t count, double most) {
    const OrderedJson* value = find(key);
    return value ? numbers_of(key, *value, count, most) : std::nullopt;
  }
  /// A list of such lists, `max_rows` at most.
  std::vector<std::vector<double>> rows(const char* key, std::size_t count, double most,
                                        std::size_t max_rows) {
    std::vector<std::vector<double>> result;
    const OrderedJson* value = find(key);
    if (!value) return result;
    if (!value->is_array() || value->size() > max_rows) {
      wrong(key, fmt::format("expected a list of {} rows at most", max_rows));
      return result;
    }
    for (const OrderedJson& each : *value) {
      const auto numbers = numbers_of(key, each, count, most);
      if (!numbers) return {};
      result.push_back(*numbers);
    }
    return result;
  }

 private:
  std::optional<std::vector<double>> numbers_of(const char* key, const OrderedJson& value, std::size_t count,
                                                double most) {
    std::vector<double> result;
    if (value.is_array() && value.size() == count)
      for (const OrderedJson& each : value)
        if (each.is_number() && std::abs(each.get<double>()) <= most) result.push_back(each.get<double>());
    if (result.size() == count) return result;
    wrong(key, fmt::format("expected {} numbers [..], each {} at most", count, most));
    return std::nullopt;
  }

  const OrderedJson& object_;
  std::string where_;
  Errors& errors_;
  std::vector<std::string> known_;
};

}  // namespace parvis
