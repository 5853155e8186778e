// Departure from Wu: each picture keeps its best partners even below the threshold, so that none is left
// alone because its largest features are few.
#include "capture/photographs/picture_pairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>

#include "base/parallel.h"

namespace parvis::photographs {
namespace {

constexpr std::size_t compared_first = 300;  ///< features of each picture that decide about a pair
constexpr std::size_t min_agreeing = 12;     ///< of these: fewer agree for no reason
constexpr std::size_t kept_partners = 6;     ///< of each picture, whatever agrees
// Angles between descriptors, radians.
constexpr double max_angle = 0.7, max_angle_ratio = 0.8;
constexpr double descriptor_length = 512.0;
constexpr std::size_t rows_at_once = 4;  ///< that share what is read of the other picture
constexpr std::size_t nobody = ~std::size_t(0);

/// 16 bits, so that products are added in pairs by one instruction.
using Descriptors = std::vector<std::int16_t>;

Descriptors widened(const PictureFeatures& features, std::size_t largest) {
  const std::size_t count = std::min(features.numbers.size(), largest) * descriptor_bytes;
  Descriptors wide(features.descriptors.begin(), features.descriptors.begin() + std::ptrdiff_t(count));
  // Whole blocks of rows; the rows added are like no other.
  wide.resize((count + rows_at_once * descriptor_bytes - 1) / (rows_at_once * descriptor_bytes) *
              (rows_at_once * descriptor_bytes));
  return wide;
}

std::array<int, rows_at_once> dots(const std::int16_t* rows, const std::int16_t* other) {
  int s0 = 0, s1 = 0, s2 = 0, s3 = 0;
  for (std::size_t i = 0; i < descriptor_bytes; ++i) {
    const int value = other[i];
    s0 += int(rows[i]) * value;
    s1 += int(rows[i + descriptor_bytes]) * value;
    s2 += int(rows[i + 2 * descriptor_bytes]) * value;
    s3 += int(rows[i + 3 * descriptor_bytes]) * value;
  }
  return {s0, s1, s2, s3};
}

double angle_of(int product) {
  return std::acos(std::clamp(double(product) / (descriptor_length * descriptor_length), 0.0, 1.0));
}

/// The nearest features of the other picture by their products, which are greatest for the nearest.
struct Nearest {
  int best = -1, second = -1;
  std::size_t index = nobody;

  void take(int product, std::size_t from) {
    if (product > best)
      second = best, best = product, index = from;
    else
      second = std::max(second, product);
  }
  bool is_distinct() const {
    return index != nobody && angle_of(best) <= max_angle &&
           (second < 0 || angle_of(best) < max_angle_ratio * angle_of(second));
  }
};

}  // namespace

std::vector<FeatureMatch> matching_features(const PictureFeatures& a, const PictureFeatures& b,
                                            std::size_t largest) {
  const Descriptors of_a = widened(a, largest), of_b = widened(b, largest);
  const std::size_t count_a = std::min(a.numbers.size(), largest),
                    count_b = std::min(b.numbers.size(), largest);
  std::vector<Nearest> to_a(of_a.size() / descriptor_bytes), to_b(count_b);
  for (std::size_t i = 0; i < count_a; i += rows_at_once)
    for (std::size_t j = 0; j < count_b; ++j) {
      const auto products = dots(of_a.data() + i * descriptor_bytes, of_b.data() + j * descriptor_bytes);
      for (std::size_t k = 0; k < rows_at_once; ++k)
        to_a[i + k].take(products[k], j), to_b[j].take(products[k], i + k);
    }
  std::vector<FeatureMatch> matches;
  for (std::size_t i = 0; i < count_a; ++i)
    if (to_a[i].is_distinct() && to_b[to_a[i].index].index == i)
      matches.emplace_back(a.numbers[i], b.numbers[to_a[i].index]);
  return matches;
}

std::vector<PicturePair> promising_pairs(const std::vector<PictureFeatures>& pictures) {
  const std::size_t count = pictures.size();
  std::vector<std::vector<std::size_t>> agreement(count, std::vector<std::size_t>(count, 0));
  parallel_for(count, [&](std::size_t a) {
    for (std::size_t b = a + 1; b < count; ++b)
      agreement[a][b] = matching_features(pictures[a], pictures[b], compared_first).size();
  });
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = 0; b < a; ++b) agreement[a][b] = agreement[b][a];

  std::set<PicturePair> pairs;
  for (std::size_t a = 0; a < count; ++a) {
    std::vector<std::size_t> partners;
    for (std::size_t b = 0; b < count; ++b)
      if (b != a) partners.push_back(b);
    std::ranges::stable_sort(partners, std::greater{}, [&](std::size_t b) { return agreement[a][b]; });
    for (std::size_t k = 0; k < partners.size(); ++k)
      if (k < kept_partners || agreement[a][partners[k]] >= min_agreeing)
        pairs.emplace(std::min(a, partners[k]), std::max(a, partners[k]));
  }
  return {pairs.begin(), pairs.end()};
}

}  // namespace parvis::photographs
