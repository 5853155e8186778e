// A glTF 2.0 file as bytes: its JSON and its buffers, with every accessor checked against them before it is
// read.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"

namespace parvis::scene {

/// Throws GltfProblem (caught at the reader's door) where the file is not what it claims to be.
class GltfFile {
 public:
  using Json = nlohmann::json;

  struct GltfProblem {
    std::string message;
  };

  /// Opens .gltf or .glb with its buffers; files beside it are read below its folder only.
  explicit GltfFile(const std::filesystem::path& file);

  const Json& json() const { return json_; }
  const std::filesystem::path& path() const { return path_; }

  /// The elements of a top-level list ("meshes"); empty where it is absent.
  const Json& list(const char* name) const;
  /// The index `name` of `object`, checked against the list it points into; -1 where it is absent.
  int index(const Json& object, const char* name, const char* list_name) const;

  /// How many elements an accessor claims to have: no more than a claim.
  std::size_t element_count(int accessor) const;
  /// An accessor's elements as floats, `components` each (normalised integers become 0..1 or -1..1).
  std::vector<float> floats(int accessor, int components) const;
  /// A scalar accessor's elements as unsigned integers.
  std::vector<std::uint32_t> integers(int accessor) const;

  std::span<const std::uint8_t> buffer_view(int view) const;
  /// The bytes of a "data:" URI, or of a file beside this one.
  std::vector<std::uint8_t> resource(const std::string& uri) const;

 private:
  struct Access;
  void read_container(const std::string& bytes);
  void read_buffers();
  Access access(int accessor, int components) const;
  template <class Store>
  void read_elements(int accessor, int components, const Store& store) const;

  std::filesystem::path path_;
  Json json_;
  std::vector<std::uint8_t> binary_chunk_;
  std::vector<std::vector<std::uint8_t>> buffers_;
};

}  // namespace parvis::scene
