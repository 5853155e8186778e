#include "planning/photomontage/caption.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <vector>

#include "planning/plan_drawing/text_outlines.h"

namespace parvis::photomontage {
namespace {

using Rings = std::vector<std::vector<glm::dvec3>>;

constexpr int samples_across = 4;  ///< of a pixel, for smooth letters

/// Crossings of the rings with a level line, in order: letters lie between the first and second, the third
/// and fourth, ...
std::vector<double> crossings(const Rings& rings, double y) {
  std::vector<double> at;
  for (const std::vector<glm::dvec3>& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const glm::dvec3 &a = ring[i], &b = ring[(i + 1) % ring.size()];
      if ((a.y > y) != (b.y > y)) at.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
    }
  std::ranges::sort(at);
  return at;
}

/// Fills a letter in black. Its y counts upward from the picture's lower edge, in pixels.
void fill(const Rings& rings, Image8& picture) {
  double left = 1e9, right = -1e9, low = 1e9, high = -1e9;
  for (const std::vector<glm::dvec3>& ring : rings)
    for (const glm::dvec3& corner : ring) {
      left = std::min(left, corner.x), right = std::max(right, corner.x);
      low = std::min(low, corner.y), high = std::max(high, corner.y);
    }
  const int first = std::max(int(left), 0), last = std::min(int(right) + 1, picture.width);
  for (int row = std::max(int(low), 0); row <= int(high) && row < picture.height; ++row) {
    std::vector<int> hits(std::size_t(std::max(last - first, 0)), 0);
    for (int j = 0; j < samples_across; ++j) {
      const std::vector<double> at = crossings(rings, row + (j + 0.5) / samples_across);
      for (std::size_t i = 0; i + 1 < at.size(); i += 2)
        for (int x = first; x < last; ++x)
          for (int k = 0; k < samples_across; ++k) {
            const double sample = x + (k + 0.5) / samples_across;
            hits[std::size_t(x - first)] += sample >= at[i] && sample < at[i + 1];
          }
    }
    for (int x = first; x < last; ++x) {
      const int grey = 255 - 255 * hits[std::size_t(x - first)] / (samples_across * samples_across);
      std::uint8_t* pixel = picture.at(x, picture.height - 1 - row);
      for (int c = 0; c < 3; ++c) pixel[c] = std::uint8_t(std::min(int(pixel[c]), grey));
    }
  }
}

double width_of(const std::string& line, double height) {
  double right = 0.0;
  for (const Rings& letter : plan_drawing::text_outlines({.text = line, .height_m = height}))
    for (const std::vector<glm::dvec3>& ring : letter)
      for (const glm::dvec3& corner : ring) right = std::max(right, corner.x);
  return right;
}

/// The words in lines of this width at most, where each word fits.
std::vector<std::string> lines_of(const std::string& text, double height, double width) {
  std::vector<std::string> lines{""};
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string word = text.substr(at, end - at);
    at = end + 1;
    const std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
    if (lines.back().empty() || width_of(longer, height) <= width)
      lines.back() = longer;
    else
      lines.push_back(word);
  }
  return lines;
}

}  // namespace

Result<Image8> with_caption(const Image8& picture, const std::string& text) {
  if (Status status = plan_drawing::letters_known(); !status) return status.errors();
  const double height = std::max(8.0, picture.height / 70.0), margin = 1.2 * height;
  const std::vector<std::string> lines = lines_of(text, height, picture.width - 2.0 * margin);
  const double line_step = 1.9 * height;
  const int strip = int(std::ceil(2.0 * margin + height + line_step * double(lines.size() - 1)));
  Image8 whole(picture.width, picture.height + strip, 3, 255);
  std::ranges::copy(picture.pixels, whole.pixels.begin());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const double base = margin + line_step * double(lines.size() - 1 - i);
    for (const Rings& letter :
         plan_drawing::text_outlines({.text = lines[i], .position = {margin, base, 0.0}, .height_m = height}))
      fill(letter, whole);
  }
  return whole;
}

}  // namespace parvis::photomontage
