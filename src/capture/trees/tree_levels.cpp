// A coarse billboard's texel is the over of what the finer billboards show along the rays from the photograph
// through it. Past the thesis, which names levels of detail in the hierarchy as future work (section 4.8).
#include "capture/trees/tree_levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/colour.h"
#include "base/parallel.h"
#include "capture/trees/billboard_math.h"
#include "capture/trees/cell_order.h"
#include "capture/trees/trunk_light.h"

namespace parvis::trees {
namespace {

constexpr int max_level_texels_per_side = 128;
constexpr float off_middle = 0.25f;    // of the box's diagonal: where a tree's leaves are, in the mean
constexpr float ground_share = 0.06f;  // of the height: what of the tree is near the ground

/// Cells of a coarser grid and the finer cells that each stands for.
struct Parents {
  std::vector<glm::u16vec3> cells;
  std::vector<std::vector<std::uint32_t>> parts;
};

Parents parents_of(const CellGrid& grid) {
  std::map<std::array<int, 3>, std::vector<std::uint32_t>> by_place;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const glm::ivec3 place = glm::ivec3(grid.cells()[i]) / grid.branching();
    by_place[{place.z, place.y, place.x}].push_back(std::uint32_t(i));
  }
  Parents result;
  for (auto& [place, parts] : by_place) {
    result.cells.emplace_back(place[2], place[1], place[0]);
    result.parts.push_back(std::move(parts));
  }
  return result;
}

/// Extinction times volume adds up; colours by it.
glm::u8vec4 base_of(const BillboardTree& tree, const std::vector<std::uint32_t>& parts) {
  const int branching = tree.grid.branching();
  const float chord_m = mean_chord_m(tree.grid.cell_size_m());
  glm::vec3 colour(0.0f);
  float sum = 1e-6f;
  for (const std::uint32_t part : parts) {
    const glm::vec4 base = glm::vec4(tree.base[part]) / 255.0f;
    const float depth = -std::log(1.0f - std::min(base.w, 0.998f));
    colour += depth * linear_from_srgb(glm::vec3(base)), sum += depth;
  }
  const float extinction_per_m = sum / (chord_m * float(branching * branching * branching));
  const float alpha = 1.0f - std::exp(-extinction_per_m * chord_m * float(branching));
  return glm::u8vec4(glm::round(255.0f * glm::vec4(srgb_from_linear(colour / sum), alpha)));
}

/// Draws the parts of one coarse cell into its texture, as one photograph sees them.
class PartsPicture {
 public:
  /// `samples_per_side` of a texel.
  PartsPicture(const BillboardTree& fine, const BillboardTextures& view, int samples_per_side)
      : fine_(fine), view_(view), samples_per_side_(samples_per_side) {}

  /// `parts` from front to back. False: the photograph sees none of them.
  bool draw(glm::vec3 centre, glm::vec3 cell_size_m, const std::vector<std::uint32_t>& parts, int side,
            std::vector<std::uint8_t>& texels) {
    const glm::vec3 eye = view_.camera.position_in_world;
    const BillboardFrame whole = billboard_frame(centre, cell_size_m, eye);
    frames_.clear();
    bool is_seen = false;
    for (const std::uint32_t part : parts) {
      frames_.push_back(billboard_frame(fine_.grid.centre(part), fine_.grid.cell_size_m(), eye));
      is_seen |= view_.texture_of_cell[part] >= 0;
    }
    if (!is_seen) return false;
    const int samples_per_side = samples_per_side_, fine_side = side * samples_per_side;
    for (int v = 0; v < side; ++v)
      for (int u = 0; u < side; ++u) {
        glm::vec4 sum(0.0f);
        for (int s = 0; s < samples_per_side * samples_per_side; ++s) {
          const int row = s / samples_per_side;
          const glm::vec2 at(float(u * samples_per_side + s % samples_per_side) + 0.5f,
                             float(v * samples_per_side + row) + 0.5f);
          glm::vec2 place(2.0f * at.x / float(fine_side) - 1.0f, 1.0f - 2.0f * at.y / float(fine_side));
          place /= std::max(display::silhouette_reach(place, whole.slants) / 0.99f, 1.0f);
          const glm::vec2 m = place * whole.half_size_m;
          sum += along(eye, glm::normalize(centre + m.x * whole.right + m.y * whole.up - eye), parts);
        }
        sum /= float(samples_per_side * samples_per_side);
        if (sum.w > 0.0f) sum = glm::vec4(srgb_from_linear(glm::vec3(sum) / sum.w), sum.w);
        const glm::vec4 bytes = glm::round(255.0f * glm::clamp(sum, 0.0f, 1.0f));
        for (int c = 0; c < 4; ++c) texels.push_back(std::uint8_t(bytes[c]));
      }
    return true;
  }

