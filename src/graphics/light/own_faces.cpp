#include "graphics/light/own_faces.h"

#include <algorithm>
#include <glm/gtc/constants.hpp>

#include "base/parallel.h"
#include "graphics/light/ray_packet.h"
#include "graphics/shading/spherical_harmonics.h"

namespace parvis::light {
namespace {

/// Of surfaces that rooms draw by themselves: photographs of walls.
constexpr float wall_albedo = 0.35f;
constexpr std::size_t points_per_face = 8;

/// Mean of a texture, or white where the surface has none.
glm::vec3 mean_of(const reference::PlacedPart& place, int texture) {
  if (texture == scene::no_index) return glm::vec3(1.0f);
  return glm::vec3((*place.textures)[std::size_t(texture)].mean());
}

/// Weights of the second and third corner: points of low discrepancy (R2, Roberts 2018), folded into the
/// triangle.
glm::vec2 point_of(std::size_t number) {
  const glm::vec2 p(glm::fract(0.5 + double(number) * glm::dvec2(0.7548776662466927, 0.5698402909980532)));
  return p.x + p.y > 1.0f ? 1.0f - p : p;
}

}  // namespace

/// A surface texture has metallic in blue (glTF 2.0, section 3.9.2), by which the factor, 1 unless it is
/// given, is multiplied.
glm::vec3 albedo_of(const reference::PlacedPart& place) {
  if (place.surface) return glm::vec3(wall_albedo);
  const scene::Material& material = *place.material;
  const float metallic = material.metallic * mean_of(place, material.surface_texture).z;
  return (1.0f - metallic) * material.base_colour * mean_of(place, material.base_colour_texture);
}

OwnFaces::OwnFaces(const reference::RayScene& rays, int object, const SkyTable& sky) {
  for (const reference::PlacedPart* place : rays.parts_of(object)) {
    first_.resize(std::max(first_.size(), std::size_t(place->part) + 1));
    first_[std::size_t(place->part)] = triangles_.size();
    const Mesh& mesh = *place->mesh;
    const glm::vec3 given_back = albedo_of(*place) / glm::pi<float>();
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      const auto corner = [&](std::size_t k) {
        return glm::vec3(place->world_from_mesh * glm::vec4(mesh.positions[mesh.indices[i + k]], 1.0f));
      };
      glm::vec3 normal(0.0f);
      for (std::size_t k = 0; k < 3; ++k) normal += mesh.normals[mesh.indices[i + k]];
      normal = place->world_from_normal * normal;
      const float length = glm::length(normal);
      normal = length > 0.0f ? normal / length : glm::vec3(0.0f);
      const Corners corners{corner(0), corner(1) - corner(0), corner(2) - corner(0)};
      triangles_.push_back(corners);
      for (const glm::vec3 side : {normal, -normal})
        faces_.push_back({side, given_back, open_share * given_back * sky.irradiance(side), glm::vec3(0.0f),
                          shading::sh_basis(side)});
    }
  }
  light(rays, sky);
}

void OwnFaces::light(const reference::RayScene& rays, const SkyTable& sky) {
  if (sky.spot() || sky.sun_irradiance() == glm::vec3(0.0f)) return;
  constexpr std::size_t faces_per_task = 64;
  parallel_for((faces_.size() + faces_per_task - 1) / faces_per_task, [&](std::size_t task) {
    Packet packet(rays);
    const auto answer = [&] {
      const std::uint32_t blocked = packet.blocked();
      for (std::size_t i = 0; i < packet.count(); ++i)
        if ((blocked >> i & 1u) == 0) {
          Face& face = faces_[packet.tag(i).vertex];
          face.sun += glm::dot(sky.to_sun(), face.normal) / float(points_per_face) * face.given_back *
                      sky.sun_irradiance();
        }
      packet.clear();
    };
    for (std::size_t f = task * faces_per_task; f < std::min(faces_.size(), (task + 1) * faces_per_task);
         ++f) {
      const Face& face = faces_[f];
      if (!(glm::dot(sky.to_sun(), face.normal) > 0.0f)) continue;
      const Corners& corners = triangles_[f / 2];
      for (std::size_t p = 0; p < points_per_face; ++p) {
        const glm::vec2 at = point_of(p + points_per_face * (f / 2));
        packet.add(corners.a + at.x * corners.ab + at.y * corners.ac + lift_m * face.normal, sky.to_sun(),
                   {f, p});
        if (packet.is_full()) answer();
      }
    }
    answer();
  });
}

std::uint32_t OwnFaces::number(const reference::Hit& hit, glm::vec3 direction) const {
  const std::size_t triangle = first_[std::size_t(hit.place->part)] + hit.triangle;
  const Corners& corners = triangles_[triangle];
  const bool is_back =
      (glm::dot(glm::cross(corners.ab, corners.ac), direction) > 0.0f) != hit.place->is_mirrored;
  return std::uint32_t(2 * triangle + (is_back ? 1 : 0));
}

}  // namespace parvis::light
