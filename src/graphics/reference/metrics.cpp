#include "graphics/reference/metrics.h"

#include <array>
#include <cmath>
#include <limits>

#include "base/colour.h"
#include "graphics/reference/filter.h"
#include "graphics/reference/flip.h"

namespace parvis::reference {
namespace {

/// Mean of value(x, y) over the pixels that count.
template <class Value>
double masked_mean(const Image8& mask, int width, int height, const Value& value) {
  double sum = 0.0, count = 0.0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (mask.empty() || mask.at(x, y)[0] >= 128) sum += value(x, y), count += 1.0;
  return count > 0.0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

double psnr(const Image8& a, const Image8& b, const Image8& mask) {
  const double error = masked_mean(mask, a.width, a.height, [&](int x, int y) {
    double sum = 0.0;
    for (int c = 0; c < 3; ++c) {
      const double d = double(a.at(x, y)[c]) - double(b.at(x, y)[c]);
      sum += d * d / 3.0;
    }
    return sum;
  });
  return error > 0.0 ? 10.0 * std::log10(255.0 * 255.0 / error) : std::numeric_limits<double>::infinity();
}

/// Luma of the encoded picture, 0..255, as Wang et al. compare.
ImageF luma(const Image8& image) {
  ImageF result(image.width, image.height, 1);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* p = image.at(x, y);
      *result.at(x, y) = 0.299f * float(p[0]) + 0.587f * float(p[1]) + 0.114f * float(p[2]);
    }
  return result;
}

double ssim(const Image8& image_a, const Image8& image_b, const Image8& mask) {
  constexpr double c1 = 0.01 * 255 * 0.01 * 255, c2 = 0.03 * 255 * 0.03 * 255;
  const ImageF a = luma(image_a), b = luma(image_b);
  const Kernel window = gaussian(1.5f, 5);
  const auto mean_of = [&](const ImageF& p, const ImageF& q) {
    ImageF product(p.width, p.height, 1);
    for (std::size_t i = 0; i < product.pixels.size(); ++i) product.pixels[i] = p.pixels[i] * q.pixels[i];
    return filtered(product, window, window);
  };
  const ImageF mean_a = filtered(a, window, window), mean_b = filtered(b, window, window);
  const ImageF aa = mean_of(a, a), bb = mean_of(b, b), ab = mean_of(a, b);
  return masked_mean(mask, a.width, a.height, [&](int x, int y) {
    const double ma = double(*mean_a.at(x, y)), mb = double(*mean_b.at(x, y));
    const double va = double(*aa.at(x, y)) - ma * ma, vb = double(*bb.at(x, y)) - mb * mb;
    const double covariance = double(*ab.at(x, y)) - ma * mb;
    return (2 * ma * mb + c1) * (2 * covariance + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
  });
}

}  // namespace

Result<Difference> compare(const Image8& test, const Image8& reference, const Image8& mask) {
  if (test.width != reference.width || test.height != reference.height)
    return error("pictures of {} x {} and {} x {} cannot be compared; render both at one size", test.width,
                 test.height, reference.width, reference.height);
  if (!mask.empty() && (mask.width != test.width || mask.height != test.height))
    return error("a mask of {} x {} for pictures of {} x {}; both must have one size", mask.width,
                 mask.height, test.width, test.height);
  Difference difference;
  difference.flip_map = flip(test, reference);
  difference.flip = masked_mean(mask, test.width, test.height,
                                [&](int x, int y) { return double(*difference.flip_map.at(x, y)); });
  if (std::isnan(difference.flip)) return error("the mask has no white pixel: nothing is left to compare");
  difference.psnr = psnr(test, reference, mask);
  difference.ssim = ssim(test, reference, mask);
  return difference;
}

Image8 heat_map(const ImageF& flip_map) {
  // Six colours of matplotlib's magma, as sRGB bytes.
  constexpr std::array<std::array<float, 3>, 6> stops{
      {{0, 0, 4}, {59, 15, 112}, {140, 41, 129}, {222, 73, 104}, {254, 159, 109}, {252, 253, 191}}};
  Image8 picture(flip_map.width, flip_map.height, 3);
  for (std::size_t i = 0; i < flip_map.pixels.size(); ++i) {
    const float position = std::min(std::max(flip_map.pixels[i], 0.0f), 1.0f) * float(stops.size() - 1);
    const std::size_t low = std::min(std::size_t(position), stops.size() - 2);
    const float t = position - float(low);
    for (std::size_t c = 0; c < 3; ++c)
      picture.pixels[3 * i + c] =
          std::uint8_t(std::lround((1.0f - t) * stops[low][c] + t * stops[low + 1][c]));
  }
  return picture;
}

}  // namespace parvis::reference
