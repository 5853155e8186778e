#include "graphics/render/occlusion.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"

namespace parvis::render {
namespace {

constexpr int depth_width = 640, depth_height = 360;
constexpr std::size_t pixel_count = std::size_t(depth_width) * std::size_t(depth_height);
constexpr float min_area_m2 = 4.0f;  // smaller triangles hide less than they cost
constexpr std::size_t max_shape_triangles = 20'000;
constexpr float min_area_px = 0.01f;
constexpr float farthest_px = 1e7f;  // of a corner from the picture: beyond it floats do not know the edges
constexpr std::size_t tasks = 16;
constexpr float slack = 1.001f;  // of depth: an occluder does not hide itself, nor what lies in its plane

/// Metres before the near plane, or a measure like them.
float before_near_plane(const glm::vec4& clip) { return clip.z + clip.w; }

/// The polygon's part before the near plane (Sutherland and Hodgman); a triangle gives 0, 3 or 4 corners.
int clip_to_near(const std::array<glm::vec4, 3>& in, std::array<glm::vec4, 4>& out) {
  int count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::vec4 &a = in[i], &b = in[(i + 1) % 3];
    const float at_a = before_near_plane(a), at_b = before_near_plane(b);
    if (at_a > 0.0f) out[std::size_t(count++)] = a;
    if ((at_a > 0.0f) != (at_b > 0.0f)) out[std::size_t(count++)] = glm::mix(a, b, at_a / (at_a - at_b));
  }
  return count;
}

/// x, y in pixels and 1/w.
glm::vec3 on_screen(const glm::vec4& clip) {
  const float inverse_w = 1.0f / clip.w;
  return {(0.5f + 0.5f * clip.x * inverse_w) * float(depth_width),
          (0.5f + 0.5f * clip.y * inverse_w) * float(depth_height), inverse_w};
}

void add_triangle(const std::array<glm::vec3, 3>& corners, bool has_backs, std::vector<glm::vec3>& out) {
  out.insert(out.end(), corners.begin(), corners.end());
  if (has_backs) out.insert(out.end(), corners.rbegin(), corners.rend());
}

float at(const glm::vec3& plane, float x, float y) { return plane.x * x + plane.y * y + plane.z; }

}  // namespace

void OcclusionCuller::add_occluder(const Mesh& mesh, const glm::mat4& world_from_mesh, bool has_backs) {
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    std::array<glm::vec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k)
      corners[k] = world_from_mesh * glm::vec4(mesh.positions[mesh.indices[i + k]], 1.0f);
    const float area = 0.5f * glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    if (area < min_area_m2) continue;
    add_triangle(corners, has_backs, corners_);
  }
}

int OcclusionCuller::add_shape(const Mesh& mesh, bool has_backs) {
  if (mesh.indices.size() / 3 > max_shape_triangles) return -1;
  std::vector<glm::vec3>& corners = shapes_.emplace_back();
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    add_triangle({mesh.positions[mesh.indices[i]], mesh.positions[mesh.indices[i + 1]],
                  mesh.positions[mesh.indices[i + 2]]},
                 has_backs, corners);
  return int(shapes_.size()) - 1;
}

void OcclusionCuller::project(const glm::mat4& clip_from_corners, const glm::vec3* corners,
                              std::vector<ScreenTriangle>& out) {
  std::array<glm::vec4, 3> clip;
  for (std::size_t k = 0; k < 3; ++k) clip[k] = clip_from_corners * glm::vec4(corners[k], 1.0f);
  for (int axis = 0; axis < 2; ++axis) {  // wholly to one side: most triangles leave here
    if (clip[0][axis] > clip[0].w && clip[1][axis] > clip[1].w && clip[2][axis] > clip[2].w) return;
    if (clip[0][axis] < -clip[0].w && clip[1][axis] < -clip[1].w && clip[2][axis] < -clip[2].w) return;
  }
  std::array<glm::vec4, 4> polygon;
  const int count = clip_to_near(clip, polygon);
  for (int fan = 1; fan + 1 < count; ++fan) {
    const std::array<glm::vec3, 3> p{on_screen(polygon[0]), on_screen(polygon[std::size_t(fan)]),
                                     on_screen(polygon[std::size_t(fan) + 1])};
    const float twice_area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
    if (twice_area < min_area_px) continue;  // seen from behind, or too small
    // Also where a corner is not a number, as that of a triangle of many kilometres that touches the eye's
    // plane.
    if (!std::ranges::all_of(
            p, [](const glm::vec3& c) { return std::abs(c.x) < farthest_px && std::abs(c.y) < farthest_px; }))
      continue;
    const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
    const auto [bottom, top] = std::minmax({p[0].y, p[1].y, p[2].y});
    ScreenTriangle screen;
    screen.min_x = int(std::clamp(left, 0.0f, float(depth_width - 1)));
    screen.max_x = int(std::clamp(right, -1.0f, float(depth_width - 1)));
    screen.min_y = int(std::clamp(bottom, 0.0f, float(depth_height - 1)));
    screen.max_y = int(std::clamp(top, -1.0f, float(depth_height - 1)));
    screen.inverse_w = glm::vec3(0.0f);
    for (std::size_t k = 0; k < 3; ++k) {  // barycentric coordinate of the corner opposite to each edge
      const glm::vec3 &a = p[(k + 1) % 3], &b = p[(k + 2) % 3];
      screen.edges[k] = glm::vec3(a.y - b.y, b.x - a.x, a.x * b.y - b.x * a.y) / twice_area;
      screen.inverse_w += p[k].z * screen.edges[k];
    }
    screen.farthest_inverse_w = std::min({p[0].z, p[1].z, p[2].z});
    out.push_back(screen);
  }
}

