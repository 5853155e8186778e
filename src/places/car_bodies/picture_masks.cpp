#include "places/car_bodies/picture_masks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/colour.h"

namespace parvis::car_bodies {
namespace {

constexpr float grey_tolerance = 0.085f;  // largest difference of the channels of a pane's colour
constexpr float min_pane_share = 0.02f;   // of all panes' area: smaller regions are seals and shadows
constexpr int grid = 128;                 // cells per side of the picture, in which regions are found
constexpr float margin = 0.006f;          // about a region, for texels of its edge

/// A triangle with what its picture has at the middle.
struct Sample {
  glm::vec3 centre, normal;
  float area_m2 = 0.0f;
  glm::vec2 uv[3];
  glm::vec3 srgb{0.0f};
  bool has_picture = false;
};

float spread(glm::vec3 c) { return std::max({c.x, c.y, c.z}) - std::min({c.x, c.y, c.z}); }

glm::vec3 colour_at(const Image8& picture, glm::vec2 uv) {
  uv -= glm::floor(uv);
  const int x = std::min(int(uv.x * float(picture.width)), picture.width - 1);
  const int y = std::min(int(uv.y * float(picture.height)), picture.height - 1);
  const std::uint8_t* texel = picture.at(x, y);
  return glm::vec3(texel[0], texel[1], texel[2]) / 255.0f;
}

std::vector<Sample> samples_of(const scene::Model& model) {
  std::vector<Sample> samples;
  const std::vector<glm::mat4> pose = scene::rest_pose(model);
  for (const scene::Part& part : model.parts) {
    const scene::Material& material = model.materials[std::size_t(part.material)];
    for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3) {
      Sample sample;
      std::array<glm::vec3, 3> at;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t vertex = part.mesh.indices[i + k];
        at[k] = glm::vec3(pose[std::size_t(part.node)] * glm::vec4(part.mesh.positions[vertex], 1.0f));
        sample.uv[k] = part.mesh.uvs[vertex];
      }
      const glm::vec3 sides = glm::cross(at[1] - at[0], at[2] - at[0]);
      sample.area_m2 = 0.5f * glm::length(sides);
      if (!(sample.area_m2 > 1e-8f)) continue;
      sample.normal = glm::normalize(sides);
      sample.centre = (at[0] + at[1] + at[2]) / 3.0f;
      sample.has_picture = material.base_colour_texture != scene::no_index;
      if (sample.has_picture)
        sample.srgb = colour_at(model.textures[std::size_t(material.base_colour_texture)].image,
                                (sample.uv[0] + sample.uv[1] + sample.uv[2]) / 3.0f);
      samples.push_back(sample);
    }
  }
  return samples;
}

/// The colour that covers most of the body's sides, in steps of 1/16.
glm::vec3 paint_of(const std::vector<Sample>& samples, const Bounds& bounds) {
  std::map<std::array<int, 3>, float> areas;
  for (const Sample& sample : samples) {
    const float share = (sample.centre.z - bounds.min.z) / bounds.size().z;
    if (!sample.has_picture || share < 0.3f || share > 0.6f) continue;
    const glm::ivec3 step(16.0f * sample.srgb);
    areas[{step.x, step.y, step.z}] += sample.area_m2;
  }
  const auto maximum = std::ranges::max_element(areas, {}, [](const auto& each) { return each.second; });
  if (maximum == areas.end()) return glm::vec3(1.0f, 0.0f, 0.0f);
  return (glm::vec3(maximum->first[0], maximum->first[1], maximum->first[2]) + 0.5f) / 16.0f;
}

bool is_pane(const Sample& sample, const Bounds& bounds, glm::vec3 paint) {
  const float share = (sample.centre.z - bounds.min.z) / bounds.size().z;
  const float light = (sample.srgb.x + sample.srgb.y + sample.srgb.z) / 3.0f;
  const glm::vec3 off = glm::abs(sample.srgb - paint);
  return sample.has_picture && share > 0.5f && sample.normal.z < 0.9f && sample.normal.z > -0.3f &&
         spread(sample.srgb) <= grey_tolerance && light < 0.92f &&
         std::max({off.x, off.y, off.z}) > grey_tolerance;
}

