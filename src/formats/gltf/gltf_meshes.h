// Meshes of glTF 2.0 (section 3.7.2): the triangles of their primitives.
#pragma once

#include <string>
#include <vector>

#include "base/mesh.h"
#include "formats/gltf/gltf_file.h"
#include "formats/gltf/gltf_materials.h"

namespace parvis::scene {

/// The elements of an attribute ("POSITION") as vectors; none where it is absent. Throws GltfProblem.
template <int N>
std::vector<glm::vec<N, float>> gltf_attribute(const GltfFile& file, const GltfFile::Json& attributes,
                                               const char* name) {
  const int accessor = file.index(attributes, name, "accessors");
  if (accessor < 0) return {};
  const std::vector<float> values = file.floats(accessor, N);
  std::vector<glm::vec<N, float>> result(values.size() / N);
  for (std::size_t i = 0; i < values.size(); ++i) result[i / N][int(i % N)] = values[i];
  return result;
}

/// A primitive's triangles; none where it holds points or lines, which have no surface. Throws GltfProblem,
/// which names the mesh.
Mesh read_primitive(const GltfFile& file, const GltfFile::Json& primitive, const std::string& mesh_name,
                    UvSets sets);

/// Counts the primitives of a mesh and their attributes: what is used, and what nothing takes. `sets`: of
/// each material, and of no material last.
void count_primitives(const GltfFile& file, const GltfFile::Json& mesh, const std::vector<UvSets>& sets,
                      FileAccount& account);

}  // namespace parvis::scene
