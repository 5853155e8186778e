#include "places/car_bodies/picture_masks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace parvis::car_bodies {
namespace {

constexpr float grey_tolerance = 0.085f;    // largest difference of the channels of a pane's colour
constexpr float min_pane_fraction = 0.02f;  // of all panes' area: smaller regions are seals and shadows
constexpr int grid = 128;                   // cells per side of the picture, in which regions are found
constexpr float margin = 0.006f;            // about a region, for texels of its edge

float difference(glm::vec3 a, glm::vec3 b) {
  const glm::vec3 off = glm::abs(a - b);
  return std::max({off.x, off.y, off.z});
}

bool is_rear_lamp(const SurfaceSample& s) {
  return s.forward < -0.4f && s.srgb.x > 0.5f && s.srgb.y < 0.25f && s.srgb.z < 0.25f;
}

bool is_front_lamp(const SurfaceSample& s) {
  return s.forward > 0.35f && s.srgb.x > 0.7f && s.srgb.y > 0.6f && s.srgb.z < 0.5f;
}

/// Decides whether a colour is the pale blue that simple models give their panes.
bool is_pale_blue(glm::vec3 srgb) {
  constexpr float min_blue = 0.9f, min_red = 0.7f, min_spread = 0.03f;
  return srgb.z >= min_blue && srgb.x >= min_red && srgb.x <= srgb.y && srgb.y <= srgb.z &&
         srgb.z - srgb.x >= min_spread;
}

/// Decides whether a sample is as dark as a hole or as grey as a pane, wherever it lies.
bool has_colour_of_pane(const SurfaceSample& sample, glm::vec3 paint) {
  constexpr float max_light = 0.92f;
  const float light = (sample.srgb.x + sample.srgb.y + sample.srgb.z) / 3.0f;
  const bool is_grey = spread(sample.srgb) <= grey_tolerance && light < max_light;
  return sample.is_hole ||
         ((is_grey || is_pale_blue(sample.srgb)) && difference(sample.srgb, paint) > grey_tolerance);
}

/// Panes begin above; grilles are holes, too.
bool lies_low(const SurfaceSample& sample) {
  constexpr float min_hole_height = 0.4f, min_height = 0.5f;
  return sample.height <= (sample.is_hole ? min_hole_height : min_height);
}

bool faces_up_or_down(const SurfaceSample& sample) {
  constexpr float roof_z = 0.9f, underside_z = -0.3f;
  return sample.normal.z >= roof_z || sample.normal.z <= underside_z;
}

/// Panes of one region of the picture.
struct Region {
  Bounds box;  // of texture coordinates
  float area_m2 = 0.0f, holes_m2 = 0.0f;
  float low_m2 = 0.0f;  // of what has a pane's colour in this region and lies where no panes do
  float top = 0.0f;     // fraction of the car's height
  glm::vec3 weighted_srgb{0.0f};
};

glm::ivec2 cell_of(glm::vec2 uv) {
  return glm::clamp(glm::ivec2(glm::floor(uv * float(grid))), glm::ivec2(0), glm::ivec2(grid - 1));
}

/// Regions of the picture that panes cover: cells of a grid that touch one another.
std::vector<Region> regions_of(std::span<const SurfaceSample> samples, glm::vec3 paint) {
  std::vector<SurfaceSample> panes;
  std::ranges::copy_if(samples, std::back_inserter(panes),
                       [&](const SurfaceSample& sample) { return is_pane(sample, paint); });
  std::vector<int> region(std::size_t(grid) * grid, -1);
  const auto at = [&](int x, int y) -> int& { return region[std::size_t(y) * grid + std::size_t(x)]; };
  constexpr int covered = -2;
  for (const SurfaceSample& sample : panes) {
    const auto& uvs = sample.corner_uvs;
    const glm::ivec2 low = cell_of(glm::min(uvs[0], glm::min(uvs[1], uvs[2])));
    const glm::ivec2 high = cell_of(glm::max(uvs[0], glm::max(uvs[1], uvs[2])));
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x) at(x, y) = covered;
  }
  int count = 0;
  std::vector<glm::ivec2> open;
  for (int y = 0; y < grid; ++y)
    for (int x = 0; x < grid; ++x) {
      if (at(x, y) != covered) continue;
      open.push_back({x, y});
      at(x, y) = count;
      while (!open.empty()) {
        const glm::ivec2 here = open.back();
        open.pop_back();
        for (int ny = std::max(0, here.y - 1); ny <= std::min(grid - 1, here.y + 1); ++ny)
          for (int nx = std::max(0, here.x - 1); nx <= std::min(grid - 1, here.x + 1); ++nx)
            if (at(nx, ny) == covered) at(nx, ny) = count, open.push_back({nx, ny});
      }
      ++count;
    }
  std::vector<Region> regions{std::size_t(count)};
  for (const SurfaceSample& sample : samples) {
    const glm::ivec2 cell = cell_of(sample.uv);
    const int here = at(cell.x, cell.y);
    if (here >= 0 && sample.is_outer && lies_low(sample) && has_colour_of_pane(sample, paint))
      regions[std::size_t(here)].low_m2 += sample.area_m2;
  }
  for (const SurfaceSample& sample : panes) {
    const glm::ivec2 cell = cell_of(sample.uv);
    Region& here = regions[std::size_t(at(cell.x, cell.y))];
    here.top = std::max(here.top, sample.top);
    for (const glm::vec2& uv : sample.corner_uvs) here.box.add(glm::vec3(uv, 0.0f));
    here.area_m2 += sample.area_m2;
    if (sample.is_hole) here.holes_m2 += sample.area_m2;
    here.weighted_srgb += sample.area_m2 * sample.srgb;
  }
  return regions;
}

