// The product of the Laplacian with a vector needs no matrix: with a_k, b_k the affine function that fits x
// in the window k best (ridge regression), (L x)_i is the sum of x_i - a_k . I_i - b_k over the windows that
// hold i.
#include "capture/trees/matting_laplacian.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>

#include "base/parallel.h"

namespace parvis::trees {
namespace {

constexpr float regularisation = 1e-5f;  // of a window's covariance, colours 0..1
constexpr float known_weight = 10.0f;    // of pixels in zones
constexpr int max_iterations = 300;
constexpr double min_residual = 1e-4;  // of the first residual's length

class Laplacian {
 public:
  Laplacian(const Image8& photograph, const Zones& zones)
      : width_(photograph.width), height_(photograph.height), zones_(zones) {
    const std::size_t count = zones.pixels.size();
    colours_.resize(count), means_.resize(count), inverses_.resize(count);
    fits_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint8_t* p = photograph.pixels.data() + i * std::size_t(photograph.channels);
      colours_[i] = glm::vec3(float(p[0]), float(p[1]), float(p[2])) / 255.0f;
    }
    each_window([&](std::size_t k, const auto& pixels) {
      glm::vec3 sum(0.0f);
      glm::mat3 squares(0.0f);
      for (const std::size_t i : pixels)
        sum += colours_[i], squares += glm::outerProduct(colours_[i], colours_[i]);
      means_[k] = sum / 9.0f;
      inverses_[k] = glm::inverse(squares / 9.0f - glm::outerProduct(means_[k], means_[k]) +
                                  glm::mat3(regularisation / 9.0f));
    });
  }

  /// y = (L + D) x, D: known_weight where the zone is known.
  void multiply(const std::vector<float>& x, std::vector<float>& y) {
    each_window([&](std::size_t k, const auto& pixels) {
      float mean = 0.0f;
      glm::vec3 together(0.0f);
      for (const std::size_t i : pixels) mean += x[i], together += x[i] * colours_[i];
      mean /= 9.0f;
      const glm::vec3 slope = inverses_[k] * (together / 9.0f - mean * means_[k]);
      fits_[k] = glm::vec4(slope, mean - glm::dot(slope, means_[k]));
    });
    parallel_for(std::size_t(height_), [&](std::size_t row) {
      for (int column = 0; column < width_; ++column) {
        const std::size_t i = row * std::size_t(width_) + std::size_t(column);
        glm::vec4 sum(0.0f);
        float windows = 0.0f;
        for (int v = std::max(int(row) - 1, 1); v <= std::min(int(row) + 1, height_ - 2); ++v)
          for (int u = std::max(column - 1, 1); u <= std::min(column + 1, width_ - 2); ++u)
            sum += fits_[std::size_t(v) * std::size_t(width_) + std::size_t(u)], windows += 1.0f;
        y[i] = windows * x[i] - glm::dot(glm::vec3(sum), colours_[i]) - sum.w + known(i) * x[i];
      }
    });
  }
  /// The right-hand side: known_weight where a pixel is known to be foreground.
  float known(std::size_t i) const { return zones_.pixels[i] == Zone::unknown ? 0.0f : known_weight; }

 private:
  template <class Act>
  void each_window(Act&& act) {
    parallel_for(std::size_t(std::max(height_ - 2, 0)), [&](std::size_t above) {
      for (int u = 1; u + 1 < width_; ++u) {
        const std::size_t k = (above + 1) * std::size_t(width_) + std::size_t(u), w = std::size_t(width_);
        act(k, std::array<std::size_t, 9>{k - w - 1, k - w, k - w + 1, k - 1, k, k + 1, k + w - 1, k + w,
                                          k + w + 1});
      }
    });
  }

  int width_, height_;
  const Zones& zones_;
  std::vector<glm::vec3> colours_, means_;
  std::vector<glm::mat3> inverses_;
  std::vector<glm::vec4> fits_;
};

double product(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += double(a[i]) * double(b[i]);
  return sum;
}

}  // namespace

std::vector<float> laplacian_alpha(const Image8& photograph, const Zones& zones, std::vector<float> x) {
  Laplacian laplacian(photograph, zones);
  std::vector<float> residual(x.size()), step, image(x.size());
  laplacian.multiply(x, image);
  for (std::size_t i = 0; i < x.size(); ++i)
    residual[i] = (zones.pixels[i] == Zone::foreground ? laplacian.known(i) : 0.0f) - image[i];
  step = residual;
  double length = product(residual, residual);
  const double enough = min_residual * min_residual * length;
  for (int iteration = 0; iteration < max_iterations && length > enough; ++iteration) {
    laplacian.multiply(step, image);
    const float along = float(length / product(step, image));
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += along * step[i], residual[i] -= along * image[i];
    const double next = product(residual, residual);
    const float turn = float(next / length);
    for (std::size_t i = 0; i < x.size(); ++i) step[i] = residual[i] + turn * step[i];
    length = next;
  }
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = zones.pixels[i] == Zone::unknown ? std::clamp(x[i], 0.0f, 1.0f)
                                            : float(zones.pixels[i] == Zone::foreground);
  return x;
}

}  // namespace parvis::trees