 private:
  glm::vec4 along(glm::vec3 eye, glm::vec3 direction, const std::vector<std::uint32_t>& parts) const {
    glm::vec4 sum(0.0f);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const BillboardFrame& f = frames_[i];
      const glm::vec3 from_eye = fine_.grid.centre(parts[i]) - eye;
      const glm::vec3 off =
          direction * (glm::dot(from_eye, f.to_eye) / glm::dot(direction, f.to_eye)) - from_eye;
      const glm::vec2 place = glm::vec2(glm::dot(off, f.right), glm::dot(off, f.up)) / f.half_size_m;
      if (display::silhouette_reach(place, f.slants) > 1.0f) continue;
      sum += (1.0f - sum.w) * texture_colour(fine_, view_, parts[i], place);
    }
    return sum;
  }

  const BillboardTree& fine_;
  const BillboardTextures& view_;
  int samples_per_side_;
  std::vector<BillboardFrame> frames_;
};

BillboardTextures coarser_view(const BillboardTree& fine, const BillboardTree& coarse, const Parents& parents,
                               const BillboardTextures& view) {
  BillboardTextures result{view.camera, std::vector<std::int32_t>(coarse.grid.size(), -1), {}};
  std::vector<std::uint32_t> order, rank(fine.grid.size());
  CellOrder().back_to_front(fine.grid, view.camera.position_in_world, order);
  for (std::size_t i = 0; i < order.size(); ++i) rank[order[i]] = std::uint32_t(order.size() - i);
  // A texel as wide as those that it is drawn from has their detail in its middle.
  const bool is_as_fine = coarse.texels_per_side == fine.grid.branching() * fine.texels_per_side;
  PartsPicture picture(fine, view, is_as_fine ? 1 : 2);
  std::int32_t next = 0;
  for (std::size_t cell = 0; cell < coarse.grid.size(); ++cell) {
    std::vector<std::uint32_t> parts = parents.parts[cell];
    std::ranges::sort(parts, {}, [&](std::uint32_t part) { return rank[part]; });
    if (picture.draw(coarse.grid.centre(cell), coarse.grid.cell_size_m(), parts, coarse.texels_per_side,
                     result.texels))
      result.texture_of_cell[cell] = next++;
  }
  return result;
}

/// The middle of what stands near the ground, weighed by opacity.
glm::vec3 foot_of(const BillboardTree& tree) {
  float lowest = tree.grid.box().max.z, highest = tree.grid.box().min.z;
  for (std::size_t i = 0; i < tree.grid.size(); ++i) {
    const float z = tree.grid.centre(i).z;
    lowest = std::min(lowest, z), highest = std::max(highest, z);
  }
  glm::vec3 sum(0.0f);
  float weight = 1e-6f;
  for (std::size_t i = 0; i < tree.grid.size(); ++i) {
    const glm::vec3 centre = tree.grid.centre(i);
    if (centre.z > lowest + ground_share * (highest - lowest)) continue;
    sum += float(tree.base[i].w) * centre, weight += float(tree.base[i].w);
  }
  return {sum.x / weight, sum.y / weight, lowest - 0.5f * tree.grid.cell_size_m().z};
}

