#include "formats/meshes/wheel.h"

#include <glm/gtc/constants.hpp>
#include <span>

namespace parvis::scene {
namespace {

constexpr int spoke_count = 5;
constexpr float spoke_flare =
    0.22f;  ///< half a spoke's width at the lip, as a share of the distance between spokes

/// A point of a profile that turns about the y axis.
struct ProfilePoint {
  float radius, y;
};

glm::vec3 on_circle(ProfilePoint point, float angle) {
  return {point.radius * glm::cos(angle), point.y, point.radius * glm::sin(angle)};
}

/// The surface of a profile that turns about y. Drawn with y to the right and the radius upward, the outside
/// lies to the left of someone who walks along the profile.
void add_turned(Mesh& mesh, std::span<const ProfilePoint> profile, std::uint32_t segments) {
  const std::uint32_t first = std::uint32_t(mesh.positions.size());
  for (const ProfilePoint& point : profile)
    for (std::uint32_t i = 0; i < segments; ++i)
      mesh.positions.push_back(on_circle(point, glm::two_pi<float>() * float(i) / float(segments)));
  for (std::uint32_t j = 0; j + 1 < profile.size(); ++j)
    for (std::uint32_t i = 0; i < segments; ++i) {
      const std::uint32_t row = first + j * segments, next = (i + 1) % segments;
      const std::uint32_t a = row + i, b = row + next, c = a + segments, d = b + segments;
      mesh.indices.insert(mesh.indices.end(), {a, c, b, b, c, d});
    }
}

/// A flat spoke between two radii at depth `y`, facing +y, with flanks that go down to `back_y`.
void add_spoke(Mesh& mesh, float angle, float inner, float outer, float half_inner, float half_outer, float y,
               float back_y) {
  const auto corner = [&](float radius, float half, float depth) {
    const glm::vec3 along(glm::cos(angle), 0.0f, glm::sin(angle)),
        across(-glm::sin(angle), 0.0f, glm::cos(angle));
    return radius * along + half * across + glm::vec3(0.0f, depth, 0.0f);
  };
  const auto quad = [&](glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) {
    const std::uint32_t first = std::uint32_t(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {a, b, c, d});
    mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
  };
  const glm::vec3 a = corner(inner, -half_inner, y), b = corner(inner, half_inner, y),
                  c = corner(outer, half_outer, y), d = corner(outer, -half_outer, y);
  const glm::vec3 back(0.0f, back_y - y, 0.0f);
  quad(a, b, c, d);
  quad(b, b + back, c + back, c);
  quad(a + back, a, d, d + back);
}

Mesh finished(Mesh mesh) {
  fill_normals(mesh);
  mesh.uvs.assign(mesh.positions.size(), glm::vec2(0.0f));
  return mesh;
}

/// The tyre from the inner side over the tread to the outer side.
Mesh tyre(const WheelShape& shape) {
  const float half = 0.5f * shape.width_m, r = shape.radius_m, rim = shape.rim_radius_m;
  const float shoulder = 0.25f * (r - rim);
  const ProfilePoint plain[] = {{rim, -0.80f * half}, {r - 2 * shoulder, -half}, {r, -0.75f * half},
                                {r, 0.75f * half},    {r - 2 * shoulder, half},  {rim, 0.80f * half}};
  const ProfilePoint rounded[] = {{rim, -0.80f * half},
                                  {rim + shoulder, -half},
                                  {r - 2 * shoulder, -half},
                                  {r - 0.6f * shoulder, -0.94f * half},
                                  {r - 0.1f * shoulder, -0.75f * half},
                                  {r, -0.45f * half},
                                  {r, 0.45f * half},
                                  {r - 0.1f * shoulder, 0.75f * half},
                                  {r - 0.6f * shoulder, 0.94f * half},
                                  {r - 2 * shoulder, half},
                                  {rim + shoulder, half},
                                  {rim, 0.80f * half}};
  Mesh mesh;
  add_turned(mesh, shape.has_round_shoulders ? std::span<const ProfilePoint>(rounded) : plain,
             std::uint32_t(shape.segments));
  return finished(std::move(mesh));
}

/// The lip, the barrel behind the spokes, a closing disc, spokes and a hub.
Mesh rim(const WheelShape& shape) {
  const float half = 0.5f * shape.width_m, r = shape.rim_radius_m;
  const float face_y = 0.62f * half, back_y = 0.1f * half, hub = 0.28f * r;
  const ProfilePoint barrel[] = {
      {r, 0.80f * half}, {0.94f * r, 0.82f * half}, {0.90f * r, 0.70f * half}, {0.90f * r, back_y}};
  const ProfilePoint cap[] = {
      {hub, back_y}, {hub, face_y}, {0.8f * hub, face_y + 0.06f * half}, {0.0f, face_y + 0.1f * half}};
  Mesh mesh;
  add_turned(mesh, barrel, std::uint32_t(shape.segments));
  add_turned(mesh, cap, std::uint32_t(shape.segments));
  const float step = glm::two_pi<float>() / float(spoke_count);
  for (int i = 0; i < spoke_count; ++i)
    add_spoke(mesh, step * float(i), 0.9f * hub, 0.93f * r, 0.45f * step * hub, spoke_flare * step * r,
              face_y, back_y);
  return finished(std::move(mesh));
}

/// The disc that is seen between the spokes, as the brake's dark drum, and the wheel's inner side.
Mesh disc(const WheelShape& shape) {
  const float half = 0.5f * shape.width_m;
  const ProfilePoint front[] = {{0.92f * shape.rim_radius_m, 0.1f * half}, {0.0f, 0.1f * half}};
  const ProfilePoint back[] = {{0.0f, -0.5f * half}, {shape.rim_radius_m, -0.80f * half}};
  Mesh mesh;
  add_turned(mesh, front, std::uint32_t(shape.segments));
  add_turned(mesh, back, std::uint32_t(shape.segments));
  return finished(std::move(mesh));
}

}  // namespace

Model make_wheel(const WheelShape& shape) {
  Model model;
  model.name = "wheel";
  model.materials = {
      {.name = "rubber", .base_colour = glm::vec3(0.045f), .roughness = 0.9f},
      {.name = "rim", .base_colour = glm::vec3(0.55f, 0.56f, 0.57f), .metallic = 1.0f, .roughness = 0.3f},
      {.name = "brake", .base_colour = glm::vec3(0.05f), .metallic = 0.0f, .roughness = 0.7f}};
  model.parts = {{.object = "tyre", .mesh = tyre(shape), .material = 0},
                 {.object = "rim", .mesh = rim(shape), .material = 1},
                 {.object = "brake", .mesh = disc(shape), .material = 2}};
  return model;
}

}  // namespace parvis::scene
