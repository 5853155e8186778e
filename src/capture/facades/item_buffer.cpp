#include "capture/facades/item_buffer.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <mutex>
#include <span>

#include "base/parallel.h"

namespace parvis::facades {
namespace {

constexpr double near_over_size = 1e-6;
constexpr int rows_per_band = 16;  ///< work of one task

/// A triangle in the view: its outline in pixels (clipped at the near plane) and its plane.
struct Drawn {
  std::array<glm::dvec2, 4> outline;
  int corners = 0;
  glm::dvec3 normal;  ///< in the camera's frame, not unit; dot(normal, X) = offset on the plane
  double offset = 0.0;
  double min_depth = 0.0, max_depth = 0.0;
  std::uint32_t triangle = 0;
  bool is_back_face = false;
};

/// Where the edge from a to b crosses z = near. The same bits for both triangles of an edge, whichever way
/// they run it.
glm::dvec3 crossing(glm::dvec3 a, glm::dvec3 b, double near) {
  if (std::tie(b.x, b.y, b.z) < std::tie(a.x, a.y, a.z)) std::swap(a, b);
  glm::dvec3 p = a + (near - a.z) / (b.z - a.z) * (b - a);
  p.z = near;
  return p;
}

bool project(const LayerTriangle& triangle, const View& view, double near, Drawn& drawn) {
  std::array<glm::dvec3, 3> p;
  for (std::size_t k = 0; k < 3; ++k) p[k] = view.to_camera(triangle.corners[k]);
  drawn.corners = 0;
  drawn.min_depth = std::numeric_limits<double>::max(), drawn.max_depth = 0.0;
  const auto add = [&](const glm::dvec3& corner) {
    drawn.outline[std::size_t(drawn.corners++)] = view.to_pixel(corner);
    drawn.min_depth = std::min(drawn.min_depth, corner.z),
    drawn.max_depth = std::max(drawn.max_depth, corner.z);
  };
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec3 &a = p[k], &b = p[(k + 1) % 3];
    if (a.z >= near) add(a);
    if ((a.z >= near) != (b.z >= near)) add(crossing(a, b, near));
  }
  if (drawn.corners < 3) return false;
  drawn.normal = glm::cross(p[1] - p[0], p[2] - p[0]);
  drawn.offset = glm::dot(drawn.normal, p[0]);
  drawn.is_back_face = drawn.offset > 0.0;  // the eye, at 0, lies behind a plane that faces away from it
  return true;
}

/// Twice the area left of the edge a-b at p; exactly the opposite for b-a.
double side(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p) {
  const bool is_swapped = std::tie(b.x, b.y) < std::tie(a.x, a.y);
  const glm::dvec2 &from = is_swapped ? b : a, &to = is_swapped ? a : b;
  const double value = (to.x - from.x) * (p.y - from.y) - (to.y - from.y) * (p.x - from.x);
  return is_swapped ? -value : value;
}

/// Exactly one of two triangles with a common edge owns a centre on it.
bool owns_edge(const glm::dvec2& a, const glm::dvec2& b) { return a.y < b.y || (a.y == b.y && a.x < b.x); }

/// Covers the outline p? It is convex; `turn` is +1 or -1 as it runs.
bool covers(const Drawn& drawn, double turn, const glm::dvec2& p) {
  for (int k = 0; k < drawn.corners; ++k) {
    glm::dvec2 a = drawn.outline[std::size_t(k)], b = drawn.outline[std::size_t((k + 1) % drawn.corners)];
    if (turn < 0.0) std::swap(a, b);
    if (a == b) continue;
    const double s = side(a, b, p);
    if (s < 0.0 || (s == 0.0 && !owns_edge(a, b))) return false;
  }
  return true;
}

double turn_of(const Drawn& drawn) {
  double area = 0.0;
  for (int k = 2; k < drawn.corners; ++k) {
    const glm::dvec2 u = drawn.outline[std::size_t(k - 1)] - drawn.outline[0];
    const glm::dvec2 v = drawn.outline[std::size_t(k)] - drawn.outline[0];
    area += u.x * v.y - u.y * v.x;
  }
  return area > 0.0 ? 1.0 : area < 0.0 ? -1.0 : 0.0;
}

/// Columns of row y whose centres may be covered: [first, end).
std::pair<int, int> columns(const Drawn& drawn, double y, int width) {
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
  for (int k = 0; k < drawn.corners; ++k) {
    const glm::dvec2 a = drawn.outline[std::size_t(k)],
                     b = drawn.outline[std::size_t((k + 1) % drawn.corners)];
    if ((a.y < y && b.y < y) || (a.y > y && b.y > y)) continue;
    if (a.y == b.y) {
      low = std::min({low, a.x, b.x}), high = std::max({high, a.x, b.x});
    } else {
      const double x = a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
      low = std::min(low, x), high = std::max(high, x);
    }
  }
  if (low > high) return {0, 0};
  // A pixel more on each side than the crossings say: what is covered is decided by the edges alone.
  const double first = std::clamp(low - 1.5, 0.0, double(width)),
               end = std::clamp(high + 1.5, 0.0, double(width));
  return {int(first), int(std::ceil(end))};
}

/// s before t where their depths tie.
bool ties_before(const LayerModel& model, const View& view, std::uint32_t s, std::uint32_t t) {
  if (t < s) return !ties_before(model, view, t, s);
  const auto on_viewers_side = [&](std::uint32_t of, std::uint32_t plane) {
    const auto& c = model.triangles[plane].corners;
    const auto& o = model.triangles[of].corners;
    const glm::dvec3 normal = glm::normalize(glm::cross(c[1] - c[0], c[2] - c[0]));
    const double eye = glm::dot(normal, view.centre - c[0]);
    const double distance = glm::dot(normal, (o[0] + o[1] + o[2]) / 3.0 - c[0]) * (eye < 0.0 ? -1.0 : 1.0);
    const double tolerance = 4.0 * depth_tie * glm::distance(view.centre, c[0]);
    return distance > tolerance ? 1 : distance < -tolerance ? -1 : 0;
  };
  if (const int nearer = on_viewers_side(s, t)) return nearer > 0;
  if (const int nearer = on_viewers_side(t, s)) return nearer < 0;
  return true;
}

/// Nearest first; runs of ties by the rule between pairs.
void sort_stack(const LayerModel& model, const View& view, std::span<Fragment> stack) {
  std::ranges::sort(stack, [](const Fragment& a, const Fragment& b) {
    return std::tie(a.depth, a.triangle) < std::tie(b.depth, b.triangle);
  });
  for (std::size_t i = 1; i < stack.size();
       ++i)  // insertion, so that a fragment passes only those that it ties with
    for (std::size_t k = i; k > 0 && stack[k].depth - stack[k - 1].depth <= depth_tie * stack[k].depth &&
                            ties_before(model, view, stack[k].triangle, stack[k - 1].triangle);
         --k)
      std::swap(stack[k], stack[k - 1]);
}

struct BandFragment {
  std::uint32_t pixel;  ///< in its band
  Fragment fragment;
};

void rasterise(const Drawn& drawn, const View& view, int first_row, int end_row,
               std::vector<BandFragment>& found) {
  const double turn = turn_of(drawn);
  if (turn == 0.0) return;
  double top = std::numeric_limits<double>::max(), bottom = std::numeric_limits<double>::lowest();
  for (int k = 0; k < drawn.corners; ++k) {
    top = std::min(top, drawn.outline[std::size_t(k)].y);
    bottom = std::max(bottom, drawn.outline[std::size_t(k)].y);
  }
  const int from = int(std::clamp(top - 1.0, double(first_row), double(end_row)));
  const int to = int(std::clamp(bottom + 1.0, double(first_row), double(end_row)));
  for (int y = from; y < to; ++y) {
    const auto [first, end] = columns(drawn, y + 0.5, view.width);
    for (int x = first; x < end; ++x) {
      const glm::dvec2 p(x + 0.5, y + 0.5);
      if (!covers(drawn, turn, p)) continue;
      const double slope = glm::dot(drawn.normal, view.ray_in_camera(p));
      // Seen edge-on the plane is crossed anywhere: the depth stays within the triangle's own.
      const double depth =
          slope == 0.0 ? drawn.min_depth : std::clamp(drawn.offset / slope, drawn.min_depth, drawn.max_depth);
      found.push_back(
          {std::uint32_t((y - first_row) * view.width + x), {depth, drawn.triangle, drawn.is_back_face}});
    }
  }
}

}  // namespace

