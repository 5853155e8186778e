// The binary chunk of a .glb while it is written: values one after another, and the accessors into them.
#pragma once

#include <cstring>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace parvis::scene {

class GltfChunk {
 public:
  using Json = nlohmann::json;

  /// The type of a value's components; glTF's numbers of component types.
  enum class Component : int { uint16 = 5123, uint32 = 5125, float32 = 5126 };
  /// The use of the values; glTF's numbers of targets, and none for keyframes and matrices.
  enum class Use : int { other = 0, vertices = 34962, indices = 34963 };

  /// Appends `values`, each of `type` ("VEC3"), and returns the accessor to them.
  template <class T>
  int add(const std::vector<T>& values, const char* type, Component component, Use use) {
    while (bytes_.size() % 4 != 0) bytes_.push_back(0);
    const std::size_t offset = bytes_.size(), length = values.size() * sizeof(T);
    bytes_.resize(offset + length);
    std::memcpy(bytes_.data() + offset, values.data(), length);
    Json view{{"buffer", 0}, {"byteOffset", offset}, {"byteLength", length}};
    if (use != Use::other) view["target"] = int(use);
    views_.push_back(view);
    accessors_.push_back({{"bufferView", views_.size() - 1},
                          {"componentType", int(component)},
                          {"count", values.size()},
                          {"type", type}});
    return int(accessors_.size()) - 1;
  }

  /// Positions of vertices, or what a morph target adds to them: with the bounds that glTF asks for.
  int add_positions(const std::vector<glm::vec3>& positions);
  int add_vectors(const std::vector<glm::vec3>& vectors) {
    return add(vectors, "VEC3", Component::float32, Use::vertices);
  }
  /// Ascending times of keyframes, in seconds.
  int add_times(const std::vector<float>& times_s);

  /// Values of keyframes, `components` floats each.
  int add_keys(const std::vector<float>& values, const char* type, int components);

  /// Appends bytes that no accessor reads, and returns their view.
  int add_bytes(std::string_view bytes);

  static Json array_of(glm::vec3 v) { return {v.x, v.y, v.z}; }

  /// Writes accessors, views and the buffer, where there are any, into the JSON of the file.
  void describe(Json& json) const;
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
  Json views_ = Json::array(), accessors_ = Json::array();
};

}  // namespace parvis::scene
