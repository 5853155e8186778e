#include "reflections/reflector_maps/reflector_sources.h"

#include <algorithm>
#include <cmath>

#include "reflections/methods/settings.h"
#include "scene/data/glass_pieces.h"

namespace parvis::reflector_maps {
namespace {

constexpr int texels_per_face_texel =
    4;                           // a map's side, for the resolution that scripts give for a cube map's face
constexpr int glass_side = 512;  // texels of a body's map: smooth ones to a hundredth of a degree
constexpr int min_glass_side = 128;  // of one among many: to a tenth

std::string name_of(const scene::Object& object) {
  if (!object.name.empty()) return object.name;
  return object.model->name.empty() ? "reflector" : object.model->name;
}

bool is_glass(const scene::Material& material) { return material.refracts() && material.is_mirror_like; }

/// Thickness of a sheet with as much glass as the body, as large as half its surface: the wall of a shell.
float thickness_of(const scene::GlassPiece& body) {
  double area = 0.0;
  for (std::size_t i = 0; i < body.mesh.indices.size(); i += 3) {
    const auto corner = [&](std::size_t k) {
      return glm::dvec3(body.mesh.positions[body.mesh.indices[i + k]]);
    };
    area += 0.5 * glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
  }
  return float(2.0 * body.volume / area);
}

/// Side of a piece's map: all pieces have as many texels as one body would, and each has the least.
int side_of(float size, float all_sizes) {
  return std::max(min_glass_side, int(std::lround(float(glass_side) * size / all_sizes)));
}

}  // namespace

ReflectorSource mirror_source(const scene::Scene& scene, const scene::Object& object) {
  Mesh mesh;
  const scene::Model& model = *object.model;
  const std::vector<glm::mat4> pose = scene::rest_pose(model);
  for (const scene::Part& part : model.parts)
    if (model.materials[std::size_t(part.material)].is_mirror_like)
      append(mesh, part.mesh, pose[std::size_t(part.node)]);
  return {name_of(object), std::move(mesh), texels_per_face_texel * methods::settings(scene).resolution};
}

bool has_glass(const scene::Model& model) {
  return std::ranges::any_of(model.parts, [&](const scene::Part& part) {
    return is_glass(model.materials[std::size_t(part.material)]);
  });
}

bool has_glass(const scene::Scene& scene) {
  return std::ranges::any_of(scene.objects, [](const scene::Object& object) {
    return object.takes_reflection && has_glass(*object.model);
  });
}

std::vector<GlassSource> glass_sources(const scene::Object& object) {
  const scene::Model& model = *object.model;
  std::vector<GlassSource> sources;
  float squares = 0.0f;
  for (scene::GlassPiece& body : scene::glass_pieces(model)) {
    const scene::Material& material = model.materials[std::size_t(body.material)];
    if (!is_glass(material)) continue;
    std::vector<std::size_t> parts;
    parts.reserve(body.triangles.size());
    for (const auto& [part, triangles] : body.triangles) parts.push_back(part);
    const float size = body.mesh.bounds().radius();
    squares += size * size;
    const float thickness = body.is_closed ? thickness_of(body) : material.thickness_m;
    sources.push_back({{name_of(object), std::move(body.mesh), glass_side},
                       &material,
                       std::move(parts),
                       body.is_closed,
                       thickness});
  }
  if (sources.size() < 2) return sources;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    ReflectorSource& outside = sources[i].outside;
    const std::string& part = model.parts[sources[i].parts.front()].object;
    outside.name += fmt::format(", glass {}{}", i + 1, part.empty() ? "" : " (" + part + ")");
    outside.side = side_of(outside.mesh.bounds().radius(), std::sqrt(squares));
  }
  return sources;
}

}  // namespace parvis::reflector_maps
