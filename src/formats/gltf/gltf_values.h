// Typed values from the JSON of a glTF file with their defaults; vectors of the wrong length are refused.
#pragma once

#include <glm/glm.hpp>

#include "base/memory_budget.h"
#include "formats/gltf/gltf_file.h"

namespace parvis::scene {

/// Throws GltfProblem with the message.
template <class... Args>
[[noreturn]] void gltf_fail(fmt::format_string<Args...> format, Args&&... args) {
  throw GltfFile::GltfProblem{fmt::format(format, std::forward<Args>(args)...)};
}

/// Checks the budget before `bytes` are allocated; none stands for more than 64 bits can say. Throws
/// GltfProblem where the budget has not so much left; the message begins with what they are for.
template <class... Args>
void gltf_charge(std::optional<std::uint64_t> bytes, fmt::format_string<Args...> format, Args&&... args) {
  if (const Status status = check_memory(bytes, fmt::format(format, std::forward<Args>(args)...)); !status)
    throw GltfFile::GltfProblem{status.errors().front().message};
}

/// The number `name` of an object; `otherwise` where it is absent or no number.
inline float gltf_number(const GltfFile::Json& object, const char* name, float otherwise) {
  const auto found = object.find(name);
  return found != object.end() && found->is_number() ? found->get<float>() : otherwise;
}

/// The vector of N numbers `name` of an object; `otherwise` where it is absent. Throws GltfProblem where it
/// is no array of N.
template <int N, class T>
glm::vec<N, T> gltf_vector(const GltfFile::Json& object, const char* name, glm::vec<N, T> otherwise) {
  const auto found = object.find(name);
  if (found == object.end()) return otherwise;
  if (!found->is_array() || found->size() != std::size_t(N))
    gltf_fail("\"{}\" is {}; expected {} numbers", name, found->dump(), N);
  for (int i = 0; i < N; ++i) otherwise[i] = (*found)[std::size_t(i)].get<T>();
  return otherwise;
}

/// The morph targets of a primitive; an empty list if it has none.
inline const GltfFile::Json& gltf_targets(const GltfFile::Json& primitive) {
  static const GltfFile::Json nothing = GltfFile::Json::array();
  const auto found = primitive.find("targets");
  return found != primitive.end() && found->is_array() ? *found : nothing;
}

/// The object `name` inside `object`; an empty one if it is absent.
inline const GltfFile::Json& gltf_member(const GltfFile::Json& object, const char* name) {
  static const GltfFile::Json nothing = GltfFile::Json::object();
  const auto found = object.find(name);
  return found != object.end() && found->is_object() ? *found : nothing;
}

/// The extension `name` of an object; an empty one if it is absent.
inline const GltfFile::Json& gltf_extension(const GltfFile::Json& object, const char* name) {
  return gltf_member(gltf_member(object, "extensions"), name);
}

}  // namespace parvis::scene
