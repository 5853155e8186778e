#include "formats/gltf/gltf_chunk.h"

#include "base/bounds.h"

namespace parvis::scene {

int GltfChunk::add_positions(const std::vector<glm::vec3>& positions) {
  const int accessor = add_vectors(positions);
  Bounds bounds;
  for (const glm::vec3& p : positions) bounds.add(p);
  accessors_.back()["min"] = array_of(bounds.min);
  accessors_.back()["max"] = array_of(bounds.max);
  return accessor;
}

int GltfChunk::add_times(const std::vector<float>& times_s) {
  const int accessor = add(times_s, "SCALAR", Component::float32, Use::other);
  accessors_.back()["min"] = {times_s.front()};
  accessors_.back()["max"] = {times_s.back()};
  return accessor;
}

int GltfChunk::add_keys(const std::vector<float>& values, const char* type, int components) {
  const int accessor = add(values, type, Component::float32, Use::other);
  accessors_.back()["count"] = values.size() / std::size_t(components);
  return accessor;
}

int GltfChunk::add_bytes(std::string_view bytes) {
  while (bytes_.size() % 4 != 0) bytes_.push_back(0);
  views_.push_back({{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", bytes.size()}});
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  return int(views_.size()) - 1;
}

void GltfChunk::describe(Json& json) const {
  if (bytes_.empty()) return;
  if (!accessors_.empty()) json["accessors"] = accessors_;
  json["bufferViews"] = views_;
  json["buffers"] = {{{"byteLength", (bytes_.size() + 3) / 4 * 4}}};
}

}  // namespace parvis::scene
