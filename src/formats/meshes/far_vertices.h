// Vertices of OBJ, PLY, STL and OFF files in double precision: assimp reads single precision, in which
// coordinates of a national grid are half a metre apart.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace parvis::scene {

/// The box of a file's vertices, in the file's axes.
struct VertexBox {
  glm::dvec3 low, high;
};

/// The box of the vertices of a file whose first one lies further than formats::max_local_m from zero. None
/// where it does not, and where the format (by its extension, ".ply") is none of those above or cannot be
/// followed.
std::optional<VertexBox> far_vertices(std::string_view bytes, std::string_view extension);

/// The same file with `origin` taken off each of its vertices.
std::string moved_vertices(std::string_view bytes, std::string_view extension, glm::dvec3 origin);

}  // namespace parvis::scene
