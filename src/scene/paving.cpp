#include "scene/paving.h"

#include <algorithm>
#include <cmath>

#include "scene/ground_heights.h"
#include "scene/path.h"
#include "scene/tiling_noise.h"

namespace parvis::scene {

namespace {

constexpr float reach_m = 6.0f;           // beside a lane's middle, in which its ground is looked for
constexpr float lift_m = 0.05f;           // of the asphalt over the ground: ground meshes are coarse
constexpr float marking_lift_m = 0.015f;  // of the paint over the asphalt
constexpr float step_m = 1.0f;            // along lanes
constexpr float margin_m = 0.25f;         // of asphalt beside a lane, so that neighbours leave no gap
constexpr float tile_m = 6.0f;            // of the asphalt's picture
constexpr float dash_m = 3.0f, dash_gap_m = 3.0f;
constexpr float dash_half_width_m = 0.06f, line_half_width_m = 0.2f;
constexpr int strips_across = 4;

enum : int { asphalt, paint };

/// Asphalt: patches, stains and grains; it tiles.
Texture asphalt_picture() {
  constexpr int side = 512;
  Texture texture{"asphalt", Image8(side, side, 4, 255)};
  Random random(3);
  std::vector<float> light(std::size_t(side) * side, 58.0f);
  for (const auto& [count, strength] : {std::pair{3, 9.0f}, {17, 6.0f}, {96, 7.0f}, {512, 16.0f}}) {
    const TilingNoise noise(count, random);
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        light[std::size_t(y * side + x)] += strength * noise.at(glm::vec2(x, y) / float(side));
  }
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const float value = std::clamp(light[std::size_t(y * side + x)], 20.0f, 120.0f);
      for (int channel = 0; channel < 3; ++channel)
        texture.image.at(x, y)[channel] = std::uint8_t(value + float(channel));  // a touch of blue
    }
  return texture;
}

Model empty_paving() {
  Model model;
  model.name = "paving";
  model.textures.push_back(asphalt_picture());
  Material surface;
  surface.name = "asphalt";
  surface.base_colour = glm::vec3(1.0f);
  surface.base_colour_texture = 0;
  surface.roughness = 0.9f;
  Material markings;
  markings.name = "road paint";
  markings.base_colour = glm::vec3(0.55f);
  markings.roughness = 0.6f;
  model.materials = {surface, markings};
  for (const char* name : {"carriageway", "markings"}) {
    Part part;
    part.object = name;
    part.material = int(model.parts.size());
    part.casts_shadow = false;
    model.parts.push_back(part);
  }
  return model;
}

/// A ribbon along `line` from `left_m` to `right_m` beside it (to the right positive), lying `lift` over the
/// ground.
void add_ribbon(Mesh& mesh, const Path& line, float left_m, float right_m, const GroundHeights& ground,
                float lift) {
  const std::uint32_t first = std::uint32_t(mesh.positions.size());
  for (std::size_t i = 0; i < line.size(); ++i) {
    const glm::vec3 before = line[i > 0 ? i - 1 : 0], after = line[std::min(i + 1, line.size() - 1)];
    const glm::vec3 right = right_of(after - before);
    for (int k = 0; k <= strips_across; ++k) {
      glm::vec3 p = line[i] + right * glm::mix(left_m, right_m, float(k) / float(strips_across));
      p.z = ground.at(glm::vec2(p), line[i].z) + lift;
      mesh.positions.push_back(p);
      mesh.uvs.push_back(glm::vec2(p) / tile_m);
    }
  }
  constexpr std::uint32_t row = strips_across + 1;
  for (std::uint32_t i = 0; i + 1 < line.size(); ++i)
    for (std::uint32_t k = 0; k < strips_across; ++k) {
      const std::uint32_t near_left = first + i * row + k, far_left = near_left + row;
      mesh.indices.insert(mesh.indices.end(),
                          {near_left, near_left + 1, far_left, near_left + 1, far_left + 1, far_left});
    }
}

/// The lane's points at every metre or nearer, on the ground.
Path laid(const Path& points, const GroundHeights& ground) {
  const MeasuredPath path(points);
  const int count = std::max(1, int(std::ceil(path.length() / step_m)));
  Path result;
  for (int i = 0; i <= count; ++i) {
    glm::vec3 p = path.at(path.length() * float(i) / float(count));
    p.z = ground.at(glm::vec2(p), p.z);
    result.push_back(p);
  }
  return result;
}

/// Dashes on the left edge of innermost lanes; of two opposite lanes the one that heads east draws them.
void add_markings(Mesh& mesh, const Lane& lane, const Path& line, bool is_innermost,
                  const GroundHeights& ground) {
  const MeasuredPath path(line);
  const float left_m = -0.5f * lane.width_m;
  const float lift = lift_m + marking_lift_m;
  for (float from = 0.5f * dash_gap_m; is_innermost && from + dash_m < path.length();
       from += dash_m + dash_gap_m) {
    const glm::vec3 way = path.direction_at(from);
    if (way.x > 0.0f || (way.x == 0.0f && way.y > 0.0f))
      add_ribbon(mesh, path.part(from, from + dash_m), left_m - dash_half_width_m, left_m + dash_half_width_m,
                 ground, lift);
  }
  const bool waits_at_end = lane.next.size() > 1 && path.length() > 6.0f;
  const float stop_m = path.length() - 2.0f * line_half_width_m;
  if (waits_at_end)
    add_ribbon(mesh, path.part(stop_m, path.length()), left_m + 0.15f, 0.5f * lane.width_m, ground, lift);
}

/// Whether another street lane runs the other way, one lane's width to the left of this one's middle.
bool has_opposite(const RoadGraph& roads, const Lane& lane) {
  const MeasuredPath path(lane.points);
  const float middle_m = 0.5f * path.length();
  const glm::vec3 way = path.direction_at(middle_m);
  const glm::vec3 expected = path.at(middle_m) - right_of(way) * lane.width_m;
  return std::ranges::any_of(roads.lanes, [&](const Lane& other) {
    if (other.crossing >= 0 || &other == &lane) return false;
    for (std::size_t i = 0; i + 1 < other.points.size(); ++i) {
      const glm::vec2 a(other.points[i]), along = glm::vec2(other.points[i + 1]) - a;
      const float share =
          std::clamp(glm::dot(glm::vec2(expected) - a, along) / glm::dot(along, along), 0.0f, 1.0f);
      const bool is_near = glm::distance(a + share * along, glm::vec2(expected)) < 0.3f * lane.width_m;
      if (is_near && glm::dot(along, glm::vec2(way)) < 0.0f) return true;
    }
    return false;
  });
}

}  // namespace

void pave(Scene& scene) {
  if (scene.roads.empty()) return;
  const GroundHeights ground(scene, reach_m);
  auto model = std::make_shared<Model>(empty_paving());
  std::vector<Path> lines;
  for (const Lane& lane : scene.roads.lanes) {
    lines.push_back(laid(lane.points, ground));
    const float half_m = 0.5f * lane.width_m + margin_m;
    add_ribbon(model->parts[asphalt].mesh, lines.back(), -half_m, half_m, ground, lift_m);
    if (lane.crossing < 0)
      add_markings(model->parts[paint].mesh, lane, lines.back(), has_opposite(scene.roads, lane), ground);
  }
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (glm::vec3& p : lines[i]) p.z += lift_m;
    scene.roads.lanes[i].points = std::move(lines[i]);
  }
  std::erase_if(model->parts, [](const Part& part) { return part.mesh.indices.empty(); });
  for (Part& part : model->parts) fill_normals(part.mesh);

  Object object;
  object.name = "paving";
  object.model = std::move(model);
  scene.objects.push_back(std::move(object));
}

}  // namespace parvis::scene
