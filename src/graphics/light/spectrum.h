// Light in eight bands of the visible spectrum, each as a share of what the sun sends above the atmosphere,
// and the same light as CIE XYZ. Scattering is computed in bands because air, haze and ozone act on each
// wavelength by itself: three bands give a twilight of the wrong blue.
#pragma once

#include <array>
#include <cmath>
#include <glm/glm.hpp>

namespace parvis::light {

inline constexpr int band_count = 8;
inline constexpr double first_band_nm = 410.0,
                        band_width_nm = 40.0;  ///< bands are centred at 410, 450, ... 690 nm

/// A number for each band, with the operations of each band by itself. The loops become vector instructions.
struct Spectrum {
  std::array<float, band_count> values{};

  Spectrum() = default;
  explicit Spectrum(float value) { values.fill(value); }
  float& operator[](int band) { return values[std::size_t(band)]; }
  float operator[](int band) const { return values[std::size_t(band)]; }

  Spectrum& operator+=(const Spectrum& other) {
    for (int i = 0; i < band_count; ++i) (*this)[i] += other[i];
    return *this;
  }
  Spectrum& operator*=(const Spectrum& other) {
    for (int i = 0; i < band_count; ++i) (*this)[i] *= other[i];
    return *this;
  }
  Spectrum& operator*=(float factor) {
    for (float& value : values) value *= factor;
    return *this;
  }
};
inline Spectrum operator+(Spectrum a, const Spectrum& b) { return a += b; }
inline Spectrum operator*(Spectrum a, const Spectrum& b) { return a *= b; }
inline Spectrum operator*(Spectrum a, float factor) { return a *= factor; }
inline Spectrum operator*(float factor, Spectrum a) { return a *= factor; }
/// exp(-a)
inline Spectrum attenuation(Spectrum a) {
  for (float& value : a.values) value = std::exp(-value);
  return a;
}

/// Wavelength of a band's centre in nanometres.
inline double wavelength_nm(int band) { return first_band_nm + band_width_nm * band; }

/// XYZ of light of which `share` gives each band's share of sunlight above the atmosphere at one astronomical
/// unit: with a share of 1, XYZ is the sun's irradiance. Y is in W/m2 weighted by the eye: 683 lm/W make it
/// lux (or cd/m2 for radiance).
glm::dvec3 xyz(const Spectrum& share);

/// Cross section of ozone, m2 per molecule.
Spectrum ozone_cross_section();

inline constexpr double lumens_per_watt = 683.0;

/// Linear Rec. 709 of XYZ and back (IEC 61966-2-1, white D65). Colours outside Rec. 709 have negative
/// channels.
glm::vec3 rec709_from_xyz(glm::vec3 xyz);
/// The same with negative channels set to 0.
inline glm::vec3 displayable(glm::vec3 xyz) { return glm::max(rec709_from_xyz(xyz), glm::vec3(0.0f)); }
/// CIE 1931 XYZ of linear Rec. 709.
glm::vec3 xyz_from_rec709(glm::vec3 rgb);

}  // namespace parvis::light
