// Grown plants: what their arrays hold, whatever kind and seed.
#include "life/vegetation/plant_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "life/vegetation/plant_levels.h"

namespace parvis::vegetation {
namespace {

PlantShape grown(const PlantKind& kind, std::uint64_t seed = 1) {
  return grow_plant({&kind, kind.height_m, 1.0f, seed});
}

TEST(LeafTemplates, TheCoarseLeafHasTheAreaOfTheFullOne) {
  for (int form = 0; form < leaf_form_count; ++form) {
    const LeafTemplate &full = full_leaf(LeafForm(form)), &simple = simple_leaf(LeafForm(form));
    EXPECT_NEAR(simple.area() / full.area(), 1.0f, 1e-3f);
    EXPECT_LT(simple.triangle_count(), full.triangle_count());
    for (const LeafTemplate* leaf : {&full, &simple}) {
      EXPECT_LE(leaf->points.size() * max_cluster_leaves, 65536u) << "indices of a cluster have 16 bits";
      for (const glm::vec3 normal : leaf->normals) EXPECT_GT(normal.z, 0.2f) << "seen from above";
    }
  }
}

TEST(PlantShape, IsDeterminedByItsSeed) {
  for (const PlantKind& kind : plant_kinds()) {
    const PlantShape a = grown(kind, 7), b = grown(kind, 7), other = grown(kind, 8);
    ASSERT_EQ(a.leaves.size(), b.leaves.size());
    bool is_other = a.leaves.size() != other.leaves.size();
    for (std::size_t i = 0; i < a.leaves.size(); ++i) {
      ASSERT_EQ(a.leaves[i].foot, b.leaves[i].foot);
      is_other |= !is_other && a.leaves[i].foot != other.leaves[i].foot;
    }
    EXPECT_EQ(a.wood.positions, b.wood.positions);
    EXPECT_TRUE(is_other) << kind.name;
  }
}

TEST(PlantShape, HasItsHeightAndStandsOnTheGround) {
  for (const PlantKind& kind : plant_kinds())
    for (const float factor : {0.7f, 1.0f, 1.5f}) {
      const float height_m = std::clamp(factor * kind.height_m, kind.min_height_m, kind.max_height_m);
      const PlantShape shape = grow_plant({&kind, height_m, 1.0f, 3});
      float top = 0.0f, lowest = 1.0f;
      for (const Leaf& leaf : shape.leaves) {
        top = std::max(top, leaf.foot.z), lowest = std::min(lowest, leaf.foot.z);
        ASSERT_TRUE(std::isfinite(leaf.foot.x + leaf.foot.y + leaf.foot.z + leaf.length_m));
        ASSERT_NEAR(glm::length(leaf.along), 1.0f, 1e-3f);
        ASSERT_NEAR(glm::dot(leaf.along, leaf.normal), 0.0f, 1e-3f);
        ASSERT_GT(leaf.openness, 0.0f);
        ASSERT_LE(leaf.openness, 1.0f);
      }
      if (kind.habit != Habit::sward) {
        EXPECT_NEAR(top, height_m, 0.3f * height_m) << kind.name;
      }
      EXPECT_GE(lowest, -0.05f) << kind.name;
      const Bounds mesh = leaf_mesh(shape).bounds();
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_GE(mesh.min[axis], shape.bounds.min[axis]);
        EXPECT_LE(mesh.max[axis], shape.bounds.max[axis]);
      }
    }
}

/// Widest distance of a leaf from the axis between two heights over the tree's.
float reach(const PlantShape& shape, float from, float to) {
  float widest = 0.0f;
  for (const Leaf& leaf : shape.leaves)
    if (leaf.foot.z >= from * shape.recipe.height_m && leaf.foot.z < to * shape.recipe.height_m)
      widest = std::max(widest, glm::length(glm::vec2(leaf.foot)));
  return widest;
}

TEST(PlantShape, ASpruceIsAConeThatBeginsAtTheGround) {
  const PlantShape spruce = grown(*find_kind("spruce"), 5);
  float last = 1e9f;
  for (float from = 0.1f; from < 0.95f; from += 0.2f) {
    const float now = reach(spruce, from, from + 0.2f);
    EXPECT_LT(now, last) << from;
    last = now;
  }
  EXPECT_GT(reach(spruce, 0.0f, 0.1f), 0.12f * spruce.recipe.height_m);
  EXPECT_LT(reach(spruce, 0.97f, 1.1f), 0.03f * spruce.recipe.height_m);
  EXPECT_GT(reach(spruce, 0.97f, 1.1f), 0.0f) << "its leader has needles";
}

TEST(PlantShape, APineHasABareTrunkBelowItsCrown) {
  const PlantShape pine = grown(*find_kind("pine"), 5);
  EXPECT_EQ(reach(pine, 0.0f, 0.2f), 0.0f);
  EXPECT_GT(reach(pine, 0.5f, 0.8f), 0.15f * pine.recipe.height_m);
}

TEST(PlantShape, NeedlesGrowOnTheWood) {
  for (const char* name : {"spruce", "pine"}) {
    const PlantShape shape = grown(*find_kind(name), 2);
    for (std::size_t i = 0; i < shape.leaves.size(); i += 997) {
      float nearest = 1e9f;
      for (const Twig& twig : shape.twigs) {
        const glm::vec3 along = twig.to - twig.from, away = shape.leaves[i].foot - twig.from;
        const float share = std::clamp(glm::dot(away, along) / glm::dot(along, along), 0.0f, 1.0f);
        nearest = std::min(nearest, glm::length(away - share * along));
      }
      EXPECT_LT(nearest, 1e-3f) << name;
    }
  }
}

TEST(PlantShape, AnOakHasAMillionTriangles) {
  EXPECT_GE(grown(*find_kind("oak")).triangle_count(), 1'000'000u);
}

TEST(PlantShape, EveryLeafIsInOneCluster) {
  const PlantShape shape = grown(*find_kind("orange"));
  std::set<std::uint32_t> seen;
  for (const LeafCluster& cluster : shape.clusters) {
    EXPECT_LE(cluster.count, max_cluster_leaves);
    for (std::uint32_t i = 0; i < cluster.count; ++i) {
      const std::uint32_t leaf = shape.clustered[cluster.first + i];
      EXPECT_TRUE(seen.insert(leaf).second);
      EXPECT_TRUE(i == 0 || shape.clustered[cluster.first + i - 1] < leaf) << "in prefix order";
    }
  }
  EXPECT_EQ(seen.size(), shape.leaves.size());
}

/// The largest difference between the shares of a prefix and of all leaves in any of 4x4x4 boxes.
double uneven(const std::vector<glm::vec3>& places, std::size_t prefix) {
  Bounds box;
  for (const glm::vec3 at : places) box.add(at);
  std::vector<double> of_all(64, 0.0), of_prefix(64, 0.0);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const glm::ivec3 cell = glm::min(glm::ivec3(4.0f * (places[i] - box.min) / box.size()), 3);
    const std::size_t at = std::size_t(16 * cell.z + 4 * cell.y + cell.x);
    of_all[at] += 1.0 / double(places.size());
    if (i < prefix) of_prefix[at] += 1.0 / double(prefix);
  }
  double maximum = 0.0;
  for (std::size_t i = 0; i < 64; ++i) maximum = std::max(maximum, std::abs(of_all[i] - of_prefix[i]));
  return maximum;
}

