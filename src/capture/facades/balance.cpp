// Colours are compared as sRGB values: differences there are about as visible in the dark as in the bright.
#include "capture/facades/balance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/colour.h"
#include "base/median.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "capture/facades/sightings.h"

namespace parvis::facades {
namespace {

constexpr int balance_rounds = 12;
/// Differences, in sRGB, that still are the same surface (noise, misregistration, glossiness), and that
/// surely are not.
constexpr float same_colour = 0.06f, other_colour = 0.14f;

constexpr std::size_t min_colour_witnesses = 3;
/// Pixels per side of the blocks that occluders are found in: colours are means of 5 x 5 pixels already, and
/// time grows with the square of the photographs' number.
constexpr int trust_block = 2;
/// Blocks per side of a square that must all distrust a place: a block that stands alone is a reflection or
/// noise. What is before the model and only two pixels wide reaches farther, as colours are means.
constexpr int support_blocks = 2;

double balanced(const Balance& balance, const Sighting& sighting, std::size_t c) {
  return balance.scale[c] * double(sighting.srgb[int(c)]) + balance.offset[c];
}

/// One round for a channel: common colours from the balances, then each balance from the common colours.
void improve(const std::vector<Sightings>& points, std::size_t c, std::vector<Balance>& balances) {
  struct Sums {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  };
  std::vector<Sums> sums(balances.size());
  for (const Sightings& point : points) {
    std::vector<double> values;
    for (const Sighting& s : point) values.push_back(balanced(balances[s.photo], s, c));
    const double common = median(values);
    for (std::size_t k = 0; k < point.size(); ++k) {
      const double x = point[k].srgb[int(c)];
      if (x < 0.02 || x > 0.98) continue;  // clipped: its value says nothing about the exposure
      const double residual = (values[k] - common) / same_colour, weight = 1.0 / (1.0 + residual * residual);
      Sums& s = sums[point[k].photo];
      s.n += weight, s.x += weight * x, s.y += weight * common, s.xx += weight * x * x,
          s.xy += weight * x * common;
    }
  }
  for (std::size_t i = 0; i < balances.size(); ++i) {
    Sums& s = sums[i];
    const double prior =
        0.01 * s.n + 1e-6;  // towards scale 1: a photograph of a plain wall has no slope of its own
    const double variance = s.xx - s.x * s.x / std::max(s.n, 1e-6),
                 covariance = s.xy - s.x * s.y / std::max(s.n, 1e-6);
    const double scale = std::clamp((covariance + prior) / (variance + prior), 0.4, 2.5);
    balances[i].scale[c] = scale;
    balances[i].offset[c] = s.n > 0.0 ? (s.y - scale * s.x) / s.n : 0.0;
  }
  double scale = 0.0, offset = 0.0;
  for (const Balance& b : balances)
    scale += b.scale[c] / double(balances.size()), offset += b.offset[c] / double(balances.size());
  for (Balance& b : balances) b.offset[c] = (b.offset[c] - offset) / scale, b.scale[c] /= scale;
}

/// 0 where the others agree with each other on another colour than a photograph's own. Where they do not
/// agree the model is wrong there, or the surface glossy: no photograph is more to blame than others.
float trust_in(glm::vec3 own, const Sightings& all, std::uint32_t photo) {
  std::array<std::vector<float>, 3> others;
  for (const Sighting& s : all)
    for (std::size_t c = 0; c < 3 && s.photo != photo; ++c) others[c].push_back(s.srgb[int(c)]);
  if (others[0].size() < min_colour_witnesses) return 1.0f;
  float spread = 0.0f, difference = 0.0f;
  for (std::size_t c = 0; c < 3; ++c) {
    std::ranges::sort(others[c]);
    // Of many witnesses a quarter may be hidden, too.
    const std::size_t out = others[c].size() / 4;
    spread = std::max(spread, others[c][others[c].size() - 1 - out] - others[c][out]);
    difference = std::max(difference, std::abs(own[int(c)] - others[c][others[c].size() / 2]));
  }
  const float agreement = 1.0f - glm::smoothstep(0.5f * same_colour, same_colour, spread);
  return 1.0f - agreement * glm::smoothstep(same_colour, other_colour, difference);
}

/// Trust per block, where a block is distrusted only together with a square of blocks that holds it.
ImageF supported(const ImageF& trust) {
  const int across = std::min(support_blocks, trust.width), down = std::min(support_blocks, trust.height);
  ImageF opened(trust.width, trust.height, 1, 1.0f);
  for (int top = 0; top + down <= trust.height; ++top)
    for (int left = 0; left + across <= trust.width; ++left) {
      float of_square = 0.0f;
      for (int y = top; y < top + down; ++y)
        for (int x = left; x < left + across; ++x) of_square = std::max(of_square, *trust.at(x, y));
      for (int y = top; y < top + down; ++y)
        for (int x = left; x < left + across; ++x) *opened.at(x, y) = std::min(*opened.at(x, y), of_square);
    }
  return opened;
}

/// The least trust of the pixels around each: averaging the colours has hidden the occluder's rim.
ImageF spread_out(const ImageF& trust) {
  constexpr int radius = 3;
  ImageF across = trust, down = trust;
  for (int y = 0; y < trust.height; ++y)
    for (int x = 0; x < trust.width; ++x)
      for (int d = -radius; d <= radius; ++d)
        *across.at(x, y) = std::min(*across.at(x, y), *trust.at(std::clamp(x + d, 0, trust.width - 1), y));
  for (int y = 0; y < trust.height; ++y)
    for (int x = 0; x < trust.width; ++x)
      for (int d = -radius; d <= radius; ++d)
        *down.at(x, y) = std::min(*down.at(x, y), *across.at(x, std::clamp(y + d, 0, trust.height - 1)));
  return down;
}

}  // namespace

std::vector<Balance> balances(std::span<const PreparedPhoto> photos, int step) {
  const std::vector<ImageF> srgb = blurred_srgb(photos);
  std::vector<Sightings> points;
  for (const PreparedPhoto& photo : photos)
    for (int y = step / 2; y < photo.view.height; y += step)
      for (int x = step / 2; x < photo.view.width; x += step) {
        const float depth = photo.depths[std::size_t(y) * std::size_t(photo.view.width) + std::size_t(x)];
        if (!std::isfinite(depth)) continue;
        Sightings found = sightings(photos, srgb, photo.view.to_world({x + 0.5, y + 0.5}, depth));
        if (found.size() >= 2) points.push_back(std::move(found));
      }
  std::vector<Balance> result(photos.size());
  for (int round = 0; round < balance_rounds; ++round)
    for (std::size_t c = 0; c < 3; ++c) improve(points, c, result);
  return result;
}

void apply(const Balance& balance, PreparedPhoto& photo) {
  for (std::size_t i = 0; i < photo.colours.pixels.size(); ++i) {
    float& value = photo.colours.pixels[i];
    const std::size_t c = i % 3;
    value = linear_from_srgb(std::clamp(
        float(balance.scale[c]) * srgb_from_linear(std::max(value, 0.0f)) + float(balance.offset[c]), 0.0f,
        1.0f));
  }
}

void find_occluders(std::span<PreparedPhoto> photos) {
  const std::vector<ImageF> srgb = blurred_srgb(photos);
  std::vector<ImageF> found_trust;  // apart, so that every photograph is judged by masks alone
  Progress progress("finding what is not in the model", photos.size());
  for (std::size_t i = 0; i < photos.size(); ++i) {
    const PreparedPhoto& photo = photos[i];
    const auto blocks = [](int pixels) { return (pixels + trust_block - 1) / trust_block; };
    ImageF of_blocks(blocks(photo.view.width), blocks(photo.view.height), 1, 1.0f);
    parallel_for(std::size_t(of_blocks.height), [&](std::size_t row) {
      const int y = trust_block * int(row);
      for (int x = 0; x < photo.view.width; x += trust_block) {
        const float depth = photo.depths[std::size_t(y) * std::size_t(photo.view.width) + std::size_t(x)];
        if (!std::isfinite(depth)) continue;
        const Sightings found = sightings(photos, srgb, photo.view.to_world({x + 0.5, y + 0.5}, depth));
        const float* own = srgb[i].at(x, y);
        *of_blocks.at(x / trust_block, int(row)) =
            trust_in(glm::vec3(own[0], own[1], own[2]), found, std::uint32_t(i));
      }
    });
    of_blocks = supported(of_blocks);
    ImageF trust(photo.view.width, photo.view.height, 1);
    for (int y = 0; y < trust.height; ++y)
      for (int x = 0; x < trust.width; ++x) *trust.at(x, y) = *of_blocks.at(x / trust_block, y / trust_block);
    trust = spread_out(trust);
    for (std::size_t p = 0; p < photo.trust.pixels.size(); ++p)
      trust.pixels[p] = std::min(trust.pixels[p], photo.trust.pixels[p]);
    found_trust.push_back(std::move(trust));
    progress.advance();
  }
  for (std::size_t i = 0; i < photos.size(); ++i) photos[i].trust = std::move(found_trust[i]);
}

}  // namespace parvis::facades
