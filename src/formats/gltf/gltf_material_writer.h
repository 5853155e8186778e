// Materials of models as glTF 2.0 (section 3.9), with KHR_texture_transform, _clearcoat and
// _emissive_strength, and their pictures as files. What glTF cannot say (mirror-like, translucent) goes into
// "extras".
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "base/partial_file.h"
#include "base/result.h"
#include "scene/data/model.h"

namespace parvis::scene {

class GltfMaterialWriter {
 public:
  using Json = nlohmann::json;

  /// Adds `materials`, the model's or a paint over its textures, and returns the index of the first. `model`
  /// must outlive this. Pictures that several models have are one.
  int add(const Model& model, const std::vector<Material>& materials);

  /// Writes materials, textures, pictures' names and used extensions into the JSON of the file.
  void describe(Json& json, const std::filesystem::path& file) const;
  /// Writes the pictures beside `file`, NAME_TEXTURE.jpg for colour without alpha, else .png: each whole, but
  /// not yet under its name. Error: a file of such a name is there and belongs to another model, or to
  /// nobody.
  Result<std::vector<PartialFile>> write_pictures(const std::filesystem::path& file) const;

  /// The pictures for browsers, in the order of the file's images, each side at most `max_px`: colours as
  /// WebP, data as PNG, whose channels do not run into each other. Empty ones of those that are no larger
  /// than `min_px`.
  Result<std::vector<std::string>> browser_pictures(int max_px, int min_px = 0) const;

 private:
  int add(const Texture& texture);
  Json texture_info(int texture, const TextureMapping& mapping);
  Json material_json(const Material& material, const std::vector<int>& written_textures);
  void use(const char* extension);

  std::vector<const Texture*> textures_;
  std::unordered_multimap<std::uint64_t, int> textures_by_hash_;
  std::vector<std::string> names_;  ///< of each texture's picture, without the file's own
  std::unordered_set<std::string> taken_names_;
  std::unordered_map<std::string, int> last_number_;  ///< that a name got because others have it, too
  Json materials_ = Json::array(), extensions_ = Json::array();
};

}  // namespace parvis::scene
