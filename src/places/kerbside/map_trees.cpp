#include "places/kerbside/map_trees.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <optional>

#include "base/bounds.h"
#include "base/disjoint_sets.h"
#include "scene/data/model_parts.h"

namespace parvis::kerbside {
namespace {

constexpr float same_point_m = 0.01f;

struct Genus {
  std::string_view word;  ///< in lower case, of a name
  std::string_view kind;
};
constexpr std::array<Genus, 18> genera{{{"quercus", "oak"},
                                        {"oak", "oak"},
                                        {"platanus", "plane"},
                                        {"acer", "plane"},
                                        {"citrus", "orange"},
                                        {"orange", "orange"},
                                        {"pinus", "pine"},
                                        {"picea", "spruce"},
                                        {"spruce", "spruce"},
                                        {"abies", "spruce"},
                                        {"pseudotsuga", "spruce"},
                                        {"tsuga", "spruce"},
                                        {"cedrus", "spruce"},
                                        {"larix", "spruce"},
                                        {"cupressus", "spruce"},
                                        {"thuja", "spruce"},
                                        {"taxus", "spruce"},
                                        {"needleleaved", "spruce"}}};

/// Triangles that share corners.
struct Piece {
  Bounds bounds;
  std::size_t part;  ///< of the model

  glm::vec2 middle() const { return glm::vec2(bounds.centre()); }
  float width_m() const { return std::max(bounds.size().x, bounds.size().y); }
};

bool overlap_in_plan(const Bounds& a, const Bounds& b) {
  return glm::all(glm::lessThanEqual(glm::vec2(a.min), glm::vec2(b.max))) &&
         glm::all(glm::lessThanEqual(glm::vec2(b.min), glm::vec2(a.max)));
}

bool is_trunk_of(const Piece& low, const Piece& high) { return low.width_m() <= 0.5f * high.width_m(); }

/// Crowns of neighbours overlap, too, but the middles of trees are farther apart. The crown of a leaning
/// trunk stands aside, and begins above the trunk's foot, as no other tree does.
bool share_an_axis(const Piece& low, const Piece& high) {
  const bool is_crown =
      is_trunk_of(low, high) && high.bounds.min.z > low.bounds.min.z + 0.25f * low.bounds.size().z;
  const glm::vec2 wider = glm::max(glm::vec2(low.bounds.size()), glm::vec2(high.bounds.size()));
  return glm::all(
      glm::lessThanEqual(glm::abs(low.middle() - high.middle()), (is_crown ? 0.25f : 0.05f) * wider));
}

/// Pieces of each name by cells of the plan, of a size for each octave of their widths: what overlaps a piece
/// and is no narrower lies in a cell beside its own, of that size.
class PiecePlan {
 public:
  /// `model` and `pieces` must outlive it.
  PiecePlan(const scene::Model& model, const std::vector<Piece>& pieces) : pieces_(pieces) {
    std::map<std::string_view, int> names;
    for (const Piece& piece : pieces)
      names_.push_back(names.try_emplace(model.parts[piece.part].object, int(names.size())).first->second);
  }

  void add(std::size_t i) { cells_[names_[i]][octave(i)][cell_of(i, octave(i))].push_back(i); }

  /// Calls use(j) for the pieces that were added, of the same name and no narrower, that may overlap piece i.
  template <class Use>
  void each_near(std::size_t i, const Use& use) const {
    const auto named = cells_.find(names_[i]);
    if (named == cells_.end()) return;
    for (const auto& [octave, cells] : named->second)
      for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
          const std::pair<double, double> middle = cell_of(i, octave);
          const auto cell = cells.find({middle.first + x, middle.second + y});
          if (cell == cells.end()) continue;
          for (const std::size_t j : cell->second) use(j);
        }
  }

 private:
  using Cells = std::map<std::pair<double, double>, std::vector<std::size_t>>;

  int octave(std::size_t i) const { return int(std::ceil(std::log2(std::max(pieces_[i].width_m(), 1.0f)))); }
  std::pair<double, double> cell_of(std::size_t i, int octave) const {
    const glm::dvec2 cell = glm::floor(glm::dvec2(pieces_[i].middle()) / std::exp2(double(octave)));
    return {cell.x, cell.y};
  }

