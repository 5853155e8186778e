#include "capture/facades/novel_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/colour.h"
#include "base/parallel.h"
#include "capture/facades/balance.h"
#include "capture/facades/blend.h"
#include "capture/facades/rephotography.h"
#include "capture/facades/test_model.h"

namespace parvis::facades {
namespace {

/// A smooth terrace_pattern on all surfaces, linear.
glm::vec3 terrace_pattern(glm::dvec3 p) {
  return {0.4 + 0.2 * std::sin(2.0 * p.x), 0.4 + 0.2 * std::sin(3.0 * p.z + p.x),
          0.3 + 0.1 * std::cos(2.5 * p.x - p.z)};
}

PreparedPhoto photo_of(const LayerModel& model, const View& view) {
  PreparedPhoto photo{"test", view, ImageF(view.width, view.height, 3), item_buffer(model, view).depths, {}};
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) {
      const float depth = photo.depths[std::size_t(y * view.width + x)];
      const glm::vec3 colour =
          std::isfinite(depth) ? terrace_pattern(view.to_world({x + 0.5, y + 0.5}, depth)) : glm::vec3(0.9f);
      for (int c = 0; c < 3; ++c) photo.colours.at(x, y)[c] = colour[c];
    }
  return photo;
}

std::vector<NamedMesh> terrace_street() {
  return {wall("far", 6, -9, 9, -6, 6), wall("near", 4, -0.7f, 0.7f, -2, 2),
          quad("ground", {-9, 1, -2}, {18, 0, 0}, {0, 9, 0})};
}

std::vector<PreparedPhoto> photos_of(const LayerModel& model) {
  std::vector<PreparedPhoto> photos;
  for (const double x : {-2.0, -1.0, 0.2, 1.2, 2.1})
    photos.push_back(photo_of(model, test_view(160, 120, {x, 0.1 * x, 0})));
  return photos;
}

/// Largest error over the pixels that have a colour; the terrace_pattern is the truth.
float largest_error(const LayerModel& model, const View& view, const ImageF& picture) {
  const ItemBuffer seen = item_buffer(model, view);
  float largest = 0.0f;
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x)
      if (picture.at(x, y)[3] > 0.0f) {
        const glm::vec3 truth =
            terrace_pattern(view.to_world({x + 0.5, y + 0.5}, seen.depths[seen.index(x, y)]));
        for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(picture.at(x, y)[c] - truth[c]));
      }
  return largest;
}

TEST(NovelView, ShowsThePatternFromBetweenThePhotographs) {
  const LayerModel model = model_of(terrace_street());
  const auto photos = photos_of(model);
  const View view = test_view(160, 120, {0.7, 0.3, 0.1});
  const ImageF picture = novel_view(model, view, photos, {});
  int covered = 0;
  for (std::size_t i = 3; i < picture.pixels.size(); i += 4) covered += picture.pixels[i] > 0.0f;
  EXPECT_GT(covered, 160 * 120 * 95 / 100);
  // Bilinear lookups of a smooth terrace_pattern; pixels of a photograph that mix two walls give way to
  // another's.
  const float error = largest_error(model, view, picture);
  EXPECT_LT(error, 0.1f);
  BlendSettings without_depth;
  without_depth.depth_tolerance = 100.0f, without_depth.max_contradiction = 1.0f;
  EXPECT_GT(largest_error(model, view, novel_view(model, view, photos, without_depth)), 2.0f * error)
      << "occlusion changes nothing";
}

TEST(NovelView, APhotographsOwnViewpointShowsThatPhotograph) {
  const LayerModel model = model_of(terrace_street());
  const auto photos = photos_of(model);
  const ImageF picture = novel_view(model, photos[2].view, photos, {});
  const ItemBuffer seen = item_buffer(model, photos[2].view);
  double squared = 0.0, count = 0.0;
  for (int y = 0; y < 120; ++y)
    for (int x = 10; x < 150; ++x)  // within the feather other photographs count, too
      for (int c = 0; c < 3 && seen.depths[seen.index(x, y)] < 100; ++c)
        squared += std::pow(picture.at(x, y)[c] - photos[2].colours.at(x, y)[c], 2.0), ++count;
  EXPECT_GT(10.0 * std::log10(count / squared), 60.0);
}

