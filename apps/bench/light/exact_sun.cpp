#include "bench/light/exact_sun.h"

#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "graphics/reference/camera_ray.h"

namespace parvis::bench {
namespace {

constexpr double min_facing = 0.03, min_m = 1e-4;

}  // namespace

SunPicture exact_sun(const DoubleTracer& tracer, const Camera& camera, const JudgedPixels& pixels,
                     glm::dvec3 to_sun, const DoubleTracer* unknown) {
  SunPicture picture(pixels.count(), -1);
  const reference::CameraRays rays(camera, pixels.width, pixels.height);
  const auto columns = std::size_t(pixels.columns());
  parallel_for(std::size_t(pixels.rows()), [&](std::size_t row) {
    for (std::size_t column = 0; column < columns; ++column) {
      const reference::Ray ray = rays.through(
          {float(column * std::size_t(pixels.step)) + 0.5f, float(row * std::size_t(pixels.step)) + 0.5f});
      const glm::dvec3 origin(ray.origin), direction = glm::normalize(glm::dvec3(ray.direction));
      const auto hit = tracer.nearest(origin, direction, double(ray.min_m), StoppedBy::front);
      if (!hit || glm::dot(hit->normal, to_sun) < min_facing) continue;
      const glm::dvec3 point = origin + hit->distance_m * direction;
      if (unknown) {
        const auto before = unknown->nearest(origin, direction, double(ray.min_m), StoppedBy::both);
        if ((before && before->distance_m < hit->distance_m + min_m) ||
            unknown->is_blocked(point, to_sun, 0.0, StoppedBy::both))
          continue;
      }
      picture[row * columns + column] = tracer.is_blocked(point, to_sun, min_m, StoppedBy::back) ? 0 : 1;
    }
  });
  return picture;
}

void WrongSun::add(const SunPicture& truth, const SunShares& shares) {
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (truth[i] < 0) continue;
    ++pixels;
    wrong += (shares[i] > half_lit) != (truth[i] > 0);
    off += std::abs(double(shares[i]) - double(truth[i]));
  }
}

double WrongSun::percent() const {
  return pixels > 0 ? 100.0 * double(wrong) / double(pixels) : std::numeric_limits<double>::quiet_NaN();
}

double WrongSun::mean_off_percent() const {
  return pixels > 0 ? 100.0 * off / double(pixels) : std::numeric_limits<double>::quiet_NaN();
}

glm::vec3 turned_sun(glm::vec3 to_sun, float degrees) {
  const glm::dvec3 sun = glm::normalize(glm::dvec3(to_sun));
  const glm::dvec3 aside = glm::normalize(glm::cross(glm::dvec3(0.0, 0.0, 1.0), sun));
  const double angle = glm::radians(double(degrees));
  return glm::vec3(glm::normalize(std::cos(angle) * sun + std::sin(angle) * aside));
}

}  // namespace parvis::bench
