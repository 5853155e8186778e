#include "scene/data/glass_pieces.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

#include "base/joined_triangles.h"
#include "scene/data/part_division.h"

namespace parvis::scene {
namespace {

bool is_same_glass(const Material& a, const Material& b) {
  return a.ior == b.ior && a.absorption_per_m == b.absorption_per_m && a.is_mirror_like == b.is_mirror_like;
}

/// A model's glass of one kind, and where its triangles come from.
struct Glass {
  int material;
  Mesh mesh;
  std::vector<std::pair<std::size_t, std::uint32_t>> origins;  ///< part and triangle
};

std::vector<Glass> glass_by_kind(const Model& model) {
  std::vector<Glass> kinds;
  const std::vector<glm::mat4> pose = rest_pose(model);
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    const Part& part = model.parts[p];
    const Material& material = model.materials[std::size_t(part.material)];
    if (!material.refracts()) continue;
    auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const Glass& glass) {
      return is_same_glass(model.materials[std::size_t(glass.material)], material);
    });
    if (kind == kinds.end()) kind = kinds.insert(kinds.end(), Glass{part.material, {}, {}});
    append(kind->mesh, part.mesh, pose[std::size_t(part.node)]);
    for (std::uint32_t t = 0; t < part.mesh.triangle_count(); ++t) kind->origins.emplace_back(p, t);
  }
  return kinds;
}

GlassPiece piece_of(const Glass& glass, const MeshShell& shell) {
  GlassPiece made;
  made.material = glass.material, made.is_closed = shell.is_closed, made.volume = shell.volume;
  std::map<std::uint32_t, std::uint32_t> known;
  for (const std::uint32_t t : shell.triangles) {
    const auto [part, triangle] = glass.origins[t];
    made.triangles[part].push_back(triangle);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t vertex = glass.mesh.indices[3 * t + k];
      const auto [entry, is_new] = known.try_emplace(vertex, std::uint32_t(made.mesh.positions.size()));
      made.mesh.indices.push_back(entry->second);
      if (!is_new) continue;
      made.mesh.positions.push_back(glass.mesh.positions[vertex]);
      made.mesh.normals.push_back(glass.mesh.normals[vertex]);
      made.mesh.uvs.push_back(glass.mesh.uvs[vertex]);
    }
  }
  return made;
}

bool contains(const Bounds& outer, const Bounds& inner) {
  return glm::all(glm::lessThanEqual(outer.min, inner.min)) &&
         glm::all(glm::lessThanEqual(inner.max, outer.max));
}

/// Sums the solid angles under which a point sees the triangles of a closed mesh (van Oosterom and Strackee
/// 1983): they add up to the whole sphere, or to nothing.
bool encloses(const Mesh& mesh, glm::vec3 point) {
  double half_angle = 0.0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    glm::dvec3 to[3];
    for (std::size_t k = 0; k < 3; ++k)
      to[k] = glm::normalize(glm::dvec3(mesh.positions[mesh.indices[i + k]]) - glm::dvec3(point));
    half_angle += std::atan2(glm::dot(to[0], glm::cross(to[1], to[2])),
                             1.0 + glm::dot(to[0], to[1]) + glm::dot(to[1], to[2]) + glm::dot(to[2], to[0]));
  }
  constexpr double pi = 3.14159265358979;
  return std::abs(half_angle) > pi;
}

double volume_of(const Bounds& bounds) {
  const glm::dvec3 size(bounds.size());
  return size.x * size.y * size.z;
}

/// The surfaces of one body: the outermost, and how many are around this one.
struct Nesting {
  std::size_t outermost;
  int depth = 0;
};

/// Surfaces do not cross: what is around the nearest one around a surface is around that one, too. So each
/// asks for the nearest alone, and many surfaces in one another are soon sorted out.
std::vector<Nesting> nested(const std::vector<GlassPiece>& found) {
  std::vector<Bounds> bounds;
  bounds.reserve(found.size());
  for (const GlassPiece& piece : found) bounds.push_back(piece.mesh.bounds());
  std::vector<std::size_t> by_size(found.size());
  std::iota(by_size.begin(), by_size.end(), std::size_t(0));
  std::ranges::sort(by_size, {}, [&](std::size_t i) { return std::pair(-volume_of(bounds[i]), i); });
  const auto surrounds = [&](std::size_t i, std::size_t inner) {
    return found[i].is_closed && contains(bounds[i], bounds[inner]) && !contains(bounds[inner], bounds[i]) &&
           encloses(found[i].mesh, found[inner].mesh.positions.front());
  };
  std::vector<Nesting> nestings(found.size());
  for (std::size_t n = 0; n < by_size.size(); ++n) {
    const std::size_t inner = by_size[n];
    nestings[inner].outermost = inner;
    for (std::size_t k = n; found[inner].is_closed && k-- > 0;)
      if (surrounds(by_size[k], inner)) {
        nestings[inner] = {nestings[by_size[k]].outermost, nestings[by_size[k]].depth + 1};
        break;
      }
  }
  return nestings;
}

/// Joins the surfaces of cavities to the bodies of the same glass that they are in.
void join_cavities(std::vector<GlassPiece>& found) {
  const std::vector<Nesting> nestings = nested(found);
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (nestings[i].outermost == i) continue;
    GlassPiece& body = found[nestings[i].outermost];
    body.volume += nestings[i].depth % 2 == 1 ? -found[i].volume : found[i].volume;
    append(body.mesh, found[i].mesh);
    for (const auto& [part, triangles] : found[i].triangles)
      for (const std::uint32_t triangle : triangles) body.triangles[part].push_back(triangle);
    found[i].mesh = {};
  }
  std::erase_if(found, [](const GlassPiece& piece) { return piece.mesh.indices.empty(); });
}

}  // namespace

std::vector<GlassPiece> glass_pieces(const Model& model) {
  std::vector<GlassPiece> found;
  for (const Glass& glass : glass_by_kind(model)) {
    std::vector<GlassPiece> of_kind;
    for (const MeshShell& shell : shells(glass.mesh)) of_kind.push_back(piece_of(glass, shell));
    join_cavities(of_kind);
    std::ranges::move(of_kind, std::back_inserter(found));
  }
  return found;
}

void divide_glass(Model& model) {
  std::map<std::size_t, std::vector<std::vector<std::uint32_t>>> lists_of_part;  // a list for each piece
  for (GlassPiece& piece : glass_pieces(model))
    for (auto& [part, triangles] : piece.triangles) lists_of_part[part].push_back(std::move(triangles));
  for (const auto& [index, lists] : lists_of_part) {
    if (lists.size() < 2) continue;  // what has no three corners is shown nowhere
    std::vector<Part> parts = divided(model.parts[index], lists);
    model.parts[index] = std::move(parts.front());
    model.parts.insert(model.parts.end(), std::make_move_iterator(parts.begin() + 1),
                       std::make_move_iterator(parts.end()));
  }
}

}  // namespace parvis::scene