TEST(Blend, WeightsVanishWhereAPhotographLeavesTheBest) {
  EXPECT_EQ(blend_weight(0.3f, 0.3f), 0.0f);
  EXPECT_EQ(blend_weight(0.4f, 0.3f), 0.0f);
  EXPECT_FLOAT_EQ(blend_weight(0.1f, 0.2f), 0.5f / 0.1f);
  EXPECT_EQ(border_feather(glm::vec2(0, 50), glm::vec2(100, 100), 10), 0.0f);
  EXPECT_EQ(border_feather(glm::vec2(50, 50), glm::vec2(100, 100), 10), 1.0f);
  EXPECT_EQ(not_hidden(5.0f, 5.0f, 0.01f), 1.0f);
  EXPECT_EQ(not_hidden(5.2f, 5.0f, 0.01f), 0.0f);
  EXPECT_NEAR(view_penalty(glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), 1.0f, 0.1f), glm::half_pi<float>(), 1e-6f);
  EXPECT_NEAR(view_penalty(glm::vec3(1, 0, 0), glm::normalize(glm::vec3(1, 1e-3f, 0)), 0.5f, 0.1f), 1e-3f,
              1e-6f);
  EXPECT_NEAR(view_penalty(glm::vec3(1, 0, 0), glm::vec3(1, 0, 0), 4.0f, 0.1f), 0.2f, 1e-6f);
}

// The set of best photographs changes along a path; the colour must not jump.
TEST(Blend, ColoursDoNotJumpWhereTheBestPhotographsChange) {
  std::vector<Opinion> all;
  const auto colour_at = [&](float eye) {
    all.clear();
    for (std::uint32_t i = 0; i < 6; ++i)
      all.push_back({i, std::max(std::abs(eye - 0.2f * float(i)), MIN_PENALTY), 1.0f,
                     glm::vec3(float(i % 2), float(i % 3), 0.0f)});
    std::ranges::sort(all, {}, &Opinion::penalty);
    return glm::vec3(blended(all, 2, 10.0f));
  };
  float largest = 0.0f;
  for (float eye = 0.0f; eye < 1.0f; eye += 1e-4f)
    largest = std::max(largest, glm::distance(colour_at(eye), colour_at(eye + 1e-4f)));
  EXPECT_LT(largest, 0.02f);
}

TEST(Balance, FindsExposuresThatWereChanged) {
  const LayerModel model = model_of(terrace_street());
  std::vector<PreparedPhoto> photos = photos_of(model);
  const std::vector<double> scales = {0.8, 1.1, 1.0, 0.9, 1.2};
  for (std::size_t i = 0; i < photos.size(); ++i) {
    Balance changed;
    changed.scale.fill(scales[i]), changed.offset.fill(0.02 * double(i) - 0.04);
    apply(changed, photos[i]);
  }
  const auto spread = [&] {
    const std::vector<Opinion> found = opinions(photos, {}, {2.5, 6, 1.5}, {0, 0, 0}, 0.02);
    EXPECT_EQ(found.size(), 5u);
    float low = 1.0f, high = 0.0f;
    for (const Opinion& o : found) low = std::min(low, o.colour.y), high = std::max(high, o.colour.y);
    return high - low;
  };
  const float before = spread();
  const std::vector<Balance> found = balances(photos, 4);
  for (std::size_t i = 0; i < photos.size(); ++i) apply(found[i], photos[i]);
  EXPECT_GT(before, 0.1f);
  EXPECT_LT(spread(), 0.15f * before);
}

