#include "capture/facades/rephotography.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"

namespace parvis::facades {
namespace {

struct Fit {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  void add(double a, double b) { ++n, x += a, y += b, xx += a * a, xy += a * b, yy += b * b; }
  /// Sum of squared errors of b as it is, and of the best slope * a + offset.
  double raw() const { return xx - 2 * xy + yy; }
  double corrected() const {
    const double cov = xy - x * y / n, var = xx - x * x / n, all = yy - y * y / n;
    return var > 0 ? all - cov * cov / var : all;
  }
  double correlation() const {
    const double cov = xy - x * y / n, va = xx - x * x / n, vb = yy - y * y / n;
    // Two flat windows agree; a flat one and another do not. Half a grey level of noise is flat.
    const double flat = 0.25 * n;
    if (va < flat && vb < flat) return 1.0;
    return va < flat || vb < flat ? 0.0 : cov / std::sqrt(va * vb);
  }
};

double psnr(double squared, double count) {
  return 10.0 * std::log10(255.0 * 255.0 * count / std::max(squared, 1e-9));
}

double luma(const std::uint8_t* p) { return 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2]; }

}  // namespace

Rephotography rephotography(const Image8& rendered, const Image8& photograph, const Image8& counts) {
  std::array<Fit, 3> fits;
  double covered = 0, all = 0;
  const auto is_counted = [&](int x, int y) { return counts.empty() || *counts.at(x, y) > 127; };
  const auto is_covered = [&](int x, int y) { return rendered.at(x, y)[3] > 0 && is_counted(x, y); };
  for (int y = 0; y < rendered.height; ++y)
    for (int x = 0; x < rendered.width; ++x) {
      all += is_counted(x, y);
      if (!is_covered(x, y)) continue;
      ++covered;
      for (int c = 0; c < 3; ++c) fits[std::size_t(c)].add(rendered.at(x, y)[c], photograph.at(x, y)[c]);
    }
  Rephotography result;
  if (covered == 0) return result;
  result.covered_percent = 100.0 * covered / all;
  result.psnr_db = psnr(fits[0].raw() + fits[1].raw() + fits[2].raw(), 3 * covered);
  result.psnr_cc_db = psnr(fits[0].corrected() + fits[1].corrected() + fits[2].corrected(), 3 * covered);

  std::vector<double> sums(std::size_t(rendered.height), 0.0), windows(std::size_t(rendered.height), 0.0);
  parallel_for(std::size_t(rendered.height), [&](std::size_t row) {
    const int y = int(row);
    for (int x = 0; x < rendered.width; ++x) {
      if (!is_covered(x, y)) continue;
      Fit window;
      for (int v = std::max(y - ncc_radius, 0); v <= std::min(y + ncc_radius, rendered.height - 1); ++v)
        for (int u = std::max(x - ncc_radius, 0); u <= std::min(x + ncc_radius, rendered.width - 1); ++u)
          if (is_covered(u, v)) window.add(luma(rendered.at(u, v)), luma(photograph.at(u, v)));
      sums[row] += 1.0 - window.correlation(), ++windows[row];
    }
  });
  double sum = 0.0;
  for (const double s : sums) sum += s;
  result.error = sum / covered;
  return result;
}

}  // namespace parvis::facades
