#include "places/dressing/town_ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/bounds.h"
#include "base/cut_polygon.h"
#include "land/heights/ground_raster.h"
#include "places/dressing/ground_cover.h"
#include "scene/data/model_parts.h"

namespace parvis::dressing {
namespace {

using glm::vec2, glm::vec3;

constexpr float finest_density_cell_m = 2.0f, max_density_cells = 4e6f;
constexpr float dense = 0.3f;      // of the ground below roofs: from here on it is paved
constexpr float spread_m = 22.0f;  // standard deviation of the weights of what is built around a place
constexpr float piece_m = 6.0f;    // of the ground along the edge: the edge is straight across it
constexpr int max_divisions = 60;  // of a triangle across the whole earth

/// The fraction of the ground below roofs about each place, less `dense`.
class Density {
 public:
  explicit Density(const scene::Model& model) {
    const std::vector<glm::mat4> pose = scene::rest_pose(model);
    const auto is_roof = [](const scene::Part& part) { return part.object.starts_with("RoofSurface"); };
    Bounds bounds;
    for (const scene::Part& part : model.parts)
      if (is_roof(part)) bounds.add(transformed(pose[std::size_t(part.node)], part.mesh.bounds()));
    if (bounds.empty()) return;
    const vec2 size = vec2(bounds.size()) + 6.0f * spread_m;
    const float cell_m = std::max(finest_density_cell_m, std::sqrt(size.x * size.y / max_density_cells));
    const glm::ivec2 cells = glm::ivec2(glm::ceil(size / cell_m)) + 1;
    built_ = {cells.x, cells.y, cell_m, vec2(bounds.min) - 3.0f * spread_m, 0.0f};
    for (const scene::Part& part : model.parts) {
      if (!is_roof(part)) continue;
      const auto corner = [&](std::size_t i) {
        return vec3(pose[std::size_t(part.node)] *
                    glm::vec4(part.mesh.positions[part.mesh.indices[i]], 1.0f));
      };
      for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3) {
        const std::vector<std::vector<vec3>> rings{{corner(i), corner(i + 1), corner(i + 2)}};
        for (const glm::ivec2 cell : scene::cells_inside(built_, rings)) built_.at(cell.x, cell.y) = 1.0f;
      }
    }
    // Three means over squares are nearly a Gaussian of this deviation (their variances add up).
    const int reach = std::max(1, int(spread_m / cell_m - 0.5f));
    for (int pass = 0; pass < 3; ++pass) average(reach);
    count_dense();
  }

  /// Positive on ground to be paved.
  float at(vec2 point) const {
    const vec2 place = (point - built_.origin) / built_.cell_m - 0.5f;
    if (!(place.x >= 0.0f && place.y >= 0.0f && place.x < float(built_.width - 1) &&
          place.y < float(built_.height - 1)))
      return -dense;
    const glm::ivec2 low(place);
    const vec2 fraction = place - vec2(low);
    return glm::mix(glm::mix(built_.at(low.x, low.y), built_.at(low.x + 1, low.y), fraction.x),
                    glm::mix(built_.at(low.x, low.y + 1), built_.at(low.x + 1, low.y + 1), fraction.x),
                    fraction.y) -
           dense;
  }

  /// False where the edge of what is paved may run through a box.
  bool is_uniform(vec2 low, vec2 high) const {
    const vec2 size(built_.width, built_.height);
    const glm::ivec2 first(glm::clamp((low - built_.origin) / built_.cell_m - 1.5f, vec2(0.0f), size)),
        end(glm::clamp((high - built_.origin) / built_.cell_m + 1.5f, vec2(0.0f), size));
    const auto before = [&](int x, int y) {
      return dense_[std::size_t(y) * std::size_t(built_.width + 1) + x];
    };
    if (dense_.empty()) return true;
    const int count =
        before(end.x, end.y) - before(first.x, end.y) - before(end.x, first.y) + before(first.x, first.y);
    return count == 0 || count == (end.x - first.x) * (end.y - first.y);
  }

 private:
  /// Gives each cell the mean of the cells up to `reach` away, first along rows, then along columns.
  void average(int reach) {
    const auto along = [&](int lines, int length, auto&& at) {
      std::vector<float> sums(std::size_t(length) + 1, 0.0f);
      for (int line = 0; line < lines; ++line) {
        for (int i = 0; i < length; ++i) sums[std::size_t(i) + 1] = sums[std::size_t(i)] + at(line, i);
        for (int i = 0; i < length; ++i) {
          const int first = std::max(i - reach, 0), end = std::min(i + reach + 1, length);
          at(line, i) = (sums[std::size_t(end)] - sums[std::size_t(first)]) / float(2 * reach + 1);
        }
      }
    };
    along(built_.height, built_.width, [&](int y, int x) -> float& { return built_.at(x, y); });
    along(built_.width, built_.height, [&](int x, int y) -> float& { return built_.at(x, y); });
  }

  /// A table of sums (Crow 1984) of the cells that are dense.
  void count_dense() {
    const std::size_t row = std::size_t(built_.width) + 1;
    dense_.assign(row * (std::size_t(built_.height) + 1), 0);
    for (int y = 0; y < built_.height; ++y)
      for (int x = 0; x < built_.width; ++x) {
        const std::size_t here = (std::size_t(y) + 1) * row + std::size_t(x) + 1;
        dense_[here] =
            dense_[here - 1] + dense_[here - row] - dense_[here - row - 1] + int(built_.at(x, y) > dense);
      }
  }

