#include "life/sound/band_noise.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>

#include "base/random.h"

namespace parvis::sound {
namespace {

constexpr int partials_per_band = 160;  // as many as sound like noise, and as the lowest band holds
constexpr std::uint64_t noise_seed = 48;

}  // namespace

const BandNoise& BandNoise::instance() {
  static const BandNoise noise;
  return noise;
}

BandNoise::BandNoise() : frames_(length) {
  Random random{noise_seed};
  constexpr double bin_hz = double(sample_rate) / double(length);
  for (std::size_t band = 0; band < octaves; ++band) {
    const double mid_hz = 1000.0 * std::exp2(double(band) - 4.0);
    const int low = int(std::ceil(mid_hz / std::numbers::sqrt2 / bin_hz)),
              high = int(mid_hz * std::numbers::sqrt2 / bin_hz);
    std::vector<int>& bins = partials_[band];
    for (int i = low; i < high; ++i) bins.push_back(i);
    for (std::size_t i = bins.size(); i > 1; --i)
      std::swap(bins[i - 1], bins[std::size_t(random.index(int(i)))]);
    bins.resize(std::min<std::size_t>(bins.size(), partials_per_band));
    const double amplitude = std::sqrt(2.0 / double(bins.size()));
    for (const int bin : bins) {
      const double step = 2.0 * std::numbers::pi * bin / double(length);
      const std::complex<double> turn = std::polar(1.0, step);
      std::complex<double> phasor = std::polar(amplitude, 2.0 * std::numbers::pi * double(random.uniform()));
      for (std::size_t i = 0; i < length; ++i) {
        frames_[i][band] += float(phasor.real());
        phasor *= turn;
      }
    }
  }
}

double BandNoise::add(std::span<float> samples, double place, double rate, const Octaves& from,
                      const Octaves& to) const {
  std::array<float, octaves> gain, slope;
  for (std::size_t band = 0; band < octaves; ++band) {
    gain[band] = float(from[band]);
    slope[band] = float((to[band] - from[band]) / double(samples.size()));
  }
  place -= std::floor(place / double(length)) * double(length);
  for (float& sample : samples) {
    const auto whole = std::size_t(place);
    const auto between = float(place - double(whole));
    const auto &here = frames_[whole & (length - 1)], &next = frames_[(whole + 1) & (length - 1)];
    float sum = 0.0f;
    for (std::size_t band = 0; band < octaves; ++band) {
      sum += gain[band] * (here[band] + between * (next[band] - here[band]));
      gain[band] += slope[band];
    }
    sample += sum;
    place += rate;
    if (place >= double(length)) place -= double(length);
  }
  return place;
}

double band_energy(std::span<const float> samples, std::size_t band) {
  assert(samples.size() == BandNoise::length);
  double sum = 0.0;
  for (const int bin : BandNoise::instance().partials(band)) {
    const std::complex<double> turn =
        std::polar(1.0, -2.0 * std::numbers::pi * bin / double(BandNoise::length));
    std::complex<double> phasor = 1.0, part = 0.0;
    for (const float sample : samples) part += double(sample) * phasor, phasor *= turn;
    sum += 2.0 * std::norm(part / double(BandNoise::length));
  }
  return sum;
}

}  // namespace parvis::sound
