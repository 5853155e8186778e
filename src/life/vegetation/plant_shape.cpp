#include "life/vegetation/plant_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/random.h"
#include "life/vegetation/conifer.h"
#include "life/vegetation/leaf_order.h"
#include "scene/data/crown_openness.h"
#include "synthesis/tree_mesh.h"

namespace parvis::vegetation {
namespace {

using glm::vec3;
using synthesis::Branch;

constexpr int first_leafy_order = 2;
constexpr float stem_spacing_m = 0.3f;  // of a hedge

vec3 any_direction(Random& random) {
  const float z = random.uniform(-1.0f, 1.0f), turn = random.uniform(0.0f, 6.2831853f);
  const float across = std::sqrt(1.0f - z * z);
  return {across * std::cos(turn), across * std::sin(turn), z};
}

/// The part of `v` across `along`, unit.
vec3 across(vec3 v, vec3 along) {
  const vec3 rest = v - along * glm::dot(v, along);
  return glm::dot(rest, rest) > 1e-8f ? glm::normalize(rest)
                                      : glm::normalize(glm::cross(along, vec3(0.3f, 0.9f, 0.2f)));
}

Leaf leaf_at(vec3 foot, vec3 along, vec3 normal, float length_m, Random& random) {
  along = glm::normalize(along);
  // Shade and age: a few leaves are much lighter or darker than most.
  const float tint = 0.5f + 0.5f * random.uniform(-1.0f, 1.0f) * random.uniform();
  return {foot, along, across(normal, along), length_m, tint, 1.0f};
}

float depth_of_hedge(float height_m) { return std::min(0.75f * height_m, 0.9f); }

float surface_of_hedge(const PlantRecipe& recipe) {
  const float d = depth_of_hedge(recipe.height_m);
  return recipe.length_m * (2.0f * recipe.height_m + d) + 2.0f * d * recipe.height_m;
}

/// Number of leaves by the kind's density alone.
float natural_leaves(const PlantRecipe& recipe) {
  const PlantKind& kind = *recipe.kind;
  const float grown = recipe.height_m / kind.height_m;
  switch (kind.habit) {
    case Habit::tree:  // as the crown's surface, for leaves stay as large as they are
      return kind.leaves * grown * grown;
    case Habit::hedge:
      return kind.leaves * surface_of_hedge(recipe);
    case Habit::sward:
      return kind.leaves * recipe.length_m * recipe.length_m;
  }
  return 0.0f;
}

/// Mean length of a leaf: beyond max_tree_leaves the leaves of tall trees grow instead, so that their area is
/// kept.
float leaf_length_m(const PlantRecipe& recipe) {
  const float beyond = natural_leaves(recipe) / float(max_tree_leaves);
  const bool grows = recipe.kind->habit == Habit::tree && beyond > 1.0f;
  return recipe.kind->leaf_m * (grows ? std::sqrt(beyond) : 1.0f);
}

std::vector<Branch> grow_branches(const PlantRecipe& recipe, Random& random) {
  const PlantKind& kind = *recipe.kind;
  std::vector<Branch> branches;
  if (kind.habit == Habit::tree) {
    const synthesis::Species species{recipe.height_m, kind.trunk_share * recipe.height_m, kind.orders};
    branches = kind.grows_in_whorls ? grow_in_whorls(species, random) : synthesis::grow_tree(species, random);
  } else if (kind.habit == Habit::hedge) {
    const int stems = std::max(1, int(recipe.length_m / stem_spacing_m));
    for (int i = 0; i < stems; ++i) {
      Branch stem;
      vec3 point(recipe.length_m * ((float(i) + random.uniform()) / float(stems) - 0.5f), 0.0f, 0.0f);
      for (int k = 0; k <= 4; ++k) {
        stem.points.push_back(point);
        stem.radii_m.push_back(kind.trunk_share * recipe.height_m * (1.0f - 0.2f * float(k)));
        point += 0.22f * recipe.height_m * glm::normalize(vec3(0, 0, 1) + 0.5f * any_direction(random));
      }
      stem.order = 1;
      branches.push_back(std::move(stem));
    }
  }
  return branches;
}

void leaf_tree(PlantShape& shape, const std::vector<Branch>& branches, std::size_t count, Random& random) {
  std::vector<const Branch*> twigs;
  for (const Branch& branch : branches)
    if (branch.order >= first_leafy_order) twigs.push_back(&branch);
  const vec3 middle(0.0f, 0.0f, 0.5f * shape.recipe.height_m);
  const float mean_leaf_m = leaf_length_m(shape.recipe);
  for (std::size_t i = 0; i < count; ++i) {
    const Branch& twig = *twigs[i % twigs.size()];
    const float place = std::sqrt(random.uniform(0.03f, 1.0f)) * float(twig.points.size() - 1);
    const std::size_t k = std::min(std::size_t(place), twig.points.size() - 2);
    const vec3 axis = glm::normalize(twig.points[k + 1] - twig.points[k]);
    const vec3 side = across(any_direction(random), axis);
    const float length_m = mean_leaf_m * random.uniform(0.7f, 1.3f);
    // A stalk's length off the twig, so that leaves fill the space between twigs.
    const vec3 foot = glm::mix(twig.points[k], twig.points[k + 1], place - float(k)) +
                      length_m * random.uniform(0.15f, 0.9f) * side;
    const vec3 outward = glm::normalize(foot - middle + vec3(0, 0, 0.6f));
    const vec3 along = 0.5f * axis + 0.8f * side + 0.3f * any_direction(random) - vec3(0, 0, 0.25f);
    const vec3 normal = vec3(0, 0, 0.7f) + 0.5f * outward + 0.75f * any_direction(random);
    shape.leaves.push_back(leaf_at(foot, along, normal, length_m, random));
  }
}

/// A straight piece of wood that bears needles.
struct ShootBearer {
  vec3 from, to;
  bool is_leader;    ///< of the trunk: shoots all round it, else to both sides
  double end_m = 0;  ///< length of all up to here
};

/// The young wood: of a branch its outer part, of the trunk its top.
std::vector<ShootBearer> shoot_bearers(const std::vector<Branch>& branches, const PlantKind& kind) {
  const float bare_share = kind.leaf == LeafForm::tuft ? 0.4f : 0.0f;  // pines keep their needles for 3 years
  std::vector<ShootBearer> bearers;
  double sum_m = 0.0;
  for (const Branch& branch : branches) {
    const std::size_t pieces = branch.points.size() - 1;
    const bool is_trunk = branch.order == 0;
    const float bare = is_trunk ? 0.9f : branch.order == 1 ? std::max(bare_share, 0.5f) : bare_share;
    for (std::size_t k = std::size_t(bare * float(pieces)); k < pieces; ++k) {
      sum_m += double(glm::distance(branch.points[k], branch.points[k + 1]));
      bearers.push_back({branch.points[k], branch.points[k + 1], is_trunk, sum_m});
    }
  }
  return bearers;
}

/// Needles on the young wood, by its length. They lie along it.
void leaf_conifer(PlantShape& shape, const std::vector<Branch>& branches, std::size_t count, Random& random) {
  const std::vector<ShootBearer> bearers = shoot_bearers(branches, shape.kind());
  const float mean_leaf_m = leaf_length_m(shape.recipe);
  for (std::size_t i = 0; i < count; ++i) {
    const double place = (double(i) + double(random.uniform())) / double(count) * bearers.back().end_m;
    const auto found = std::ranges::lower_bound(bearers, place, {}, &ShootBearer::end_m);
    const ShootBearer& bearer = found == bearers.end() ? bearers.back() : *found;
    const vec3 axis = glm::normalize(bearer.to - bearer.from);
    const vec3 aside = bearer.is_leader
                           ? across(any_direction(random), axis)
                           : (random.chance(0.5f) ? 1.0f : -1.0f) * across(vec3(axis.y, -axis.x, 0.1f), axis);
    const vec3 foot = glm::mix(bearer.from, bearer.to, random.uniform());
    const vec3 along = axis + random.uniform(0.0f, 0.8f) * aside + 0.2f * any_direction(random);
    const vec3 normal = vec3(0, 0, 1) + 0.6f * any_direction(random);
    shape.leaves.push_back(leaf_at(foot, along, normal, mean_leaf_m * random.uniform(0.75f, 1.25f), random));
  }
}

/// Most leaves are near the clipped surface, where there is light.
void leaf_hedge(PlantShape& shape, std::size_t count, Random& random) {
  const PlantRecipe& recipe = shape.recipe;
  const vec3 half(0.5f * recipe.length_m, 0.5f * depth_of_hedge(recipe.height_m), 0.5f * recipe.height_m);
  const float front = half.x * half.z, end = half.y * half.z, top = half.x * half.y;
  for (std::size_t i = 0; i < count; ++i) {
    const float deep_m = 0.14f * random.uniform() * random.uniform();
    const float chosen = random.uniform(0.0f, 2.0f * front + 2.0f * end + top);
    vec3 at =
        half * vec3(random.uniform(-1.0f, 1.0f), random.uniform(-1.0f, 1.0f), random.uniform(-1.0f, 1.0f));
    vec3 outward(0.0f);
    const int axis = chosen < 2.0f * front ? 1 : chosen < 2.0f * (front + end) ? 0 : 2;
    outward[axis] = axis == 2 || random.chance(0.5f) ? 1.0f : -1.0f;
    at[axis] = outward[axis] * std::max(half[axis] - deep_m, 0.0f);
    at += 0.02f * any_direction(random);
    const vec3 along = 0.6f * outward + 0.9f * any_direction(random);
    const vec3 normal = 0.5f * outward + vec3(0, 0, 0.5f) + 0.7f * any_direction(random);
    shape.leaves.push_back(leaf_at(at + vec3(0, 0, half.z), along, normal,
                                   shape.kind().leaf_m * random.uniform(0.7f, 1.25f), random));
  }
}

/// Blades in tufts.
void leaf_sward(PlantShape& shape, std::size_t count, Random& random) {
  const PlantRecipe& recipe = shape.recipe;
  vec3 tuft(0.0f);
  for (std::size_t i = 0; i < count; ++i) {
    if (i % 9 == 0)
      tuft = recipe.length_m * vec3(random.uniform(-0.5f, 0.5f), random.uniform(-0.5f, 0.5f), 0.0f);
    const vec3 lean = any_direction(random) * vec3(1, 1, 0);
    const vec3 foot = tuft + 0.02f * any_direction(random) * vec3(1, 1, 0);
    const vec3 along = vec3(0, 0, 1) + 0.55f * lean;
    shape.leaves.push_back(leaf_at(foot, along, -lean + vec3(0, 0, 0.3f),
                                   recipe.height_m * random.uniform(0.55f, 1.15f), random));
  }
}

/// A tube per branch, its indices by pieces, the thickest first; and every piece as a line.
void add_wood(PlantShape& shape, const std::vector<Branch>& branches, Random& random) {
  struct Piece {
    float radius_m;
    std::size_t first, count;
  };
  std::vector<Piece> pieces;
  const auto sides_of = [&](const Branch& branch) {
    const auto& orders = shape.kind().orders;
    return orders.empty() ? 5 : orders[std::size_t(branch.order)].sides;
  };
  for (const Branch& branch : branches) {
    const std::size_t first = shape.wood.indices.size();
    const int sides = sides_of(branch);
    synthesis::add_tube(shape.wood, branch, sides);
    for (std::size_t k = 0; k + 1 < branch.points.size(); ++k) {
      const float radius_m = 0.5f * (branch.radii_m[k] + branch.radii_m[k + 1]);
      pieces.push_back({radius_m, first + k * std::size_t(6 * sides), std::size_t(6 * sides)});
      shape.twigs.push_back({branch.points[k], branch.points[k + 1], radius_m, 1.0f,
                             random.uniform(1e-4f, 1.0f) / (2.0f * radius_m)});
    }
  }
  std::ranges::sort(pieces, {}, [](const Piece& piece) { return std::pair(-piece.radius_m, piece.first); });
  std::vector<std::uint32_t> indices;
  indices.reserve(shape.wood.indices.size());
  for (const Piece& piece : pieces) {
    const auto first = shape.wood.indices.begin() + std::ptrdiff_t(piece.first);
    indices.insert(indices.end(), first, first + std::ptrdiff_t(piece.count));
    shape.pieces.push_back({piece.radius_m, std::uint32_t(indices.size())});
  }
  shape.wood.indices = std::move(indices);
  std::ranges::sort(shape.twigs, {}, [](const Twig& twig) {
    return std::array{twig.min_pixels_per_metre, twig.from.x, twig.from.y, twig.from.z};
  });
}

void find_openness(PlantShape& shape) {
  const float unit_m2 = full_leaf(shape.kind().leaf).area();
  std::vector<scene::LeafArea> areas;
  areas.reserve(shape.leaves.size());
  for (const Leaf& leaf : shape.leaves) areas.push_back({leaf.foot, unit_m2 * leaf.length_m * leaf.length_m});
  const scene::CrownOpenness openness(areas);
  for (Leaf& leaf : shape.leaves) leaf.openness = openness.at(leaf.foot + 0.5f * leaf.length_m * leaf.along);
  for (Twig& twig : shape.twigs) twig.openness = openness.at(0.5f * (twig.from + twig.to));
  for (const vec3 point : shape.wood.positions) shape.wood_openness.push_back(openness.at(point));
}

}  // namespace

std::size_t PlantShape::triangle_count() const {
  return leaves.size() * full_leaf(kind().leaf).triangle_count() + wood.triangle_count();
}

std::size_t leaf_count(const PlantRecipe& recipe) {
  const float natural = std::max(natural_leaves(recipe), 1.0f);
  if (recipe.kind->habit == Habit::tree) return std::min(std::size_t(natural), max_tree_leaves);
  return std::size_t(std::min(natural, 1e9f));
}

std::uint64_t estimated_bytes(const PlantRecipe& recipe) {
  const LeafTemplate &full = full_leaf(recipe.kind->leaf), &simple = simple_leaf(recipe.kind->leaf);
  const std::uint64_t corners = full.points.size() + simple.points.size();
  // Of each leaf: itself, its points twice, its corners on the GPU, and the ray tracer's mesh.
  const std::uint64_t per_leaf =
      sizeof(Leaf) + 2 * 24 + corners * 32 + full.points.size() * 32 + full.indices.size() * 4;
  return std::uint64_t(leaf_count(recipe)) * per_leaf;
}

PlantShape grow_plant(const PlantRecipe& recipe) {
  PlantShape shape;
  shape.recipe = recipe;
  Random random(recipe.seed, 400 + std::uint64_t(recipe.kind - plant_kinds().data()));
  const std::vector<Branch> branches = grow_branches(recipe, random);
  const std::size_t count = leaf_count(recipe);
  shape.leaves.reserve(count);
  if (is_needles(recipe.kind->leaf)) {
    leaf_conifer(shape, branches, count, random);
  } else if (recipe.kind->habit == Habit::tree) {
    leaf_tree(shape, branches, count, random);
  }
  if (recipe.kind->habit == Habit::hedge) leaf_hedge(shape, count, random);
  if (recipe.kind->habit == Habit::sward) leaf_sward(shape, count, random);
  add_wood(shape, branches, random);
  find_openness(shape);
  order_leaves(shape);
  double length_m = 0.0, area = 0.0;
  for (const Leaf& leaf : shape.leaves) {
    length_m += double(leaf.length_m), area += double(leaf.length_m * leaf.length_m);
    shape.bounds.add(leaf.foot - leaf.length_m), shape.bounds.add(leaf.foot + leaf.length_m);
  }
  for (const vec3 point : shape.wood.positions) shape.bounds.add(point);
  shape.mean_leaf_m = float(length_m / double(count));
  shape.mean_leaf_area_m2 = float(area / double(count)) * full_leaf(recipe.kind->leaf).area();
  return shape;
}

Mesh leaf_mesh(const PlantShape& shape) {
  const LeafTemplate& form = full_leaf(shape.kind().leaf);
  Mesh mesh;
  const std::size_t corners = form.points.size() * shape.leaves.size();
  mesh.positions.reserve(corners), mesh.normals.reserve(corners), mesh.uvs.reserve(corners);
  mesh.indices.reserve(form.indices.size() * shape.leaves.size());
  for (const Leaf& leaf : shape.leaves) {
    const auto first = std::uint32_t(mesh.positions.size());
    const glm::mat3 plant_from_leaf(glm::cross(leaf.along, leaf.normal), leaf.along, leaf.normal);
    for (std::size_t i = 0; i < form.points.size(); ++i) {
      mesh.positions.push_back(leaf.foot + leaf.length_m * (plant_from_leaf * form.points[i]));
      mesh.normals.push_back(plant_from_leaf * form.normals[i]);
      mesh.uvs.emplace_back(form.points[i]);
    }
    for (const std::uint16_t corner : form.indices) mesh.indices.push_back(first + corner);
  }
  return mesh;
}

}  // namespace parvis::vegetation