/// The colour of the holes in a box of a picture, where they have one, as the mask's condition.
void add_colour_of_holes(const Image8& picture, PictureMask& mask) {
  constexpr int max_texels = 256;         // looked at along each side
  constexpr float max_tolerance = 0.12f;  // beyond it the holes have all sorts of colours
  constexpr float quantile = 0.98f, slack = 0.03f;
  if (!mask.box) return;
  const glm::ivec2 size(picture.width, picture.height);
  const glm::ivec2 low = glm::ivec2(glm::vec2(mask.box->min) * glm::vec2(size));
  const glm::ivec2 high = glm::min(glm::ivec2(glm::vec2(mask.box->max) * glm::vec2(size)), size - 1);
  const glm::ivec2 step = glm::max((high - low) / max_texels, glm::ivec2(1));
  std::vector<glm::vec3> colours;
  for (int y = low.y; y <= high.y; y += step.y)
    for (int x = low.x; x <= high.x; x += step.x)
      if (const std::uint8_t* texel = picture.at(x, y); picture.channels == 4 && texel[3] < 128)
        colours.push_back(glm::vec3(texel[0], texel[1], texel[2]) / 255.0f);
  if (colours.empty()) return;
  glm::vec3 mean(0.0f);
  for (const glm::vec3& colour : colours) mean += colour / float(colours.size());
  std::vector<float> off;
  off.reserve(colours.size());
  for (const glm::vec3& colour : colours) off.push_back(difference(colour, mean));
  const auto wide = off.begin() + std::ptrdiff_t(quantile * float(off.size() - 1));
  std::ranges::nth_element(off, wide);
  if (*wide > max_tolerance) return;
  mask.colour = mean, mask.tolerance = *wide + slack;
}

PictureMask pane_mask(const Image8& picture, const Region& region, glm::vec3 paint) {
  constexpr float min_tolerance = 0.03f, max_tolerance = 0.15f;
  PictureMask mask;
  mask.box = Bounds{glm::max(region.box.min - margin, 0.0f), glm::min(region.box.max + margin, 1.0f)};
  const glm::vec3 mean = region.weighted_srgb / region.area_m2;
  if (region.holes_m2 > 0.5f * region.area_m2) {
    add_colour_of_holes(picture, mask);
  } else if (spread(paint) > grey_tolerance && !is_pale_blue(mean)) {
    mask.is_grey = true, mask.tolerance = grey_tolerance;
  } else {  // panes of a colour of their own; white, silver and black paint are grey, too
    mask.colour = mean;
    mask.tolerance = glm::clamp(0.5f * difference(mean, paint), min_tolerance, max_tolerance);
  }
  return mask;
}

std::vector<PictureMask> glass_masks(const Image8& picture, std::span<const SurfaceSample> samples,
                                     glm::vec3 paint, float all_panes_m2) {
  std::vector<PictureMask> masks;
  for (const Region& region : regions_of(samples, paint)) {
    const bool is_large = region.area_m2 >= min_pane_fraction * all_panes_m2 && region.area_m2 > 0.0f;
    if (is_large && reaches_roof(region.top) && region.low_m2 <= region.area_m2)
      masks.push_back(pane_mask(picture, region, paint));
  }
  return masks;
}