void OcclusionCuller::rasterise(const ScreenTriangle& t, int first_row, int end_row) {
  // The farthest depth within a pixel, not that of its centre, stands for the pixel.
  const float slope = 0.5f * (std::abs(t.inverse_w.x) + std::abs(t.inverse_w.y));
  for (int y = std::max(t.min_y, first_row); y <= std::min(t.max_y, end_row - 1); ++y) {
    float* row = inverse_w_.data() + std::size_t(y) * std::size_t(depth_width);
    const float cy = float(y) + 0.5f;
    for (int x = t.min_x; x <= t.max_x; ++x) {
      const float cx = float(x) + 0.5f;
      const float inside = std::min({at(t.edges[0], cx, cy), at(t.edges[1], cx, cy), at(t.edges[2], cx, cy)});
      const float depth = std::max(at(t.inverse_w, cx, cy) - slope, t.farthest_inverse_w);
      row[x] = inside >= 0.0f ? std::max(row[x], depth) : row[x];
    }
  }
}

void OcclusionCuller::take_farthest_of_neighbours() {
  row_minima_.resize(pixel_count);
  farthest_.resize(pixel_count);
  parallel_for(
      std::size_t(depth_height),
      [&](std::size_t y) {
        const float* in = inverse_w_.data() + y * std::size_t(depth_width);
        float* out = row_minima_.data() + y * std::size_t(depth_width);
        for (int x = 0; x < depth_width; ++x)
          out[x] = std::min({in[std::max(x - 1, 0)], in[x], in[std::min(x + 1, depth_width - 1)]});
      },
      32);
  parallel_for(
      std::size_t(depth_height),
      [&](std::size_t y) {
        const std::size_t above = std::min(y + 1, std::size_t(depth_height) - 1), below = y > 0 ? y - 1 : 0;
        const auto minima = [&](std::size_t r) { return row_minima_.data() + r * std::size_t(depth_width); };
        float* out = farthest_.data() + y * std::size_t(depth_width);
        for (int x = 0; x < depth_width; ++x)
          out[x] = std::min({minima(below)[x], minima(y)[x], minima(above)[x]});
      },
      32);
}

void OcclusionCuller::draw(const glm::mat4& clip_from_world, std::span<const PlacedShape> placed) {
  clip_from_world_ = clip_from_world;
  inverse_w_.assign(pixel_count, 0.0f);
  projected_.resize(tasks);
  const std::size_t count = occluder_count();
  parallel_for(tasks, [&](std::size_t task) {
    projected_[task].clear();
    for (std::size_t i = task * count / tasks; i < (task + 1) * count / tasks; ++i)
      project(clip_from_world, &corners_[3 * i], projected_[task]);
    for (std::size_t i = task; i < placed.size(); i += tasks) {
      const std::vector<glm::vec3>& corners = shapes_[std::size_t(placed[i].shape)];
      const glm::mat4 clip_from_mesh = clip_from_world * placed[i].world_from_mesh;
      for (std::size_t c = 0; c < corners.size(); c += 3)
        project(clip_from_mesh, &corners[c], projected_[task]);
    }
  });
  parallel_for(tasks, [&](std::size_t task) {
    const int first_row = int(task) * depth_height / int(tasks),
              end_row = (int(task) + 1) * depth_height / int(tasks);
    for (const std::vector<ScreenTriangle>& list : projected_)
      for (const ScreenTriangle& triangle : list) rasterise(triangle, first_row, end_row);
  });
  take_farthest_of_neighbours();
}

bool OcclusionCuller::hides(const Bounds& box) const {
  if (farthest_.empty() || box.empty()) return false;
  glm::vec2 low{float(depth_width), float(depth_height)}, high{-1.0f, -1.0f};
  float nearest = 0.0f;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec4 p(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                      corner & 4 ? box.max.z : box.min.z, 1.0f);
    const glm::vec4 clip = clip_from_world_ * p;
    if (before_near_plane(clip) <= 0.0f) return false;
    const glm::vec3 screen = on_screen(clip);
    low = glm::min(low, glm::vec2(screen)), high = glm::max(high, glm::vec2(screen));
    nearest = std::max(nearest, screen.z);
  }
  const int x0 = std::max(int(std::floor(low.x)), 0), x1 = std::min(int(std::floor(high.x)), depth_width - 1);
  const int y0 = std::max(int(std::floor(low.y)), 0),
            y1 = std::min(int(std::floor(high.y)), depth_height - 1);
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x)
      if (farthest_[std::size_t(y) * std::size_t(depth_width) + std::size_t(x)] <= slack * nearest)
        return false;
  return true;
}

}  // namespace parvis::render