/// Regions of the picture that samples cover: cells of a grid that touch one another.
std::vector<std::pair<Bounds, float>> regions_of(const std::vector<Sample>& samples) {
  std::vector<int> region(std::size_t(grid) * grid, -1);
  const auto cell_of = [](glm::vec2 uv) {
    const glm::ivec2 cell = glm::clamp(glm::ivec2(uv * float(grid)), glm::ivec2(0), glm::ivec2(grid - 1));
    return cell;
  };
  const auto at = [&](int x, int y) -> int& { return region[std::size_t(y * grid + x)]; };
  constexpr int covered = -2;
  for (const Sample& sample : samples) {
    const glm::ivec2 low = cell_of(glm::min(sample.uv[0], glm::min(sample.uv[1], sample.uv[2])));
    const glm::ivec2 high = cell_of(glm::max(sample.uv[0], glm::max(sample.uv[1], sample.uv[2])));
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
  std::vector<std::pair<Bounds, float>> regions(std::size_t(count), {Bounds(), 0.0f});
  for (const Sample& sample : samples) {
    const glm::ivec2 cell = cell_of(sample.uv[0]);
    auto& [box, area] = regions[std::size_t(at(cell.x, cell.y))];
    for (const glm::vec2& uv : sample.uv) box.add(glm::vec3(uv, 0.0f));
    area += sample.area_m2;
  }
  return regions;
}

std::vector<std::string> glass_masks(const std::vector<Sample>& samples, const Bounds& bounds) {
  const glm::vec3 paint = paint_of(samples, bounds);
  std::vector<Sample> panes;
  float all_m2 = 0.0f;
  for (const Sample& sample : samples)
    if (is_pane(sample, bounds, paint)) panes.push_back(sample), all_m2 += sample.area_m2;
  std::vector<std::string> masks;
  for (const auto& [box, area_m2] : regions_of(panes)) {
    if (area_m2 < min_pane_share * all_m2) continue;
    const glm::vec2 low = glm::max(glm::vec2(box.min) - margin, 0.0f),
                    high = glm::min(glm::vec2(box.max) + margin, 1.0f);
    masks.push_back(
        fmt::format("box {:.3f} {:.3f} {:.3f} {:.3f} grey {}", low.x, low.y, high.x, high.y, grey_tolerance));
  }
  return masks;
}

/// The mean colour of the samples that `takes`; an empty mask where they are too few.
template <class Takes>
void add_lamp(const std::vector<Sample>& samples, const Takes& takes, std::vector<std::string>& masks) {
  constexpr float min_m2 = 0.005f;
  glm::vec3 sum(0.0f);
  float area_m2 = 0.0f;
  for (const Sample& sample : samples)
    if (sample.has_picture && takes(sample)) sum += sample.area_m2 * sample.srgb, area_m2 += sample.area_m2;
  if (area_m2 < min_m2) return;
  const glm::ivec3 mean = glm::ivec3(255.0f * sum / area_m2 + 0.5f);
  masks.push_back(fmt::format("colour #{:02X}{:02X}{:02X} 0.25", mean.x, mean.y, mean.z));
}

}  // namespace

PictureMasks find_masks(const scene::Model& model, const Bounds& bounds, bool faces_back) {
  const std::vector<Sample> samples = samples_of(model);
  const auto forward = [&](const Sample& sample) {
    const float share = (sample.centre.x - bounds.centre().x) / bounds.size().x;
    return faces_back ? -share : share;
  };
  PictureMasks masks;
  masks.glass = glass_masks(samples, bounds);
  add_lamp(
      samples,
      [&](const Sample& s) {
        return forward(s) < -0.4f && s.srgb.x > 0.5f && s.srgb.y < 0.25f && s.srgb.z < 0.25f;
      },
      masks.lamps);
  add_lamp(
      samples,
      [&](const Sample& s) {
        return forward(s) > 0.35f && s.srgb.x > 0.7f && s.srgb.y > 0.6f && s.srgb.z < 0.5f;
      },
      masks.lamps);
  return masks;
}

}  // namespace parvis::car_bodies