TEST(Balance, APasserByIsFoundByColourAndTheWallIsNot) {
  const LayerModel model = model_of(terrace_street());
  std::vector<PreparedPhoto> photos = photos_of(model);
  for (int y = 30; y < 60; ++y)
    for (int x = 100; x < 115; ++x)
      for (int c = 0; c < 3; ++c) photos[1].colours.at(x, y)[c] = 0.02f;
  find_occluders(photos);
  for (int y = 33; y < 57; ++y) EXPECT_LT(*photos[1].trust.at(107, y), 0.1f) << y;
  int distrusted = 0;
  for (const PreparedPhoto& photo : photos)
    for (const float trust : photo.trust.pixels) distrusted += trust < 0.5f;
  // The block and its rim, and some silhouettes, where averaging mixes two walls.
  EXPECT_LT(distrusted, 5 * 160 * 120 / 40);
  const View view = test_view(160, 120, {-0.8, 0, 0});
  const float rejected = largest_error(model, view, novel_view(model, view, photos, {}));
  BlendSettings trusting;
  trusting.uses_trust = false;
  EXPECT_LT(rejected, 0.2f);
  EXPECT_GT(largest_error(model, view, novel_view(model, view, photos, trusting)), 1.5f * rejected);
}

/// Lowest trust around a place of photograph 1 in which a square of so many pixels is a little brighter.
float trust_with_spot(const LayerModel& model, int side) {
  constexpr int x = 98, y = 44;      // in the middle of the near wall
  constexpr float brighter = 0.12f;  // of sRGB: seen by a block in the middle of the spot alone
  std::vector<PreparedPhoto> photos = photos_of(model);
  for (int v = y - side / 2; v <= y + side / 2; ++v)
    for (int u = x - side / 2; u <= x + side / 2; ++u)
      for (int c = 0; c < 3; ++c) {
        float& value = photos[1].colours.at(u, v)[c];
        value = linear_from_srgb(srgb_from_linear(value) + brighter);
      }
  find_occluders(photos);
  float lowest = 1.0f;
  for (int v = y - 2; v <= y + 2; ++v)
    for (int u = x - 2; u <= x + 2; ++u) lowest = std::min(lowest, *photos[1].trust.at(u, v));
  return lowest;
}

TEST(Balance, ABlockAloneIsNoOccluder) {
  const LayerModel model = model_of(terrace_street());
  EXPECT_GT(trust_with_spot(model, 5), 0.8f) << "a glint in a pane";
  EXPECT_LT(trust_with_spot(model, 15), 0.5f) << "the control: something is there";
}

TEST(Rephotography, SaysWhatWasChanged) {
  Image8 photograph(64, 64, 4, 255), rendered = photograph;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      for (int c = 0; c < 3; ++c) {
        photograph.at(x, y)[c] = std::uint8_t(100 + 40 * std::sin(0.7 * x) * std::cos(0.5 * y));
        rendered.at(x, y)[c] = std::uint8_t(std::lround(0.5 * photograph.at(x, y)[c] + 20));
      }
  for (int x = 0; x < 64; ++x) rendered.at(x, 0)[3] = 0;
  const Rephotography exposed = rephotography(rendered, photograph);
  EXPECT_LT(exposed.psnr_db, 20.0);
  EXPECT_GT(exposed.psnr_cc_db, 45.0) << "a change of exposure is corrected";
  EXPECT_LT(exposed.error, 0.01);
  EXPECT_DOUBLE_EQ(exposed.covered_percent, 100.0 * 63 / 64);
  for (int y = 0; y < 64; ++y)
    for (int x = 63; x > 3; --x)
      for (int c = 0; c < 3; ++c) rendered.at(x, y)[c] = rendered.at(x - 4, y)[c];
  const Rephotography shifted = rephotography(rendered, photograph);
  EXPECT_LT(shifted.psnr_cc_db, 30.0);
  EXPECT_GT(shifted.error, 0.5);
}

}  // namespace
}  // namespace parvis::facades
