// Departures: clusters are isotropic (k-means) where Ruzon and Tomasi have oriented Gaussians between which
// they interpolate; all pixels share the clusters, where theirs are of windows along the boundary.
#include "capture/trees/matte.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <optional>

#include "base/colour.h"
#include "base/median.h"
#include "base/parallel.h"
#include "base/random.h"
#include "capture/trees/matting_laplacian.h"

namespace parvis::trees {
namespace {

constexpr int cluster_count = 8, cluster_steps = 8, max_cluster_samples = 20000;
constexpr float same_colour = 7.0f;        // LAB distance below which a pixel is of a plain background
constexpr float min_other_colour = 34.0f;  // no pixel nearer than this is wholly foreground
constexpr float other_share =
    0.85f;  // of the distance of the farthest tenth: beyond it pixels are foreground
constexpr float min_border_share = 0.5f;
constexpr float sky_step = 2.5f;          // LAB distance between neighbouring pixels of a sky
constexpr float min_matte_alpha = 0.02f;  // below it a pixel is background, above 1 - it foreground

/// CIE LAB of sRGB (0..1), white point D65.
glm::vec3 lab_of(glm::vec3 srgb) {
  const glm::vec3 c = linear_from_srgb(srgb);
  const glm::vec3 xyz(0.4124f * c.x + 0.3576f * c.y + 0.1805f * c.z,
                      0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z,
                      0.0193f * c.x + 0.1192f * c.y + 0.9505f * c.z);
  const auto f = [](float t) { return t > 0.008856f ? std::cbrt(t) : 7.787f * t + 16.0f / 116.0f; };
  const float x = f(xyz.x / 0.95047f), y = f(xyz.y), z = f(xyz.z / 1.08883f);
  return {116.0f * y - 16.0f, 500.0f * (x - y), 200.0f * (y - z)};
}

glm::vec3 srgb_at(const Image8& picture, std::size_t i) {
  const std::uint8_t* p = picture.pixels.data() + i * std::size_t(picture.channels);
  return glm::vec3(float(p[0]), float(p[1]), float(p[2])) / 255.0f;
}

/// A cluster's mean in LAB and in sRGB.
struct Cluster {
  glm::vec3 lab, srgb;
};

/// k-means from colours drawn at random, of one zone.
std::vector<Cluster> clusters_of(const Image8& photograph, const std::vector<glm::vec3>& lab,
                                 const Zones& zones, Zone zone) {
  std::vector<std::size_t> samples;
  for (std::size_t i = 0; i < zones.pixels.size(); ++i)
    if (zones.pixels[i] == zone) samples.push_back(i);
  Random random(1, 700);
  if (samples.size() > std::size_t(max_cluster_samples)) {
    for (int k = 0; k < max_cluster_samples; ++k)
      std::swap(samples[std::size_t(k)],
                samples[std::size_t(k) + std::size_t(random.index(int(samples.size()) - k))]);
    samples.resize(std::size_t(max_cluster_samples));
  }
  std::vector<Cluster> clusters;
  for (int k = 0; k < cluster_count; ++k) {
    const std::size_t i = samples[std::size_t(random.index(int(samples.size())))];
    clusters.push_back({lab[i], srgb_at(photograph, i)});
  }
  for (int step = 0; step < cluster_steps; ++step) {
    std::vector<Cluster> sums(clusters.size(), {glm::vec3(0.0f), glm::vec3(0.0f)});
    std::vector<float> counts(clusters.size(), 0.0f);
    for (const std::size_t i : samples) {
      const auto nearest = std::ranges::min_element(
          clusters, {}, [&](const Cluster& c) { return glm::distance(c.lab, lab[i]); });
      const auto k = std::size_t(nearest - clusters.begin());
      sums[k].lab += lab[i], sums[k].srgb += srgb_at(photograph, i), counts[k] += 1.0f;
    }
    for (std::size_t k = 0; k < clusters.size(); ++k)
      if (counts[k] > 0.0f) clusters[k] = {sums[k].lab / counts[k], sums[k].srgb / counts[k]};
  }
  return clusters;
}

/// Alpha and pure foreground of a mixed pixel. `given`: its alpha, where it is known.
glm::vec4 unmixed(glm::vec3 colour, glm::vec3 lab, const std::vector<Cluster>& foreground,
                  const std::vector<Cluster>& background, std::optional<float> given = std::nullopt) {
  float minimum = 1e30f, alpha = 0.0f;
  const Cluster* front = &foreground[0];
  const Cluster* back = &background[0];
  for (const Cluster& f : foreground)
    for (const Cluster& b : background) {
      const glm::vec3 line = f.lab - b.lab;
      const float share =
          std::clamp(glm::dot(lab - b.lab, line) / std::max(glm::dot(line, line), 1e-4f), 0.0f, 1.0f);
      const float distance = glm::distance(lab, b.lab + share * line);
      if (distance < minimum) minimum = distance, alpha = share, front = &f, back = &b;
    }
  alpha = given.value_or(alpha);
  if (alpha < min_matte_alpha) return {front->srgb, 0.0f};
  if (alpha > 1.0f - min_matte_alpha) return {colour, 1.0f};
  // The pair's foreground, moved so that mixing gives the pixel's own colour again.
  const glm::vec3 pure = back->srgb + (colour - back->srgb) / alpha;
  return {glm::clamp(glm::mix(front->srgb, pure, alpha), 0.0f, 1.0f), alpha};
}

/// The distance from the background's colour beyond which pixels are foreground, by those that are not of it.
float foreground_distance(const std::vector<float>& distances) {
  std::vector<float> far;
  for (const float distance : distances)
    if (distance > same_colour) far.push_back(distance);
  if (far.empty()) return min_other_colour;
  const auto tenth = far.begin() + std::ptrdiff_t(far.size() * 9 / 10);
  std::ranges::nth_element(far, tenth);
  return std::max(min_other_colour, other_share * *tenth);
}

}  // namespace

Result<Zones> zones_of_scribbles(const Image8& scribbles, int width, int height, const std::string& name) {
  Zones zones{width, height, std::vector<Zone>(std::size_t(width) * std::size_t(height), Zone::unknown)};
  std::size_t background = 0, foreground = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::uint8_t* p = scribbles.at(x * scribbles.width / width, y * scribbles.height / height);
      Zone& zone = zones.pixels[std::size_t(y) * std::size_t(width) + std::size_t(x)];
      if (p[0] > 200 && p[1] < 60 && p[2] < 60) zone = Zone::background, ++background;
      if (p[1] > 200 && p[0] < 60 && p[2] < 60) zone = Zone::foreground, ++foreground;
    }
  if (background == 0)
    return error("{}: no background zone: paint some of the background red (255, 0, 0)", name);
  if (foreground == 0) return error("{}: no foreground zone: paint some of the tree green (0, 255, 0)", name);
  return zones;
}

