// The triangles of an object that may move, as they light its own vertices.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "graphics/light/sky_table.h"
#include "graphics/reference/ray_scene.h"

namespace parvis::light {

/// Share of the sky before a surface that is open, where what the surface gives back is wanted.
inline constexpr float open_share = 0.5f;

/// Mean colour that a surface which a ray hit gives back matt, as a share of what arrives.
glm::vec3 albedo_of(const reference::PlacedPart& place);

/// Both sides of each triangle of an object. How much of them the sun finds is asked once for all rays that
/// hit them, by several points of each.
class OwnFaces {
 public:
  /// One side.
  struct Face {
    glm::vec3 normal;      ///< unit, in the world, toward that side
    glm::vec3 given_back;  ///< radiance by irradiance
    /// Radiance that it gives back of the sky, as open_share says, and of the sun in the mean of its points.
    glm::vec3 sky, sun;
    std::array<float, 9> basis;  ///< of its normal: shading::sh_basis
  };

  /// The object of the scene that `rays` was made of, as it stands now, under this sky; it is set apart
  /// (RayScene::set_apart).
  OwnFaces(const reference::RayScene& rays, int object, const SkyTable& sky);

  /// The side of a triangle that a ray hit.
  std::uint32_t number(const reference::Hit& hit, glm::vec3 direction) const;
  /// By its number.
  const Face& face(std::uint32_t number) const { return faces_[number]; }

 private:
  void light(const reference::RayScene& rays, const SkyTable& sky);

  struct Corners {
    glm::vec3 a, ab, ac;  ///< one, and the ways from it to the others
  };
  std::vector<std::size_t> first_;  ///< triangle, of each part of the model
  std::vector<Corners> triangles_;
  std::vector<Face> faces_;  ///< front and back of each triangle
};

}  // namespace parvis::light