/// A mask of the mean colour of the samples that `takes`; none where they are too few, or where it would hold
/// much more of the skin than them: then the colour is that of paint.
template <class Takes>
void add_lamp(std::span<const SurfaceSample> samples, const Takes& takes, std::vector<PictureMask>& masks) {
  constexpr float min_m2 = 0.005f, lamp_tolerance = 0.25f, max_held = 4.0f;
  glm::vec3 sum(0.0f);
  float area_m2 = 0.0f, held_m2 = 0.0f;
  for (const SurfaceSample& sample : samples)
    if (takes(sample)) sum += sample.area_m2 * sample.srgb, area_m2 += sample.area_m2;
  if (area_m2 < min_m2) return;
  const PictureMask mask{.colour = sum / area_m2, .tolerance = lamp_tolerance};
  for (const SurfaceSample& sample : samples)
    if (sample.is_outer && mask.holds(sample)) held_m2 += sample.area_m2;
  if (held_m2 <= max_held * area_m2) masks.push_back(mask);
}

}  // namespace

std::string PictureMask::text() const {
  std::string text;
  if (box)
    text += fmt::format("box {:.3f} {:.3f} {:.3f} {:.3f}", box->min.x, box->min.y, box->max.x, box->max.y);
  const char* const gap = text.empty() ? "" : " ";
  if (colour) {
    const glm::ivec3 rgb(255.0f * glm::clamp(*colour, 0.0f, 1.0f) + 0.5f);
    text += fmt::format("{}colour #{:02X}{:02X}{:02X} {:.2g}", gap, rgb.x, rgb.y, rgb.z, tolerance);
  }
  if (is_grey) text += fmt::format("{}grey {:.2g}", gap, tolerance);
  return text;
}

bool PictureMask::holds(const SurfaceSample& sample) const {
  const glm::vec2 uv = sample.uv;
  if (box && (uv.x < box->min.x || uv.x > box->max.x || uv.y < box->min.y || uv.y > box->max.y)) return false;
  return (!colour || difference(*colour, sample.srgb) <= tolerance) &&
         (!is_grey || spread(sample.srgb) <= tolerance);
}

glm::vec3 paint_of(std::span<const SurfaceSample> samples) {
  constexpr float steps = 16.0f;  // per channel
  std::map<std::array<int, 3>, float> areas;
  for (const SurfaceSample& sample : samples) {
    if (!sample.is_outer || sample.is_hole || sample.height < 0.3f || sample.height > 0.6f) continue;
    const glm::ivec3 step(steps * sample.srgb);
    areas[{step.x, step.y, step.z}] += sample.area_m2;
  }
  const auto maximum = std::ranges::max_element(areas, {}, [](const auto& each) { return each.second; });
  if (maximum == areas.end()) return glm::vec3(1.0f, 0.0f, 0.0f);
  return (glm::vec3(maximum->first[0], maximum->first[1], maximum->first[2]) + 0.5f) / steps;
}

bool is_pane(const SurfaceSample& sample, glm::vec3 paint) {
  return sample.is_outer && !lies_low(sample) && has_colour_of_pane(sample, paint) &&
         (sample.is_hole || !faces_up_or_down(sample));
}

bool reaches_roof(float top) {
  constexpr float min_top = 0.65f;  // a rack or an aerial may be a third of the height of the body
  return top >= min_top;
}

bool is_lamp(const SurfaceSample& sample, glm::vec3 paint) {
  return sample.is_outer && (is_rear_lamp(sample) || is_front_lamp(sample)) &&
         difference(sample.srgb, paint) > grey_tolerance;
}

PictureMasks find_masks(const Image8& picture, std::span<const SurfaceSample> samples, glm::vec3 paint,
                        float all_panes_m2) {
  PictureMasks masks;
  masks.glass = glass_masks(picture, samples, paint, all_panes_m2);
  for (const auto is_one : {is_rear_lamp, is_front_lamp})
    add_lamp(
        samples, [&](const SurfaceSample& sample) { return is_lamp(sample, paint) && is_one(sample); },
        masks.lamps);
  return masks;
}

}  // namespace parvis::car_bodies
