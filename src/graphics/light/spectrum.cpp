#include "graphics/light/spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace parvis::light {
namespace {

// Means over 10 nm: 360 to 370 nm, ..., 830 to 840 nm.
constexpr int table_size = 48;
constexpr double table_first_nm = 365.0, table_step_nm = 10.0;

/// Irradiance of the sun above the atmosphere, W/m2/nm: ASTM G-173, column "extraterrestrial".
constexpr double solar_irradiance[table_size] = {
    1.11776, 1.14259, 1.01249, 1.14716, 1.72765, 1.73054, 1.6887,  1.61253, 1.91198, 2.03474,
    2.02042, 2.02212, 1.93377, 1.95809, 1.91686, 1.8298,  1.8685,  1.8931,  1.85149, 1.8504,
    1.8341,  1.8345,  1.8147,  1.78158, 1.7533,  1.6965,  1.68194, 1.64654, 1.6048,  1.52143,
    1.55622, 1.5113,  1.474,   1.4482,  1.41018, 1.36775, 1.34188, 1.31429, 1.28303, 1.26758,
    1.2367,  1.2082,  1.18737, 1.14683, 1.12362, 1.1058,  1.07124, 1.04992};

/// m2 per molecule at 233 K: Gorshelev, Serdyuchenko et al. 2014.
constexpr double ozone[table_size] = {
    1.18e-27,  2.182e-28, 2.818e-28, 6.636e-28, 1.527e-27, 2.763e-27, 5.52e-27,  8.451e-27,
    1.582e-26, 2.316e-26, 3.669e-26, 4.924e-26, 7.752e-26, 9.016e-26, 1.48e-25,  1.602e-25,
    2.139e-25, 2.755e-25, 3.091e-25, 3.5e-25,   4.266e-25, 4.672e-25, 4.398e-25, 4.701e-25,
    5.019e-25, 4.305e-25, 3.74e-25,  3.215e-25, 2.662e-25, 2.238e-25, 1.852e-25, 1.473e-25,
    1.209e-25, 9.423e-26, 7.455e-26, 6.566e-26, 5.105e-26, 4.15e-26,  4.228e-26, 3.237e-26,
    2.451e-26, 2.801e-26, 2.534e-26, 1.624e-26, 1.465e-26, 2.078e-26, 1.383e-26, 7.105e-27};

double at(const double (&table)[table_size], double nm) {
  const double place = std::clamp((nm - table_first_nm) / table_step_nm, 0.0, double(table_size - 1));
  const int left = std::min(int(place), table_size - 2);
  return table[left] + (place - left) * (table[left + 1] - table[left]);
}

double lobe(double nm, double middle, double below, double above) {
  const double distance = (nm - middle) / (nm < middle ? below : above);
  return std::exp(-0.5 * distance * distance);
}

/// The CIE 1931 observer as fitted by Wyman, Sloan and Shirley 2013 (Simple Analytic Approximations to the
/// CIE XYZ Color Matching Functions, JCGT 2(2), multi-lobe fit): within 1 % of the tables.
glm::dvec3 observer(double nm) {
  return {1.056 * lobe(nm, 599.8, 37.9, 31.0) + 0.362 * lobe(nm, 442.0, 16.0, 26.7) -
              0.065 * lobe(nm, 501.1, 20.4, 26.2),
          0.821 * lobe(nm, 568.8, 46.9, 40.5) + 0.286 * lobe(nm, 530.9, 16.3, 31.1),
          1.217 * lobe(nm, 437.0, 11.8, 36.0) + 0.681 * lobe(nm, 459.0, 26.0, 13.8)};
}

/// The band that stands for a wavelength: the outer ones also for what lies beyond.
int band_of(double nm) {
  return std::clamp(int(std::lround((nm - first_band_nm) / band_width_nm)), 0, band_count - 1);
}

std::array<glm::dvec3, band_count> sunlight_of_bands() {
  std::array<glm::dvec3, band_count> sums{};
  for (int i = 360; i < 830; ++i) {
    const double nm = i + 0.5;
    sums[std::size_t(band_of(nm))] += at(solar_irradiance, nm) * observer(nm);
  }
  return sums;
}

}  // namespace

glm::dvec3 xyz(const Spectrum& share) {
  static const std::array<glm::dvec3, band_count> sunlight = sunlight_of_bands();
  glm::dvec3 sum(0.0);
  for (int i = 0; i < band_count; ++i) sum += double(share[i]) * sunlight[std::size_t(i)];
  return sum;
}

Spectrum ozone_cross_section() {
  Spectrum result;
  for (int band = 0; band < band_count; ++band) {
    double sum = 0.0;
    for (int i = 0; i < 40; ++i) sum += at(ozone, wavelength_nm(band) - 0.5 * band_width_nm + i + 0.5);
    result[band] = float(sum / 40.0);
  }
  return result;
}

glm::vec3 rec709_from_xyz(glm::vec3 c) {
  return {3.2404542f * c.x - 1.5371385f * c.y - 0.4985314f * c.z,
          -0.9692660f * c.x + 1.8760108f * c.y + 0.0415560f * c.z,
          0.0556434f * c.x - 0.2040259f * c.y + 1.0572252f * c.z};
}

glm::vec3 xyz_from_rec709(glm::vec3 c) {
  return {0.4124564f * c.x + 0.3575761f * c.y + 0.1804375f * c.z,
          0.2126729f * c.x + 0.7151522f * c.y + 0.0721750f * c.z,
          0.0193339f * c.x + 0.1191920f * c.y + 0.9503041f * c.z};
}

}  // namespace parvis::light
