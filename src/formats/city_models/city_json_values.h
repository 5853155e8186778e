// Values of a CityJSON file, which may be missing or of any type, and the shells that its geometries consist
// of.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace parvis::scene {

using Json = nlohmann::json;

/// Stands for what is missing.
inline const Json& nothing() {
  static const Json null;
  return null;
}

/// A member of an object, or `nothing`.
inline const Json& member(const Json& object, const char* name) {
  const auto found = object.is_object() ? object.find(name) : object.end();
  return object.is_object() && found != object.end() ? *found : nothing();
}

/// An element of a list, or `nothing`.
inline const Json& element(const Json& list, std::size_t i) {
  return list.is_array() && i < list.size() ? list[i] : nothing();
}

/// Empty where the value is no text.
inline std::string text(const Json& value) { return value.is_string() ? value.get<std::string>() : ""; }

/// True for solids, and sets of them.
inline bool is_solid(const Json& geometry) { return text(member(geometry, "type")).ends_with("Solid"); }

/// The semantics of a geometry's surfaces: a number per surface in `value`, or up to version 0.3 the kind
/// itself.
inline std::string semantics_of(const Json& geometry, const Json& value) {
  if (value.is_object()) return text(member(value, "type"));
  if (!value.is_number_unsigned()) return "";
  const Json& surfaces = member(member(geometry, "semantics"), "surfaces");
  return text(member(element(surfaces, value.get<std::size_t>()), "type"));
}

/// Calls use(surfaces, attached) for each outer shell of a geometry: the list of its surfaces, and of what
/// the file attaches to each. Inner shells are cavities, which nobody sees. `attached` has at(i), as the
/// boundaries have lists.
template <class Attached, class Use>
void each_shell(const Json& geometry, const Attached& attached, const Use& use) {
  const std::string type = text(member(geometry, "type"));
  const Json& boundaries = member(geometry, "boundaries");
  if (type == "MultiSurface" || type == "CompositeSurface")
    use(boundaries, attached);
  else if (type == "Solid")
    use(element(boundaries, 0), attached.at(0));
  else if (type == "MultiSolid" || type == "CompositeSolid")
    for (std::size_t i = 0; i < boundaries.size(); ++i)
      use(element(element(boundaries, i), 0), attached.at(i).at(0));
}

}  // namespace parvis::scene