void visit_stacks(const LayerModel& model, const View& view, bool with_back_faces,
                  std::span<const std::uint32_t> triangles,
                  const std::function<void(int x, int y, std::span<const Fragment>)>& visit) {
  const double near = near_over_size * std::max(model.size(), std::numeric_limits<double>::min());
  const std::size_t count = triangles.empty() ? model.triangles.size() : triangles.size();
  const int bands = (view.height + rows_per_band - 1) / rows_per_band;
  std::vector<Drawn> drawn;
  std::vector<std::vector<std::uint32_t>> in_band(std::size_t(std::max(bands, 0)));
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t t = triangles.empty() ? std::uint32_t(i) : triangles[i];
    Drawn one;
    if (!project(model.triangles[t], view, near, one)) continue;
    one.triangle = t;
    one.is_back_face = one.is_back_face && model.objects[model.triangles[t].object].is_closed;
    if (one.is_back_face && !with_back_faces) continue;
    double top = view.height, bottom = 0.0, left = view.width, right = 0.0;
    for (int k = 0; k < one.corners; ++k) {
      const glm::dvec2& p = one.outline[std::size_t(k)];
      top = std::min(top, p.y), bottom = std::max(bottom, p.y), left = std::min(left, p.x),
      right = std::max(right, p.x);
    }
    if (!(top < view.height && bottom > 0.0 && left < view.width && right > 0.0)) continue;
    const int first = int(std::max(top - 1.0, 0.0)) / rows_per_band;
    const int last = std::min(int(std::min(bottom + 1.0, double(view.height))) / rows_per_band, bands - 1);
    for (int band = first; band <= last; ++band)
      in_band[std::size_t(band)].push_back(std::uint32_t(drawn.size()));
    drawn.push_back(one);
  }
  parallel_for(in_band.size(), [&](std::size_t band) {
    const int first_row = int(band) * rows_per_band,
              end_row = std::min(first_row + rows_per_band, view.height);
    std::vector<BandFragment> found;
    for (const std::uint32_t i : in_band[band]) rasterise(drawn[i], view, first_row, end_row, found);
    // Counting sort by pixel, then each stack by depth.
    std::vector<std::uint32_t> starts(std::size_t(end_row - first_row) * std::size_t(view.width) + 1, 0);
    for (const BandFragment& f : found) ++starts[f.pixel + 1];
    for (std::size_t i = 1; i < starts.size(); ++i) starts[i] += starts[i - 1];
    std::vector<Fragment> sorted(found.size());
    std::vector<std::uint32_t> next(starts.begin(), starts.end() - 1);
    for (const BandFragment& f : found) sorted[next[f.pixel]++] = f.fragment;
    for (std::size_t pixel = 0; pixel + 1 < starts.size(); ++pixel) {
      const std::span<Fragment> stack(sorted.data() + starts[pixel], starts[pixel + 1] - starts[pixel]);
      if (stack.empty()) continue;
      sort_stack(model, view, stack);
      visit(int(pixel) % view.width, first_row + int(pixel) / view.width, stack);
    }
  });
}