  scene::GroundRaster<float> built_;
  std::vector<int> dense_;
};

/// A corner of a triangle of ground.
struct GroundCorner {
  vec3 in_node, normal;
  vec2 plan;  ///< in the model's frame
  float density;
};

GroundCorner mix(const GroundCorner& a, const GroundCorner& b, float weight) {
  return {glm::mix(a.in_node, b.in_node, weight), glm::mix(a.normal, b.normal, weight),
          glm::mix(a.plan, b.plan, weight), glm::mix(a.density, b.density, weight)};
}

/// Divides the triangles of one part.
class GroundDivision {
 public:
  explicit GroundDivision(const Density& density) : density_(density) {}

  void add(const scene::Part& part, const glm::mat4& model_from_node) {
    const auto corner = [&](std::size_t i) {
      const std::uint32_t index = part.mesh.indices[i];
      const vec3 position = part.mesh.positions[index];
      const vec2 plan(model_from_node * glm::vec4(position, 1.0f));
      return GroundCorner{position, part.mesh.normals[index], plan, density_.at(plan)};
    };
    for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3)
      divide({corner(i), corner(i + 1), corner(i + 2)}, 0);
  }

  Mesh paved, lawn;

 private:
  using Triangle = std::array<GroundCorner, 3>;

  void divide(const Triangle& t, int depth) {
    const auto& [a, b, c] = t;
    constexpr float farthest_m = 1e9f;  // beyond it, and of what is no number, nothing is divided
    const bool is_usable = std::ranges::all_of(t, [](const GroundCorner& corner) {
      return std::abs(corner.plan.x) < farthest_m && std::abs(corner.plan.y) < farthest_m;
    });
    const bool is_uniform = !is_usable || density_.is_uniform(glm::min(a.plan, glm::min(b.plan, c.plan)),
                                                              glm::max(a.plan, glm::max(b.plan, c.plan)));
    if (is_uniform || depth == max_divisions)
      return append({t.begin(), t.end()},
                    density_.at((a.plan + b.plan + c.plan) / 3.0f) > 0.0f ? paved : lawn);
    std::size_t longest = 0;
    float longest_side_m = 0.0f;
    for (std::size_t k = 0; k < 3; ++k)
      if (const float length_m = glm::distance(t[k].plan, t[(k + 1) % 3].plan); length_m > longest_side_m)
        longest = k, longest_side_m = length_m;
    if (longest_side_m > piece_m) {
      const GroundCorner &from = t[longest], &to = t[(longest + 1) % 3], &other = t[(longest + 2) % 3];
      GroundCorner middle = mix(from, to, 0.5f);
      middle.density = density_.at(middle.plan);
      divide({from, middle, other}, depth + 1);
      divide({middle, to, other}, depth + 1);
      return;
    }
    append(cut(std::vector(t.begin(), t.end()), [](const GroundCorner& p) { return p.density; }), paved);
    append(cut(std::vector(t.begin(), t.end()), [](const GroundCorner& p) { return -p.density; }), lawn);
  }

  static void append(const std::vector<GroundCorner>& polygon, Mesh& mesh) {
    const auto first = std::uint32_t(mesh.positions.size());
    for (const GroundCorner& corner : polygon) {
      mesh.positions.push_back(corner.in_node);
      const float length = glm::length(corner.normal);
      mesh.normals.push_back(length > 0.0f ? corner.normal / length : vec3(0.0f, 0.0f, 1.0f));
      mesh.uvs.emplace_back(corner.plan.x, -corner.plan.y);
    }
    for (std::uint32_t i = 2; i < polygon.size(); ++i)
      mesh.indices.insert(mesh.indices.end(), {first, first + i - 1, first + i});
  }

  const Density& density_;
};

}  // namespace

std::size_t add_town_ground(scene::Model& model, std::string_view target) {
  const std::vector<std::size_t> parts = scene::matching_parts(model, target);
  if (parts.empty()) return 0;
  const Density density(model);
  const std::vector<glm::mat4> pose = scene::rest_pose(model);
  int paving = scene::no_index, lawn = scene::no_index;  // materials
  for (const std::size_t index : parts) {
    GroundDivision division(density);
    if (model.parts[index].mesh.normals.size() != model.parts[index].mesh.positions.size())
      fill_normals(model.parts[index].mesh);
    division.add(model.parts[index], pose[std::size_t(model.parts[index].node)]);
    for (const auto& [cover, mesh] : {std::pair{"paving", &division.paved}, {"lawn", &division.lawn}}) {
      if (mesh->indices.empty()) continue;
      for (vec2& uv : mesh->uvs) uv /= cover_sheet_m(cover);
      scene::Part part = model.parts[index];
      part.mesh = std::move(*mesh);
      model.parts.push_back(std::move(part));
      int& material = cover == std::string_view("paving") ? paving : lawn;
      if (material == scene::no_index) material = add_cover_material(model, cover);
      model.parts.back().material = material;
    }
    model.parts[index].mesh = {};
  }
  std::erase_if(model.parts, [](const scene::Part& part) { return part.mesh.indices.empty(); });
  return parts.size();
}

}  // namespace parvis::dressing
