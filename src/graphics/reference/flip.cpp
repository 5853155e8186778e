#include "graphics/reference/flip.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>

#include "base/colour.h"
#include "base/parallel.h"
#include "graphics/reference/filter.h"

namespace parvis::reference {
namespace {

using glm::vec3;

// The constants of the paper, section 4.
constexpr float pixels_per_degree = 67.0f;
constexpr float colour_exponent = 0.7f;      // q_c
constexpr float colour_knee = 0.4f;          // p_c
constexpr float knee_error = 0.95f;          // p_t
constexpr float feature_exponent = 0.5f;     // q_f
constexpr float feature_width_deg = 0.082f;  // w
const vec3 white_xyz{0.950428545f, 1.0f, 1.088900371f};

vec3 xyz_from_linear(vec3 c) {
  return {0.4124564f * c.x + 0.3575761f * c.y + 0.1804375f * c.z,
          0.2126729f * c.x + 0.7151522f * c.y + 0.0721750f * c.z,
          0.0193339f * c.x + 0.1191920f * c.y + 0.9503041f * c.z};
}

vec3 linear_from_xyz(vec3 c) {
  return {3.2404542f * c.x - 1.5371385f * c.y - 0.4985314f * c.z,
          -0.9692660f * c.x + 1.8760108f * c.y + 0.0415560f * c.z,
          0.0556434f * c.x - 0.2040259f * c.y + 1.0572252f * c.z};
}

/// The opponent space YCxCz, linear in XYZ.
vec3 ycxcz_from_linear(vec3 linear) {
  const vec3 p = xyz_from_linear(linear) / white_xyz;
  return {116.0f * p.y - 16.0f, 500.0f * (p.x - p.y), 200.0f * (p.y - p.z)};
}

vec3 linear_from_ycxcz(vec3 c) {
  const float y = (c.x + 16.0f) / 116.0f;
  return linear_from_xyz(vec3(y + c.y / 500.0f, y, y - c.z / 200.0f) * white_xyz);
}

vec3 lab_from_linear(vec3 linear) {
  const vec3 p = xyz_from_linear(linear) / white_xyz;
  const auto f = [](float t) {
    constexpr float delta = 6.0f / 29.0f;
    return t > delta * delta * delta ? std::cbrt(t) : t / (3.0f * delta * delta) + 4.0f / 29.0f;
  };
  return {116.0f * f(p.y) - 16.0f, 500.0f * (f(p.x) - f(p.y)), 200.0f * (f(p.y) - f(p.z))};
}

/// Colours of dark pixels differ less to the eye (Hunt effect).
vec3 hunt_adjusted(vec3 lab) { return {lab.x, 0.01f * lab.x * lab.y, 0.01f * lab.x * lab.z}; }

float hyab(vec3 a, vec3 b) {
  const vec3 d = a - b;
  return std::abs(d.x) + std::sqrt(d.y * d.y + d.z * d.z);
}

vec3 pixel(const ImageF& image, int x, int y) {
  const float* p = image.at(x, y);
  return {p[0], p[1], p[2]};
}

template <class Function>
ImageF mapped(const ImageF& image, int channels, const Function& function) {
  ImageF result(image.width, image.height, channels);
  parallel_for(std::size_t(image.height), [&](std::size_t y) {
    for (int x = 0; x < image.width; ++x) {
      const vec3 value = function(pixel(image, x, int(y)));
      for (int c = 0; c < channels; ++c) result.at(x, int(y))[c] = value[c];
    }
  });
  return result;
}

/// a1 sqrt(pi/b1) exp(-pi^2 x^2 / b1) + the second such term: table 1 of the paper, as weights of two
/// Gaussians.
struct Sensitivity {
  float a1, b1, a2, b2;
};
constexpr Sensitivity achromatic{1.0f, 0.0047f, 0.0f, 1e-5f}, red_green{1.0f, 0.0053f, 0.0f, 1e-5f},
    blue_yellow{34.1f, 0.04f, 13.5f, 0.025f};

int filter_radius() {
  return int(
      std::ceil(3.0f * std::sqrt(0.04f / (2.0f * glm::pi<float>() * glm::pi<float>())) * pixels_per_degree));
}

/// A channel seen from the distance: each term of the sensitivity is a separable Gaussian, and the whole has
/// sum 1.
ImageF seen(const ImageF& channel, const Sensitivity& s) {
  const int radius = filter_radius();
  const auto term = [&](float a, float b, double& sum) {
    const float sigma = std::sqrt(b / (2.0f * glm::pi<float>() * glm::pi<float>())) * pixels_per_degree;
    double line = 0.0;
    for (int x = -radius; x <= radius; ++x)
      line += std::exp(-double(x * x) / (2.0 * double(sigma) * double(sigma)));
    sum = double(a * std::sqrt(glm::pi<float>() / b)) * line * line;  // over the two dimensions of the kernel
    return gaussian(sigma, radius);
  };
  double sum1 = 0.0, sum2 = 0.0;
  const Kernel first = term(s.a1, s.b1, sum1);
  ImageF result = filtered(channel, first, first);
  if (s.a2 == 0.0f) return result;
  const Kernel second = term(s.a2, s.b2, sum2);
  const ImageF other = filtered(channel, second, second);
  const float share = float(sum1 / (sum1 + sum2));
  for (std::size_t i = 0; i < result.pixels.size(); ++i)
    result.pixels[i] = share * result.pixels[i] + (1.0f - share) * other.pixels[i];
  return result;
}

/// Section 4.1: what the eye resolves, as Hunt-adjusted L*a*b*.
ImageF perceived(const ImageF& linear) {
  const ImageF opponent = mapped(linear, 3, ycxcz_from_linear);
  ImageF blurred(linear.width, linear.height, 3);
  const Sensitivity* sensitivities[]{&achromatic, &red_green, &blue_yellow};
  for (int c = 0; c < 3; ++c) {
    ImageF channel(linear.width, linear.height, 1);
    for (std::size_t i = 0; i < channel.pixels.size(); ++i)
      channel.pixels[i] = opponent.pixels[3 * i + std::size_t(c)];
    channel = seen(channel, *sensitivities[c]);
    for (std::size_t i = 0; i < channel.pixels.size(); ++i)
      blurred.pixels[3 * i + std::size_t(c)] = channel.pixels[i];
  }
  return mapped(blurred, 3, [](vec3 ycxcz) {
    return hunt_adjusted(lab_from_linear(glm::clamp(linear_from_ycxcz(ycxcz), vec3(0.0f), vec3(1.0f))));
  });
}

/// Section 4.1.3: the largest distance, green against blue, maps to 1, with more room for small differences.
float redistributed(float distance) {
  static const float maximum =
      std::pow(hyab(hunt_adjusted(lab_from_linear({0, 1, 0})), hunt_adjusted(lab_from_linear({0, 0, 1}))),
               colour_exponent);
  const float error = std::pow(distance, colour_exponent), knee = colour_knee * maximum;
  return error < knee ? knee_error / knee * error
                      : knee_error + (error - knee) / (maximum - knee) * (1.0f - knee_error);
}

/// Section 4.2: edges (first derivative of a Gaussian) or points (second), as the length of the gradient.
ImageF features(const ImageF& luminance, bool is_edge) {
  const float sigma = 0.5f * feature_width_deg * pixels_per_degree;
  const int radius = int(std::ceil(3.0f * sigma));
  Kernel derivative(std::size_t(2 * radius + 1));
  float positive = 0.0f, negative = 0.0f;
  for (int x = -radius; x <= radius; ++x) {
    const float g = std::exp(-float(x * x) / (2.0f * sigma * sigma));
    const float value = is_edge ? -float(x) * g : (float(x * x) / (sigma * sigma) - 1.0f) * g;
    derivative[std::size_t(x + radius)] = value;
    (value > 0.0f ? positive : negative) += std::abs(value);
  }
  for (float& value : derivative) value /= value > 0.0f ? positive : negative;
  const Kernel smooth = gaussian(sigma, radius);
  const ImageF dx = filtered(luminance, derivative, smooth), dy = filtered(luminance, smooth, derivative);
  ImageF length(luminance.width, luminance.height, 1);
  for (std::size_t i = 0; i < length.pixels.size(); ++i)
    length.pixels[i] = std::hypot(dx.pixels[i], dy.pixels[i]);
  return length;
}

/// Luminance in 0..1, on the scale of Y of YCxCz.
ImageF luminance_of(const ImageF& linear) {
  return mapped(linear, 1, [](vec3 c) { return vec3((ycxcz_from_linear(c).x + 16.0f) / 116.0f); });
}

ImageF linear_rgb(const Image8& srgb) {
  const ImageF linear = linear_from_srgb8(srgb);
  return linear.channels == 3 ? linear : mapped(linear, 3, [](vec3 c) { return c; });
}

}  // namespace

ImageF flip(const Image8& test, const Image8& reference) {
  const ImageF linear_test = linear_rgb(test), linear_reference = linear_rgb(reference);
  const ImageF colour_test = perceived(linear_test), colour_reference = perceived(linear_reference);
  const ImageF y_test = luminance_of(linear_test), y_reference = luminance_of(linear_reference);
  const ImageF edges_test = features(y_test, true), edges_reference = features(y_reference, true);
  const ImageF points_test = features(y_test, false), points_reference = features(y_reference, false);

  ImageF error(test.width, test.height, 1);
  for (int y = 0; y < test.height; ++y)
    for (int x = 0; x < test.width; ++x) {
      const float colour = redistributed(hyab(pixel(colour_test, x, y), pixel(colour_reference, x, y)));
      const float feature = std::max(std::abs(*edges_test.at(x, y) - *edges_reference.at(x, y)),
                                     std::abs(*points_test.at(x, y) - *points_reference.at(x, y)));
      const float emphasis = std::pow(std::min(feature / std::sqrt(2.0f), 1.0f), feature_exponent);
      *error.at(x, y) = std::pow(std::clamp(colour, 0.0f, 1.0f), 1.0f - emphasis);
    }
  return error;
}

}  // namespace parvis::reference
