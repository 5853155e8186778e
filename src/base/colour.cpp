#include "base/colour.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace parvis {

float linear_from_srgb(float srgb) {
  return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f);
}

float srgb_from_linear(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

glm::vec3 linear_from_srgb(glm::vec3 srgb) {
  return {linear_from_srgb(srgb.x), linear_from_srgb(srgb.y), linear_from_srgb(srgb.z)};
}

glm::vec3 srgb_from_linear(glm::vec3 linear) {
  return {srgb_from_linear(linear.x), srgb_from_linear(linear.y), srgb_from_linear(linear.z)};
}

glm::vec3 linear_from_srgb8(int red, int green, int blue) {
  return linear_from_srgb(glm::vec3(float(red), float(green), float(blue)) / 255.0f);
}

float luminance(glm::vec3 linear) { return glm::dot(linear, glm::vec3(0.2126f, 0.7152f, 0.0722f)); }

Image8 srgb8_from_linear(const ImageF& linear) {
  Image8 srgb(linear.width, linear.height, linear.channels);
  for (std::size_t i = 0; i < linear.pixels.size(); ++i) {
    const bool is_alpha = linear.channels == 4 && i % 4 == 3;
    const float value = std::clamp(linear.pixels[i], 0.0f, 1.0f);
    srgb.pixels[i] = std::uint8_t(std::lround(255.0f * (is_alpha ? value : srgb_from_linear(value))));
  }
  return srgb;
}

ImageF linear_from_srgb8(const Image8& srgb) {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values{};
    for (int i = 0; i < 256; ++i) values[std::size_t(i)] = linear_from_srgb(float(i) / 255.0f);
    return values;
  }();
  ImageF linear(srgb.width, srgb.height, srgb.channels);
  for (std::size_t i = 0; i < srgb.pixels.size(); ++i) {
    const bool is_alpha = srgb.channels == 4 && i % 4 == 3;
    linear.pixels[i] = is_alpha ? float(srgb.pixels[i]) / 255.0f : table[srgb.pixels[i]];
  }
  return linear;
}

}  // namespace parvis
