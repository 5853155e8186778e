#include "graphics/shading/sky.h"

#include <algorithm>
#include <glm/gtc/constants.hpp>

#include "base/colour.h"
#include "base/parallel.h"
#include "graphics/shading/spherical_harmonics.h"

namespace parvis::shading {
namespace {

constexpr int level_count = 7;
/// Brighter than this many times a photograph's mean is the sun's disc and its glare in the lens.
constexpr float sun_threshold = 12.0f;

vec3 direction_of(const ImageF& picture, float x, float y, float heading) {
  const float azimuth = (x / float(picture.width) - 0.5f) * 2.0f * glm::pi<float>() + heading;
  const float polar = y / float(picture.height) * glm::pi<float>();
  return {std::sin(polar) * std::sin(azimuth), std::sin(polar) * std::cos(azimuth), std::cos(polar)};
}

vec3 pixel(const ImageF& picture, int x, int y) {
  const float* p =
      picture.at((x % picture.width + picture.width) % picture.width, std::clamp(y, 0, picture.height - 1));
  return {p[0], p[1], p[2]};
}

vec3 bilinear(const ImageF& picture, vec2 uv) {
  const float x = uv.x * float(picture.width) - 0.5f, y = uv.y * float(picture.height) - 0.5f;
  const int left = int(x + 1.0f) - 1, top = int(y + 1.0f) - 1;  // floor, for they are above -1
  const float fx = x - float(left), fy = y - float(top);
  const int x0 = left < 0 ? picture.width - 1 : left, x1 = left + 1 < picture.width ? left + 1 : 0;
  const int y0 = std::max(top, 0), y1 = std::min(top + 1, picture.height - 1);
  const auto at = [&](int column, int row) {
    const float* p = picture.at(column, row);
    return vec3(p[0], p[1], p[2]);
  };
  return mix(mix(at(x0, y0), at(x1, y0), fx), mix(at(x0, y1), at(x1, y1), fx), fy);
}

ImageF plain_blue_sky() {
  ImageF picture(64, 32, 3);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const float height = std::clamp(1.0f - 2.0f * (float(y) + 0.5f) / float(picture.height), 0.0f, 1.0f);
      const vec3 colour = y < picture.height / 2
                              ? mix(vec3(0.85f, 0.92f, 1.0f), vec3(0.22f, 0.42f, 0.85f), std::sqrt(height))
                              : vec3(0.22f, 0.21f, 0.2f);
      for (int c = 0; c < 3; ++c) picture.at(x, y)[c] = colour[c];
    }
  return picture;
}

ImageF scaled(ImageF picture, float intensity) {
  for (float& value : picture.pixels) value *= intensity;
  return picture;
}

ImageF halved(const ImageF& picture) {
  ImageF half(std::max(picture.width / 2, 1), std::max(picture.height / 2, 1), 3);
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x) {
      const vec3 mean = 0.25f * (pixel(picture, 2 * x, 2 * y) + pixel(picture, 2 * x + 1, 2 * y) +
                                 pixel(picture, 2 * x, 2 * y + 1) + pixel(picture, 2 * x + 1, 2 * y + 1));
      for (int c = 0; c < 3; ++c) half.at(x, y)[c] = mean[c];
    }
  return half;
}

/// Where a sample of a lobe falls in the picture: to the right of the lobe's own column, and from the top.
struct LobeSample {
  float aside, v;
  float weight;  ///< all of a lobe sum to 1
};

/// The GGX lobe of `roughness` about the directions of a row (Karis 2013, n = v = r): they differ by a turn
/// about the zenith alone.
std::vector<LobeSample> lobe_of_row(float polar, float roughness, int samples) {
  const float alpha = roughness * roughness;
  const vec3 n(0.0f, std::sin(polar), std::cos(polar)), t(1.0f, 0.0f, 0.0f), b = cross(n, t);
  std::vector<LobeSample> lobe;
  lobe.reserve(std::size_t(samples));
  float weights = 0.0f;
  for (int i = 0; i < samples; ++i) {
    const float u = (float(i) + 0.5f) / float(samples);
    const float phi = 2.39996323f * float(i);  // golden angle: an even spiral
    const float cos_h = std::sqrt((1.0f - u) / (1.0f + (alpha * alpha - 1.0f) * u));
    const float sin_h = std::sqrt(std::max(0.0f, 1.0f - cos_h * cos_h));
    const vec3 h = sin_h * std::cos(phi) * t + sin_h * std::sin(phi) * b + cos_h * n;
    const vec3 l = reflect(-n, h);
    const float weight = dot(n, l);
    if (weight <= 0.0f) continue;
    const vec2 uv = equirect_uv(l, 0.0f);
    lobe.push_back({uv.x - 0.5f, uv.y, weight}), weights += weight;
  }
  for (LobeSample& sample : lobe) sample.weight /= weights;
  return lobe;
}