TEST(PlantShape, EveryPrefixOfItsLeavesIsSpreadAsAllAre) {
  const PlantShape shape = grown(*find_kind("plane"), 4);
  std::vector<glm::vec3> ordered, from_below;
  for (const Leaf& leaf : shape.leaves) ordered.push_back(leaf.foot);
  from_below = ordered;
  std::ranges::sort(from_below, {}, &glm::vec3::z);
  for (const std::size_t prefix : {200u, 333u, 1000u, 2500u, 5001u}) {
    const double off = uneven(ordered, prefix);
    EXPECT_LT(off, 0.6 / std::sqrt(double(prefix))) << prefix << ": no worse than chance";
    EXPECT_GT(uneven(from_below, prefix), 2.0 * off) << "control: the lowest first";
  }
}

TEST(PlantShape, APrefixOfItsTwigsKeepsTheirAreaInPixels) {
  const PlantShape shape = grown(*find_kind("oak"), 2);
  for (const float pixels_per_metre : {5.0f, 12.0f, 30.0f}) {
    double area = 0.0, drawn = 0.0, halved = 0.0, variance = 0.0;
    for (const Twig& twig : shape.twigs) {
      const double length_px = double(glm::distance(twig.from, twig.to) * pixels_per_metre);
      const double width_px = double(2.0f * twig.radius_m * pixels_per_metre);
      if (width_px >= 1.0) continue;  // a tube
      area += length_px * width_px;
      variance += length_px * length_px * width_px * (1.0 - width_px);
      if (twig.min_pixels_per_metre <= pixels_per_metre) drawn += length_px;
      if (twig.min_pixels_per_metre <= 0.5f * pixels_per_metre) halved += length_px;
    }
    EXPECT_NEAR(drawn, area, 3.5 * std::sqrt(variance)) << pixels_per_metre;
    EXPECT_LT(halved, area - 3.5 * std::sqrt(variance)) << "control: half as many";
  }
}

