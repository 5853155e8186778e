#include "graphics/reference/shading_point.h"

#include <algorithm>
#include <cmath>

#include "graphics/reference/traced_hit.h"
#include "graphics/shading/glass.h"

namespace parvis::reference {
namespace {

using glm::vec2, glm::vec3, glm::vec4;

/// The corners of the triangle that was hit, in the world.
struct Corners {
  vec3 position[3], normal[3];
};

const std::uint32_t* vertices_of(const Hit& hit) {
  return hit.place->mesh->indices.data() + 3 * std::size_t(hit.triangle);
}

Corners corners_of(const Hit& hit) {
  const PlacedPart& place = *hit.place;
  const std::uint32_t* vertex = vertices_of(hit);
  Corners corners;
  for (int k = 0; k < 3; ++k) {
    corners.position[k] = vec3(place.world_from_mesh * vec4(place.mesh->positions[vertex[k]], 1.0f));
    corners.normal[k] = place.world_from_normal * place.mesh->normals[vertex[k]];
  }
  return corners;
}

/// Values at a triangle's corners, interpolated at the point that was hit.
template <class T>
T interpolated(const Hit& hit, const std::vector<T>& values) {
  const std::uint32_t* vertex = vertices_of(hit);
  return (1.0f - hit.u - hit.v) * values[vertex[0]] + hit.u * values[vertex[1]] + hit.v * values[vertex[2]];
}

/// How a texture lies on the triangle that was hit.
struct TexturePlace {
  vec2 corners[3];
  vec2 at;         ///< of the point
  float uv_per_m;  ///< coordinates that pass in a metre of the triangle: the mean of both directions
};

TexturePlace texture_place(const Hit& hit, const scene::TextureMapping& mapping, vec3 facet) {
  const Mesh& mesh = *hit.place->mesh;
  const std::vector<vec2>& uvs =
      mapping.takes_second_uvs && !mesh.second_uvs.empty() ? mesh.second_uvs : mesh.uvs;
  const std::uint32_t* vertex = vertices_of(hit);
  TexturePlace place{};
  for (int k = 0; k < 3; ++k) place.corners[k] = vec2(mapping.texture_from_uv * vec3(uvs[vertex[k]], 1.0f));
  const vec2 t1 = place.corners[1] - place.corners[0], t2 = place.corners[2] - place.corners[0];
  place.at = place.corners[0] + hit.u * t1 + hit.v * t2;
  place.uv_per_m = std::sqrt(std::abs(t1.x * t2.y - t1.y * t2.x) / std::max(glm::length(facet), 1e-12f));
  return place;
}

/// `facet` where vertices have no normal, or cancel each other's.
vec3 unit_or(vec3 vector, vec3 facet) {
  const float squared = glm::dot(vector, vector);
  if (squared > 1e-20f) return vector / std::sqrt(squared);
  const float area = glm::length(facet);
  return area > 0.0f ? facet / area : vec3(0.0f, 0.0f, 1.0f);
}

/// Curvature by the normals along the edges (Akenine-Moeller et al. 2021, Improved Shader and Texture Level
/// of Detail Using Ray Cones, measure it between pixels).
float curvature_per_m(const Corners& corners, vec3 facet) {
  float sum = 0.0f;
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    const float edge_m = glm::length(corners.position[next] - corners.position[k]);
    if (edge_m > 0.0f)
      sum += glm::length(unit_or(corners.normal[next], facet) - unit_or(corners.normal[k], facet)) / edge_m;
  }
  return sum / 3.0f;
}

shading::TextureFrame frame_of(const Corners& corners, const TexturePlace& texture) {
  return {corners.position[1] - corners.position[0], corners.position[2] - corners.position[0],
          texture.corners[1] - texture.corners[0], texture.corners[2] - texture.corners[0]};
}

/// Where a room's own functions say what the surface is like.
ShadingPoint traced_point(const Hit& hit, vec3 direction, float width_m) {
  const scene::TracedHit seen = traced_hit(*hit.place, hit.triangle, {hit.u, hit.v}, -direction, width_m);
  const scene::TracedPoint found = hit.place->surface->point(seen);
  ShadingPoint point;
  point.position = seen.position;
  point.geometric_normal = seen.normal;
  point.curvature_per_m = 0.0f;
  point.is_back = seen.is_back;
  point.alpha = hit.place->surface->alpha(seen);
  point.openness = found.openness;
  point.kept_in_shadow = found.kept_in_shadow;
  point.surface = {found.normal,       found.base_colour, found.metallic,
                   found.roughness,    found.clear_coat,  found.clear_coat_roughness,
                   found.translucency, found.occlusion,   found.emission};
  return point;
}

/// Where a material says what it is like; `detail_share`: of its picture, else of that picture's mean.
ShadingPoint material_point(const Hit& hit, vec3 direction, float width_m, float detail_share) {
  const PlacedPart& place = *hit.place;
  const scene::Material& material = *place.material;
  const Corners corners = corners_of(hit);
  const vec3 facet =
      (place.is_mirrored ? -1.0f : 1.0f) *
      glm::cross(corners.position[1] - corners.position[0], corners.position[2] - corners.position[0]);
  const float weights[3]{1.0f - hit.u - hit.v, hit.u, hit.v};
  vec3 normal(0.0f), position(0.0f);
  float openness = place.openness.empty() ? 1.0f : 0.0f;
  for (int k = 0; k < 3; ++k) {
    position += weights[k] * corners.position[k];
    normal += weights[k] * corners.normal[k];
    if (!place.openness.empty())
      openness +=
          weights[k] * place.openness[place.mesh->indices[3 * std::size_t(hit.triangle) + std::size_t(k)]];
  }
  normal = unit_or(normal, facet);
  const bool is_back = glm::dot(facet, direction) > 0.0f;
  if (is_back) normal = -normal;

  TexturePlace base_place = texture_place(hit, {material.texture_from_mesh_uv}, facet);
  const auto mips_of = [&](int texture) -> const MipTexture& {
    return (*place.textures)[std::size_t(texture)];
  };
  const auto texels_of = [&](const MipTexture& mips, const TexturePlace& texture) {
    return width_m * texture.uv_per_m * std::sqrt(mips.size().x * mips.size().y);
  };
  ShadingPoint point;
  if (material.relief_m > 0.0f && material.normal_texture != scene::no_index) {
    const MipTexture& mips = mips_of(material.normal_texture);
    point.relief = Relief(mips, texels_of(mips, base_place), material.relief_m, width_m,
                          frame_of(corners, base_place), normal, direction, base_place.at);
    base_place.at = point.relief.uv();
  }
  const auto place_of = [&](scene::TextureMapping scene::OwnMappings::*texture) {
    return material.own_mappings ? texture_place(hit, (*material.own_mappings).*texture, facet) : base_place;
  };
  const auto sampled = [&](int texture, vec4 plain, const TexturePlace& at) {
    if (texture == scene::no_index) return plain;
    const MipTexture& mips = mips_of(texture);
    return mips.sample(at.at, texels_of(mips, at));
  };
  using scene::OwnMappings;
  const vec4 white(1.0f);
  vec4 base = sampled(material.base_colour_texture, white, base_place);
  if (detail_share < 1.0f && material.base_colour_texture != scene::no_index) {
    const vec3 mean(mips_of(material.base_colour_texture).mean());
    base = vec4(glm::mix(mean, vec3(base), detail_share), base.w);
  }
  if (!place.mesh->colours.empty()) base *= interpolated(hit, place.mesh->colours);
  vec4 detail = sampled(material.surface_texture, white, place_of(&OwnMappings::surface));
  if (material.occlusion_texture != scene::no_index)
    detail.x = sampled(material.occlusion_texture, white, place_of(&OwnMappings::occlusion)).x;
  detail.x = glm::mix(1.0f, detail.x, material.occlusion_strength);
  const TexturePlace normal_place = place_of(&OwnMappings::normal);
  const vec4 bump = sampled(material.normal_texture, vec4(0.5f, 0.5f, 1.0f, 1.0f), normal_place);

  point.position = position;
  point.geometric_normal = normal;
  point.curvature_per_m = place.is_mirror || material.refracts() ? curvature_per_m(corners, facet) : 0.0f;
  point.is_back = is_back;
  point.openness = openness;
  point.alpha = base.w * material.alpha;
  shading::Surface& s = point.surface;
  const vec3 shading_normal = material.normal_texture == scene::no_index
                                  ? normal
                                  : shading::mapped_normal(frame_of(corners, normal_place), normal,
                                                           vec3(bump), material.normal_scale);
  s = shading::assembled_surface(
      shading_normal, vec3(base) * material.base_colour, vec3(detail),
      material.emission * vec3(sampled(material.emission_texture, white, place_of(&OwnMappings::emission))),
      vec4(material.metallic, material.roughness, material.clear_coat, material.clear_coat_roughness),
      material.translucency);
  if (material.refracts()) s = shading::glass_surface(s, material.ior);
  return point;
}

}  // namespace

ShadingPoint shading_point(const Hit& hit, vec3 direction, float width_m, vec4 realism) {
  ShadingPoint point = hit.place->surface ? traced_point(hit, direction, width_m)
                                          : material_point(hit, direction, width_m, realism.y);
  if (!shading::shows_everything(realism))
    point.surface = shading::simplified(point.surface, point.geometric_normal, realism);
  return point;
}

}  // namespace parvis::reference