float longest_edge(const CellGrid& grid) {
  const glm::vec3 size = grid.cell_size_m();
  return std::max({size.x, size.y, size.z});
}

}  // namespace

BillboardTree coarser(const BillboardTree& tree) {
  const int branching = tree.grid.branching();
  const Parents parents = parents_of(tree.grid);
  BillboardTree result;
  result.grid = CellGrid(tree.grid.box(), branching, tree.grid.side() / branching, parents.cells);
  result.light = tree.light;
  result.texels_per_side = std::min(branching * tree.texels_per_side, max_level_texels_per_side);
  for (const auto& parts : parents.parts) result.base.push_back(base_of(tree, parts));
  result.views.resize(tree.views.size());
  parallel_for(tree.views.size(),
               [&](std::size_t v) { result.views[v] = coarser_view(tree, result, parents, tree.views[v]); });
  return result;
}

TreeLevels levels_of(BillboardTree tree) {
  TreeLevels result;
  result.box = tree.grid.box(), result.foot = foot_of(tree);
  if (tree.trunk) {
    result.foot = tree.trunk->trunk.rings.front().centre;
    result.trunk = std::make_shared<const scene::Model>(
        model_of(TrunkShape{tree.trunk->trunk, bark_albedo(*tree.trunk, tree)}));
  }
  result.levels.push_back(std::move(tree));
  while (result.levels.back().grid.size() > 1 && result.levels.back().grid.side() > 1)
    result.levels.push_back(coarser(result.levels.back()));
  result.crown = crown_light(result.levels);
  result.detail = leaf_detail(result.levels.front());
  return result;
}

float texel_size_m(const BillboardTree& tree) {
  return longest_edge(tree.grid) / float(tree.texels_per_side);
}

float parallax(const BillboardTree& tree, glm::vec3 eye) {
  const glm::vec3 middle = tree.grid.box().centre();
  const float distance_m = std::max(glm::distance(eye, middle), 1e-3f);
  const glm::vec3 to_eye = (eye - middle) / distance_m;
  const float off_m = off_middle * glm::length(tree.grid.box().size());
  const ClosestViews closest = closest_views(tree, middle, to_eye);
  float squares = 0.0f;
  for (std::size_t i = 0; i < 2; ++i) {
    const glm::vec3 offset = tree.views[std::size_t(closest.views[i])].camera.position_in_world - middle;
    const float camera_m = std::max(glm::length(offset), 1e-3f);
    const float sine =
        glm::dot(to_eye, offset) > 0.0f ? glm::length(glm::cross(to_eye, offset)) / camera_m : 1.0f;
    const float perspective = off_m * (1.0f / distance_m - 1.0f / camera_m);
    squares += closest.weights[i] * (sine * sine + perspective * perspective);
  }
  return std::sqrt(squares);
}

std::size_t level_for(const TreeLevels& tree, const SeenTree& seen, const DetailLimits& limits) {
  std::size_t level = 0;
  while (level + 1 < tree.levels.size()) {
    const BillboardTree& next = tree.levels[level + 1];
    const float texel_pixels = texel_size_m(next) * seen.pixels_per_metre;
    const bool is_as_fine = texel_size_m(next) <= 1.001f * texel_size_m(tree.levels.front());
    const bool is_as_sharp = texel_pixels <= limits.max_texel_pixels ||
                             (is_as_fine && texel_pixels <= limits.max_drawn_texel_pixels);
    const float shift_pixels = 0.5f * longest_edge(next.grid) * seen.parallax * seen.pixels_per_metre;
    if (!(is_as_sharp && shift_pixels <= limits.max_shift_pixels)) break;
    ++level;
  }
  return level;
}

}  // namespace parvis::trees