  const std::vector<Piece>& pieces_;
  std::vector<int> names_;
  std::map<int, std::map<int, Cells>> cells_;  // by name and octave
};

/// Calls use(i, j) for pieces of one name that overlap in plan; i stands lower. False where more pairs stand
/// so close than can be looked at.
template <class Use>
bool each_overlap(const scene::Model& model, const std::vector<Piece>& pieces, const Use& use) {
  std::vector<std::size_t> widest_first(pieces.size());
  std::iota(widest_first.begin(), widest_first.end(), std::size_t(0));
  std::ranges::stable_sort(widest_first, std::greater<>(),
                           [&](std::size_t i) { return pieces[i].width_m(); });
  PiecePlan plan(model, pieces);
  std::size_t pairs = 0;
  for (const std::size_t i : widest_first) {
    plan.each_near(i, [&](std::size_t j) {
      if (++pairs > max_tree_pairs || !overlap_in_plan(pieces[i].bounds, pieces[j].bounds)) return;
      pieces[i].bounds.min.z <= pieces[j].bounds.min.z ? use(i, j) : use(j, i);
    });
    if (pairs > max_tree_pairs) return false;
    plan.add(i);
  }
  return true;
}

/// One piece for each set of them, in the order of their roots.
template <class Root>
std::vector<Piece> merged(const std::vector<Piece>& pieces, const Root& root) {
  std::map<std::size_t, Piece> whole;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto [known, is_new] = whole.try_emplace(root(i), pieces[i]);
    if (!is_new) known->second.bounds.add(pieces[i].bounds);
  }
  std::vector<Piece> result;
  result.reserve(whole.size());
  for (const auto& [number, piece] : whole) result.push_back(piece);
  return result;
}

/// Which pieces are one tree. Nothing where too many are close to each other.
std::optional<DisjointSets> trees_of(const scene::Model& model, const std::vector<Piece>& pieces) {
  DisjointSets trees(pieces.size());
  std::vector<std::size_t> below(pieces.size());  // of what hangs: the nearest that it hangs above
  std::iota(below.begin(), below.end(), std::size_t(0));
  std::vector<bool> stands(pieces.size(), false);  // about the axis of something lower
  const bool is_done = each_overlap(model, pieces, [&](std::size_t low, std::size_t high) {
    if (share_an_axis(pieces[low], pieces[high])) trees.join(high, low), stands[high] = true;
    if (!is_trunk_of(pieces[low], pieces[high]) ||  // but a tree at the foot of a terrace
        pieces[high].bounds.min.z < pieces[low].bounds.centre().z)
      return;
    const auto away = [&](std::size_t i) { return glm::distance(pieces[i].middle(), pieces[high].middle()); };
    if (below[high] == high || away(low) < away(below[high])) below[high] = low;
  });
  if (!is_done) return std::nullopt;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    if (!stands[i]) trees.join(i, below[i]);
  return trees;
}

}  // namespace

Result<std::vector<MapTree>> take_trees(scene::Model& model, std::string_view target) {
  const std::vector<glm::mat4> pose = scene::rest_pose(model);
  TrianglesAtCorners joined(same_point_m);
  std::vector<Piece> triangles;
  for (const std::size_t index : scene::matching_parts(model, target)) {
    Mesh& mesh = model.parts[index].mesh;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      std::array<glm::vec3, 3> corners;
      Bounds bounds;
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::vec4 corner(mesh.positions[mesh.indices[i + k]], 1.0f);
        corners[k] = glm::vec3(pose[std::size_t(model.parts[index].node)] * corner);
        bounds.add(corners[k]);
      }
      joined.add(corners);
      triangles.push_back({bounds, index});
    }
    mesh.indices.clear();
  }
  std::vector<Piece> pieces = merged(triangles, [&](std::size_t triangle) { return joined.root(triangle); });
  if (pieces.size() > max_tree_pieces)
    return error(
        "what matches \"{}\" is {} pieces that do not touch each other; {} is the most of which trees "
        "are made: name fewer of them",
        target, pieces.size(), max_tree_pieces);
  std::optional<DisjointSets> trees = trees_of(model, pieces);
  if (!trees)
    return error(
        "what matches \"{}\" is {} pieces of which more than {} pairs stand close together; trees of a "
        "map stand beside each other: name fewer of them",
        target, pieces.size(), max_tree_pairs);
  pieces = merged(pieces, [&](std::size_t piece) { return trees->root(piece); });
  std::vector<MapTree> result;
  result.reserve(pieces.size());
  for (const auto& [bounds, part] : pieces)
    result.push_back(
        {glm::vec3(glm::vec2(bounds.centre()), bounds.min.z), bounds.size().z, model.parts[part].object});
  std::erase_if(model.parts, [](const scene::Part& part) { return part.mesh.indices.empty(); });
  return result;
}

std::string_view plant_kind_of(std::string_view name, std::string_view usual) {
  std::string lower(name);
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  for (const Genus& genus : genera)
    if (lower.find(genus.word) != std::string::npos) return genus.kind;
  return usual;
}

}  // namespace parvis::kerbside