TEST(PlantLevels, TheAreaOfWhatIsShownIsThatOfAll) {
  const PlantShape shape = grown(*find_kind("oak"), 2);
  double all = 0.0;
  for (const Leaf& leaf : shape.leaves) all += double(leaf.length_m * leaf.length_m);
  for (float pixels_per_metre = 1.0f; pixels_per_metre < 500.0f; pixels_per_metre *= 1.37f) {
    const float share = leaf_shares(shape, pixels_per_metre).shown, fade = fading_share(share);
    double shown = 0.0;
    for (std::size_t i = 0; i < shape.leaves.size(); ++i) {
      const float rank = (float(i) + 0.5f) / float(shape.leaves.size());
      const float weight = fade > 0.0f ? std::clamp((share - rank) / fade, 0.0f, 1.0f) : float(rank < share);
      shown += double(weight * shape.leaves[i].length_m * shape.leaves[i].length_m);
    }
    EXPECT_NEAR(double(area_growth(share)) * shown / all, 1.0, 0.1) << pixels_per_metre;
  }
}

TEST(PlantLevels, ChangeSteadilyWithTheResolution) {
  for (const PlantKind& kind : plant_kinds()) {
    const PlantShape shape = grown(kind);
    LeafShares last{0.0f, 0.0f, 0.0f};
    WoodShares last_wood;
    for (float pixels_per_metre = 0.05f; pixels_per_metre < 1e5f; pixels_per_metre *= 1.02f) {
      const LeafShares now = leaf_shares(shape, pixels_per_metre);
      EXPECT_TRUE(now.full <= now.simple && now.simple <= now.shown && now.shown <= 1.0f);
      EXPECT_TRUE(now.full >= last.full && now.simple >= last.simple && now.shown >= last.shown);
      EXPECT_LT(now.full - last.full, 0.15f);
      EXPECT_LT(now.simple - last.simple, 0.15f);
      last = now;
      const WoodShares wood = wood_shares(shape, pixels_per_metre);
      EXPECT_GE(wood.pieces, last_wood.pieces);
      last_wood = wood;
    }
    EXPECT_EQ(last.full, 1.0f);
    EXPECT_EQ(last_wood.pieces, shape.pieces.size());
    EXPECT_EQ(last_wood.twigs, 0u) << "near, all wood is tubes";
  }
}

}  // namespace
}  // namespace parvis::vegetation