/// Blurs `source` by the lobe of `roughness` about each direction.
ImageF prefiltered(const ImageF& source, float roughness, int samples) {
  ImageF result(source.width, source.height, 3);
  parallel_for(std::size_t(result.height), [&](std::size_t row) {
    const std::vector<LobeSample> lobe =
        lobe_of_row((float(row) + 0.5f) / float(result.height) * glm::pi<float>(), roughness, samples);
    for (int x = 0; x < result.width; ++x) {
      const float u = (float(x) + 0.5f) / float(result.width);
      vec3 sum(0.0f);
      for (const LobeSample& sample : lobe)
        sum += sample.weight * bilinear(source, {fract(u + sample.aside), sample.v});
      for (int c = 0; c < 3; ++c) result.at(x, int(row))[c] = sum[c];
    }
  });
  return result;
}

/// A picture that is large enough for all levels: a smaller one is enlarged.
ImageF with_room_for_levels(const ImageF& picture) {
  constexpr int width = 1 << (level_count - 1);
  if (std::max(picture.width, picture.height) >= width) return picture;
  ImageF result(width, width / 2, 3);
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x) {
      const vec2 uv = (vec2(x, y) + 0.5f) / vec2(result.width, result.height);
      const vec3 colour = bilinear(picture, uv);
      for (int c = 0; c < 3; ++c) result.at(x, y)[c] = colour[c];
    }
  return result;
}

std::array<vec3, 9> irradiance_coefficients(const ImageF& picture, float heading) {
  std::array<vec3, 9> sh{};
  for (int y = 0; y < picture.height; ++y) {
    const float polar = (float(y) + 0.5f) / float(picture.height) * glm::pi<float>();
    const float solid_angle = std::sin(polar) * (glm::pi<float>() / float(picture.height)) *
                              (2.0f * glm::pi<float>() / float(picture.width));
    for (int x = 0; x < picture.width; ++x) {
      const vec3 d = direction_of(picture, float(x) + 0.5f, float(y) + 0.5f, heading);
      const vec3 light = solid_angle * pixel(picture, x, y);
      const std::array<float, 9> basis = sh_basis(d);
      for (std::size_t i = 0; i < 9; ++i) sh[i] += basis[i] * light;
    }
  }
  for (std::size_t i = 0; i < 9; ++i) sh[i] *= cosine_lobe[i];
  return sh;
}

vec3 mean_above_horizon(const ImageF& picture) {
  const int bottom = picture.height / 2, top = std::max(bottom - std::max(picture.height / 16, 1), 0);
  vec3 sum(0.0f);
  for (int y = top; y < bottom; ++y)
    for (int x = 0; x < picture.width; ++x) sum += pixel(picture, x, y);
  return sum / float(std::max((bottom - top) * picture.width, 1));
}

}  // namespace

ImageF without_sun(ImageF photograph) {
  double sum = 0.0;
  for (int y = 0; y < photograph.height; ++y)
    for (int x = 0; x < photograph.width; ++x) sum += double(luminance(pixel(photograph, x, y)));
  const float maximum = sun_threshold * float(sum / double(photograph.width) / double(photograph.height));
  for (int y = 0; y < photograph.height; ++y)
    for (int x = 0; x < photograph.width; ++x) {
      const float light = luminance(pixel(photograph, x, y));
      if (light > maximum)
        for (int c = 0; c < 3; ++c) photograph.at(x, y)[c] *= maximum / light;
    }
  return photograph;
}

SkyLight make_sky_light(const ImageF& picture, float intensity, float heading) {
  SkyLight sky;
  sky.heading = heading;
  sky.levels.push_back(scaled(with_room_for_levels(picture.empty() ? plain_blue_sky() : picture), intensity));
  std::vector<ImageF> halves{sky.levels.front()};
  for (int level = 1; level < level_count; ++level) {
    halves.push_back(halved(halves.back()));
    // Narrow lobes span a few pixels only, and the largest levels have the narrowest.
    const int samples = std::min(16 << (level - 1), 64);
    sky.levels.push_back(prefiltered(halves.back(), float(level) / float(level_count - 1), samples));
  }
  const ImageF& small = halves[std::min<std::size_t>(3, halves.size() - 1)];
  sky.irradiance_sh = irradiance_coefficients(small, heading);
  sky.haze_radiance = mean_above_horizon(small);
  return sky;
}

vec3 sky_picture_at(const SkyLight& sky, vec2 uv) { return bilinear(sky.levels.front(), uv); }

vec3 sky_radiance(const SkyLight& sky, vec3 direction, float level) {
  const vec2 uv = equirect_uv(direction, sky.heading);
  const float clamped = std::clamp(level, 0.0f, float(sky.levels.size() - 1));
  const std::size_t sharp = std::size_t(clamped), blurred = std::min(sharp + 1, sky.levels.size() - 1);
  return mix(bilinear(sky.levels[sharp], uv), bilinear(sky.levels[blurred], uv), clamped - float(sharp));
}

}  // namespace parvis::shading