Result<Zones> zones_of_plain_background(const Image8& photograph, const std::string& name) {
  const int width = photograph.width, height = photograph.height,
            border = std::max(1, std::min(width, height) / 50);
  std::vector<std::size_t> edge;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (x < border || y < border || x >= width - border || y >= height - border)
        edge.push_back(std::size_t(y) * std::size_t(width) + std::size_t(x));
  std::array<std::vector<float>, 3> channels;
  for (const std::size_t i : edge) {
    const glm::vec3 lab = lab_of(srgb_at(photograph, i));
    for (int c = 0; c < 3; ++c) channels[std::size_t(c)].push_back(lab[c]);
  }
  glm::vec3 middle;
  for (std::size_t c = 0; c < 3; ++c) middle[int(c)] = median(std::move(channels[c]));
  std::size_t alike = 0;
  for (const std::size_t i : edge)
    alike += glm::distance(lab_of(srgb_at(photograph, i)), middle) < 2.0f * same_colour;
  if (float(alike) < min_border_share * float(edge.size()))
    return error(
        "{}: the background is not plain ({} % of the picture's border look alike); paint zones, see --zones",
        name, 100 * alike / edge.size());
  Zones zones{width, height, std::vector<Zone>(std::size_t(width) * std::size_t(height), Zone::unknown)};
  std::vector<float> distances(zones.pixels.size());
  parallel_for(
      distances.size(),
      [&](std::size_t i) { distances[i] = glm::distance(lab_of(srgb_at(photograph, i)), middle); }, 4096);
  const float foreground = foreground_distance(distances);
  for (std::size_t i = 0; i < distances.size(); ++i) {
    if (distances[i] < same_colour) zones.pixels[i] = Zone::background;
    if (distances[i] > foreground) zones.pixels[i] = Zone::foreground;
  }
  return zones;
}

