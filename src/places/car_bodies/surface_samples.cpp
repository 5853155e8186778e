#include "places/car_bodies/surface_samples.h"

#include <algorithm>
#include <cmath>

#include "base/colour.h"
#include "places/car_bodies/outer_skin.h"

namespace parvis::car_bodies {
namespace {

constexpr float min_area_m2 = 1e-8f;
constexpr float see_through =
    0.5f;  // alpha below which a picture has a hole, as the reader of cutouts has it

/// The part of a repeating picture that a coordinate shows; 1 stays 1, the far edge (as masks have it).
float wrapped(float coordinate) {
  return coordinate < 0.0f || coordinate > 1.0f ? coordinate - std::floor(coordinate) : coordinate;
}

void look_up(const scene::Model& model, const scene::Material& material, SurfaceSample& sample) {
  sample.has_picture = material.base_colour_texture != scene::no_index;
  float alpha = material.alpha;
  glm::vec3 linear = material.base_colour;
  if (sample.has_picture) {
    const Image8& picture = model.textures[std::size_t(material.base_colour_texture)].image;
    const int x = std::min(int(sample.uv.x * float(picture.width)), picture.width - 1);
    const int y = std::min(int(sample.uv.y * float(picture.height)), picture.height - 1);
    const std::uint8_t* texel = picture.at(x, y);
    linear *= linear_from_srgb(glm::vec3(texel[0], texel[1], texel[2]) / 255.0f);
    if (picture.channels == 4) alpha *= float(texel[3]) / 255.0f;
  }
  sample.srgb = srgb_from_linear(linear);
  sample.is_hole = material.alpha_mode != scene::Alpha::opaque && alpha < see_through;
}

}  // namespace

std::vector<SurfaceSample> samples_of(const Body& body) {
  const scene::Model& model = body.model();
  const Bounds& bounds = body.bounds();
  const OuterSkin skin(body);
  std::vector<SurfaceSample> samples;
  samples.reserve(model.triangle_count());
  for (std::size_t part = 0; part < model.parts.size(); ++part) {
    const Mesh& mesh = model.parts[part].mesh;
    const scene::Material& material = model.materials[std::size_t(model.parts[part].material)];
    for (std::uint32_t triangle = 0; triangle < mesh.triangle_count(); ++triangle) {
      SurfaceSample sample{.part = part, .triangle = triangle};
      const std::array<glm::vec3, 3> at = body.corners(part, triangle);
      glm::vec2 mean(0.0f);
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::vec3 uv(mesh.uvs[mesh.indices[3 * std::size_t(triangle) + k]], 1.0f);
        sample.corner_uvs[k] = glm::vec2(material.texture_from_mesh_uv * uv);
        mean += sample.corner_uvs[k] / 3.0f;
      }
      sample.uv = {wrapped(mean.x), wrapped(mean.y)};
      for (glm::vec2& uv : sample.corner_uvs) uv += sample.uv - mean;
      const glm::vec3 sides = glm::cross(at[1] - at[0], at[2] - at[0]);
      sample.area_m2 = 0.5f * glm::length(sides);
      sample.centre = (at[0] + at[1] + at[2]) / 3.0f;
      if (sample.area_m2 > min_area_m2) sample.normal = glm::normalize(sides);
      if (glm::dot(sample.normal, sample.centre - bounds.centre()) < 0.0f) sample.normal = -sample.normal;
      sample.height = (sample.centre.z - bounds.min.z) / bounds.size().z;
      sample.top = (std::max({at[0].z, at[1].z, at[2].z}) - bounds.min.z) / bounds.size().z;
      sample.forward = (sample.centre.x - bounds.centre().x) / bounds.size().x;
      sample.is_outer = skin.holds(sample.centre);
      look_up(model, material, sample);
      samples.push_back(sample);
    }
  }
  return samples;
}

float spread(glm::vec3 srgb) {
  return std::max({srgb.x, srgb.y, srgb.z}) - std::min({srgb.x, srgb.y, srgb.z});
}

}  // namespace parvis::car_bodies
