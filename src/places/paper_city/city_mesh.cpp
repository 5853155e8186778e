#include "places/paper_city/city_mesh.h"

namespace parvis::city {

void CityMesh::face(CityMaterial material, std::initializer_list<Corner> corners) {
  Mesh& mesh = meshes_[{group_, material}];
  const auto first = std::uint32_t(mesh.positions.size());
  const Corner* c = corners.begin();
  const glm::vec3 normal =
      glm::normalize(glm::cross(c[1].position - c[0].position, c[2].position - c[0].position));
  for (const Corner& corner : corners) {
    mesh.positions.push_back(corner.position), mesh.normals.push_back(normal), mesh.uvs.push_back(corner.uv);
  }
  for (std::uint32_t i = 2; i < corners.size(); ++i) {
    mesh.indices.insert(mesh.indices.end(), {first, first + i - 1, first + i});
    ++triangles_;
  }
}

void CityMesh::triangle(CityMaterial material, const Corner& a, const Corner& b, const Corner& c) {
  face(material, {a, b, c});
}

void CityMesh::quad(CityMaterial material, const Corner& a, const Corner& b, const Corner& c,
                    const Corner& d) {
  face(material, {a, b, c, d});
}

void CityMesh::quad(CityMaterial material, glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d, glm::vec2 foot,
                    glm::vec2 top) {
  face(material, {{a, foot}, {b, {top.x, foot.y}}, {c, top}, {d, {foot.x, top.y}}});
}

void CityMesh::move_into(scene::Model& model) {
  for (auto& [key, mesh] : meshes_) {
    scene::Part part;
    part.object = key.first + " " + model.materials[std::size_t(key.second)].name;
    part.mesh = std::move(mesh);
    part.material = int(key.second);
    model.parts.push_back(std::move(part));
  }
  meshes_.clear();
}

}  // namespace parvis::city
