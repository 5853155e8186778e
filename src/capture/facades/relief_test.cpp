#include "capture/facades/relief.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "capture/facades/item_buffer.h"
#include "capture/facades/test_model.h"

namespace parvis::facades {
namespace {

/// A wall at y = 8, seen from y < 0, with a box before it: 1.5 m thick, x in [-1, 1], z in [-1, 1].
double true_depth(double x, double z) { return std::abs(x) < 1.0 && std::abs(z) < 1.0 ? 6.5 : 8.0; }

/// Colours without repetition, of a point.
double grey(glm::dvec3 p) {
  double value = 0.0;
  for (int octave = 1; octave <= 4; ++octave)
    value += std::sin(3.1 * octave * p.x + 1.7 * octave * octave * p.z + octave) *
             std::cos(2.3 * octave * p.z - 0.9 * octave * p.x + p.y) / octave;
  return 128.0 + 40.0 * value;
}

std::vector<NamedMesh> boxed_wall() {
  return {wall("wall", 8.0, -4, 4, -3, 3), wall("box", 6.5, -1, 1, -1, 1)};
}

/// Photographs from places beside each other.
std::vector<GreyPhoto> photos() {
  const LayerModel model = model_of(boxed_wall());
  std::vector<GreyPhoto> result;
  for (int i = 0; i < 6; ++i) {
    const View view = test_view(240, 180, {1.1 * i - 2.75, 0.0, 0.3 * (i % 2)});
    const ItemBuffer seen = item_buffer(model, view);
    Image8 picture(view.width, view.height, 3);
    for (int y = 0; y < view.height; ++y)
      for (int x = 0; x < view.width; ++x) {
        const double depth = seen.depths[seen.index(x, y)];
        const double value = std::isfinite(depth) ? grey(view.to_world({x + 0.5, y + 0.5}, depth)) : 0.0;
        for (int c = 0; c < 3; ++c) picture.at(x, y)[c] = std::uint8_t(std::clamp(value, 0.0, 255.0));
      }
    result.push_back(grey_photo(view, picture));
  }
  return result;
}

SweptRectangle rectangle() {
  SweptRectangle r;
  r.origin = {-2.0, 8.0, -1.6}, r.u = {4.0, 0.0, 0.0}, r.v = {0.0, 0.0, 3.2}, r.normal = {0.0, -1.0, 0.0};
  r.columns = r.rows = 65;
  r.low = -0.4, r.high = 2.4;
  return r;
}

/// Share of grid points within 0.15 m of the truth, of those that are not at the box's edges.
double share_right(const SweptRectangle& r, const std::vector<float>& heights) {
  int right = 0, all = 0;
  for (int y = 0; y < r.rows; ++y)
    for (int x = 0; x < r.columns; ++x) {
      const double px = r.origin.x + r.u.x * x / (r.columns - 1), pz = r.origin.z + r.v.z * y / (r.rows - 1);
      if (std::abs(std::abs(px) - 1.0) < 0.3 || std::abs(std::abs(pz) - 1.0) < 0.3) continue;
      const double height = heights[std::size_t(y) * std::size_t(r.columns) + std::size_t(x)];
      ++all, right += std::abs(height - (8.0 - true_depth(px, pz))) < 0.15;
    }
  return double(right) / all;
}

TEST(PlaneSweep, FindsABoxBeforeAWall) {
  const SweptHeights found = swept_heights(rectangle(), photos());
  EXPECT_EQ(found.photographs, 6);
  EXPECT_GT(share_right(rectangle(), found.heights), 0.95);
  // The control: a flat wall is wrong where the box is.
  EXPECT_LT(share_right(rectangle(), std::vector<float>(found.heights.size(), 0.0f)), 0.85);
}

TEST(PlaneSweep, PhotographsFromOnePlaceFindNothing) {
  const std::vector<GreyPhoto> all = photos();
  const std::vector<GreyPhoto> same(4, all[2]);
  EXPECT_EQ(swept_heights(rectangle(), same).photographs, 0);
  EXPECT_TRUE(swept_heights(rectangle(), same).heights.empty());
}

/// The nearest that the relief of the wall comes to the photographers, who stand at y = 0 and, where it is
/// asked for, one metre before the wall beside the box.
float nearest_y_of_relief(bool has_camera_at_wall) {
  photographs::PhotographSet set;
  const auto add_photograph = [&](glm::vec3 place) {
    Camera camera;
    camera.world_from_camera = look_at(place, place + glm::vec3(0.0f, 1.0f, 0.0f));
    set.photographs.push_back(
        photographs::photograph_of(camera, fmt::format("{}.jpg", set.photographs.size()), 240, 180));
  };
  add_photograph({-1.0f, 0.0f, 0.0f});
  add_photograph({1.0f, 0.0f, 0.0f});
  if (has_camera_at_wall) add_photograph({1.8f, 7.0f, 0.0f});
  for (int i = 0; i < 100; ++i) {
    const double x = -1.9 + 3.8 * (i % 10) / 9.0, z = -1.5 + 3.0 * (i / 10) / 9.0;
    photographs::SparsePoint point;
    point.position_in_world = {x, true_depth(x, z), z};
    point.observations = {{0, {0.0, 0.0}}, {1, {0.0, 0.0}}};
    set.points.push_back(point);
  }
  CoarseModel model;
  model.surfaces.push_back(
      {"wall_1", SurfaceKind::wall, {{-2, 8, -1.6}, {2, 8, -1.6}, {2, 8, 1.6}, {-2, 8, 1.6}}, 100});
  const ReliefModel found = with_reliefs(model, set, photos());
  float nearest = 8.0f;
  for (const NamedMesh& named : found.meshes)
    for (const glm::vec3& position : named.mesh.positions) nearest = std::min(nearest, position.y);
  return nearest;
}

TEST(Relief, DoesNotReachBeyondACameraBeforeTheWall) {
  EXPECT_NEAR(nearest_y_of_relief(false), 6.5f, 0.3f) << "the box";
  EXPECT_GE(nearest_y_of_relief(true), 7.0f - 1e-3f) << "a photographer stands in the open";
}

TEST(ReliefMesh, HoldsItsToleranceWithoutCracks) {
  Relief relief{rectangle(), {}};
  for (int y = 0; y < 65; ++y)
    for (int x = 0; x < 65; ++x)
      relief.found.heights.push_back(float(0.3 * std::sin(0.2 * x) + 0.2 * std::cos(0.11 * y * x / 20.0)));
  const Mesh fine = mesh_of(relief, -1.0), coarse = mesh_of(relief, 0.05);
  EXPECT_EQ(fine.triangle_count(), 2u * 64 * 64);
  EXPECT_LT(coarse.triangle_count(), fine.triangle_count() / 4);
  // Every edge belongs to two triangles that run along it in opposite directions, or to one at the rim.
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (std::size_t t = 0; t < coarse.triangle_count(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      ++edges[{coarse.indices[3 * t + k], coarse.indices[3 * t + (k + 1) % 3]}];
  const auto is_on_rim = [&](std::uint32_t i) {
    const glm::vec2 uv = coarse.uvs[i];
    return uv.x == 0.0f || uv.y == 0.0f || uv.x == 1.0f || uv.y == 1.0f;
  };
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    if (!edges.contains({edge.second, edge.first})) {
      EXPECT_TRUE(is_on_rim(edge.first) && is_on_rim(edge.second)) << "a crack";
    }
  }
  LayerModelResult model = *layer_model({{"relief", coarse}});
  double area = 0.0;
  for (const LayerTriangle& t : model.model.triangles)
    area += 0.5 * std::abs((t.corners[1].x - t.corners[0].x) * (t.corners[2].z - t.corners[0].z) -
                           (t.corners[2].x - t.corners[0].x) * (t.corners[1].z - t.corners[0].z));
  EXPECT_NEAR(area, 4.0 * 3.2, 1e-4) << "the rectangle is covered once";
}

}  // namespace
}  // namespace parvis::facades
