// Cutting of faces that hide each other in a cycle, or that intersect (Newell, Newell and Sancha 1972).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "capture/facades/layer_model.h"

namespace parvis::facades {

/// Splits the triangles of a face by the plane dot(normal, p) = offset (unit normal): what lies in front of
/// it keeps the face's number, what lies behind becomes a new face. False, and nothing is changed, where no
/// corner lies further than `tolerance` on either side.
bool cut_face(LayerModel& model, std::uint32_t face, glm::dvec3 normal, double offset, double tolerance);

/// Makes the cuts that resolve, or at least reduce, a cycle of faces as seen from `eye`. Faces of several
/// triangles are first divided into these. Then each pair that hides each other (it intersects) is cut along
/// the plane of one of the two; where there is no such pair, one face by the plane of a neighbour in the
/// cycle, and where no plane separates, by the planes through the eye and the edges of a neighbour, after
/// which a piece is hidden entirely or not at all. `hides` is of the faces in the cycle: hides[i] lists the
/// indices of those directly behind faces[i]. Returns the number of cuts and divisions; 0: nothing of the
/// cycle can be cut.
std::size_t cut_cycle(LayerModel& model, const std::vector<std::uint32_t>& faces,
                      const std::vector<std::vector<std::uint32_t>>& hides, glm::dvec3 eye);

}  // namespace parvis::facades