bool has_layer_pixel(const LayerModel& model, const Fragment& fragment, std::span<const Fragment> stack) {
  const std::uint32_t number = model.triangles[fragment.triangle].object;
  const LayerObject& object = model.objects[number];
  if (object.is_backdrop) return &fragment == &stack.front();
  if (!object.is_dense) return true;
  for (const Fragment& before : stack) {
    if (&before == &fragment) break;
    if (model.triangles[before.triangle].object == number) return false;
  }
  return true;
}

ItemBuffer item_buffer(const LayerModel& model, const View& view) {
  ItemBuffer buffer{view.width, view.height, {}, {}};
  const std::size_t pixels = std::size_t(view.width) * std::size_t(view.height);
  buffer.triangles.assign(pixels, no_triangle_seen);
  buffer.depths.assign(pixels, std::numeric_limits<float>::infinity());
  visit_stacks(model, view, false, {}, [&](int x, int y, std::span<const Fragment> stack) {
    buffer.triangles[buffer.index(x, y)] = stack.front().triangle;
    buffer.depths[buffer.index(x, y)] = float(stack.front().depth);
  });
  return buffer;
}

int object_around(const LayerModel& model, const View& view) {
  std::mutex mutex;
  std::map<std::uint32_t, std::size_t> backs;
  std::atomic<std::size_t> seen{0}, from_inside{0};
  visit_stacks(model, view, true, {}, [&](int, int, std::span<const Fragment> stack) {
    ++seen;
    if (!stack.front().is_back_face) return;
    ++from_inside;
    const std::lock_guard lock(mutex);
    ++backs[model.triangles[stack.front().triangle].object];
  });
  if (2 * from_inside <= seen) return -1;
  return int(std::ranges::max_element(backs, {}, [](const auto& entry) { return entry.second; })->first);
}

}  // namespace parvis::facades