Result<Zones> zones_of_sky(const Image8& photograph, const std::string& name) {
  const int width = photograph.width, height = photograph.height;
  Zones zones{width, height, std::vector<Zone>(std::size_t(width) * std::size_t(height), Zone::unknown)};
  std::vector<glm::vec3> lab(zones.pixels.size());
  parallel_for(
      lab.size(), [&](std::size_t i) { lab[i] = lab_of(srgb_at(photograph, i)); }, 4096);
  // From the upper edge on through colours that change slowly.
  std::vector<std::size_t> open;
  std::vector<glm::vec3> row_sky(std::size_t(height), glm::vec3(0.0f));
  std::vector<float> row_count(std::size_t(height), 0.0f);
  const auto take = [&](std::size_t i) {
    zones.pixels[i] = Zone::background, open.push_back(i);
    row_sky[i / std::size_t(width)] += lab[i], row_count[i / std::size_t(width)] += 1.0f;
  };
  glm::vec3 edge(0.0f);
  for (int x = 0; x < width; ++x) edge += lab[std::size_t(x)] / float(width);
  for (int x = 0; x < width; ++x)
    if (glm::distance(lab[std::size_t(x)], edge) < 2.0f * same_colour) take(std::size_t(x));
  if (float(open.size()) < min_border_share * float(width))
    return error(
        "{}: no sky is at the picture's upper edge ({} % of it look alike); paint zones, see --zones", name,
        100 * open.size() / std::size_t(width));
  while (!open.empty()) {
    const std::size_t i = open.back();
    open.pop_back();
    const int x = int(i % std::size_t(width)), y = int(i / std::size_t(width));
    for (const auto& [u, v] : {std::pair{x - 1, y}, {x + 1, y}, {x, y - 1}, {x, y + 1}}) {
      if (u < 0 || v < 0 || u >= width || v >= height) continue;
      const std::size_t k = std::size_t(v) * std::size_t(width) + std::size_t(u);
      if (zones.pixels[k] == Zone::unknown && glm::distance(lab[i], lab[k]) < sky_step) take(k);
    }
  }
  // Gaps in the crown look like the sky of their row, or of the nearest row above that has any.
  std::vector<float> distances(zones.pixels.size());
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const std::size_t row = i / std::size_t(width);
    if (i % std::size_t(width) == 0) {
      if (row_count[row] > 0.0f) row_sky[row] /= row_count[row];
      if (row_count[row] <= 0.0f && row > 0) row_sky[row] = row_sky[row - 1];
    }
    distances[i] = glm::distance(lab[i], row_sky[row]);
  }
  const float foreground = foreground_distance(distances);
  for (std::size_t i = 0; i < distances.size(); ++i) {
    if (distances[i] < same_colour) zones.pixels[i] = Zone::background;
    if (zones.pixels[i] == Zone::unknown && distances[i] > foreground) zones.pixels[i] = Zone::foreground;
  }
  return zones;
}

bool has_matte(const Image8& picture) {
  if (picture.channels != 4) return false;
  int low = 255, high = 0;
  for (std::size_t i = 3; i < picture.pixels.size(); i += 4)
    low = std::min(low, int(picture.pixels[i])), high = std::max(high, int(picture.pixels[i]));
  return low < high;
}

Result<Image8> matte(const Image8& photograph, const Zones& zones, const std::string& name,
                     MatteMethod method) {
  if (zones.width != photograph.width || zones.height != photograph.height)
    return error("{}: zones of {} x {} pixels for a photograph of {} x {}", name, zones.width, zones.height,
                 photograph.width, photograph.height);
  const auto has = [&](Zone zone) { return std::ranges::find(zones.pixels, zone) != zones.pixels.end(); };
  if (!has(Zone::background)) return error("{}: no background zone: the matte would be 255 everywhere", name);
  if (!has(Zone::foreground)) return error("{}: no foreground zone: the matte would be 0 everywhere", name);
  std::vector<glm::vec3> lab(zones.pixels.size());
  parallel_for(
      lab.size(), [&](std::size_t i) { lab[i] = lab_of(srgb_at(photograph, i)); }, 4096);
  const std::vector<Cluster> foreground = clusters_of(photograph, lab, zones, Zone::foreground);
  const std::vector<Cluster> background = clusters_of(photograph, lab, zones, Zone::background);
  std::vector<float> alphas;
  if (method == MatteMethod::laplacian) {
    alphas.resize(lab.size());
    parallel_for(
        lab.size(),
        [&](std::size_t i) { alphas[i] = unmixed(srgb_at(photograph, i), lab[i], foreground, background).w; },
        1024);
    alphas = laplacian_alpha(photograph, zones, std::move(alphas));
  }
  Image8 result(photograph.width, photograph.height, 4);
  parallel_for(
      zones.pixels.size(),
      [&](std::size_t i) {
        const glm::vec3 colour = srgb_at(photograph, i);
        const glm::vec4 rgba = zones.pixels[i] == Zone::background ? glm::vec4(colour, 0.0f)
                               : zones.pixels[i] == Zone::foreground
                                   ? glm::vec4(colour, 1.0f)
                                   : unmixed(colour, lab[i], foreground, background,
                                             alphas.empty() ? std::nullopt : std::optional(alphas[i]));
        for (std::size_t c = 0; c < 4; ++c)
          result.pixels[4 * i + c] = std::uint8_t(std::lround(255.0f * rgba[int(c)]));
      },
      1024);
  return result;
}

}  // namespace parvis::trees
