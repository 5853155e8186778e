#include "land/roads/paving.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "land/heights/ground_heights.h"
#include "land/roads/asphalt_cover.h"
#include "land/roads/opposite_lanes.h"
#include "land/roads/tiling_noise.h"
#include "scene/data/path.h"

namespace parvis::scene {

namespace {

constexpr float beside_reach_m = 6.0f;  // beside a lane's middle, in which its ground is looked for
constexpr float paving_step_m = 1.0f;   // along lanes and across them
constexpr float tile_m = 6.0f;          // of the pictures
constexpr float margin_m = 0.25f;       // of asphalt beside a lane, so that neighbours leave no gap
constexpr float kerb_m = 0.15f;         // beside the asphalt
constexpr float pavement_m = 2.6f;      // beside the asphalt
static_assert(margin_m + pavement_m <= paved_beside_m + 1e-6f);
// Over the ground, whose mesh is coarse. What lies higher covers what is below: so all lanes together give
// one carriageway with one kerb, however they cross.
constexpr float pavement_lift_m = 0.03f, kerb_lift_m = 0.045f, asphalt_lift_m = 0.06f, paint_lift_m = 0.07f;
constexpr float dash_m = 3.0f, dash_gap_m = 3.0f;
constexpr float dash_half_width_m = 0.06f, line_half_width_m = 0.2f;
constexpr int picture_side = 512;
constexpr float lies_m = 0.03f;  // off the ground, within which a lane lies on it
// Of error in plan and in height, for which points of a ribbon are left out. Where a lane's pavement runs
// below the asphalt of another one, across a crossing, both follow the same ground with errors of their own:
// their sum stays below the 1.5 cm between two layers, or slivers of one show through the other.
constexpr float chord_m = 0.012f, chord_rise_m = 0.004f;
constexpr std::size_t max_straight_rows = 1000;
constexpr float aisle_m_s = 25.0f / 3.6f, fast_m_s = 80.0f / 3.6f;

/// Parts, and materials, of the model.
enum Layer : int { pavement, kerb, asphalt, paint };

template <class LightAt>
Texture grey_picture(const char* name, glm::vec3 tint, LightAt&& light_at) {
  Texture texture{name, Image8(picture_side, picture_side, 4, 255)};
  for (int y = 0; y < picture_side; ++y)
    for (int x = 0; x < picture_side; ++x)
      for (int channel = 0; channel < 3; ++channel)
        texture.image.at(x, y)[channel] =
            std::uint8_t(std::clamp(light_at(x, y) * tint[channel], 0.0f, 255.0f));
  return texture;
}

/// Asphalt: patches, stains and grains; it tiles.
Texture asphalt_picture() {
  Random random(3);
  const TilingNoise patches(3, random), stains(17, random), clouds(96, random), grains(picture_side, random);
  return grey_picture("asphalt", glm::vec3(1.0f, 1.01f, 1.03f), [&](int x, int y) {
    const glm::vec2 p = glm::vec2(x, y) / float(picture_side);
    return 66.0f + 10.0f * patches.at(p) + 7.0f * stains.at(p) + 8.0f * clouds.at(p) + 18.0f * grains.at(p);
  });
}

/// Slabs of 30 cm, each with its own tone, in broken bond.
Texture pavement_picture() {
  constexpr int slabs = 20;
  constexpr float slab_pixels = float(picture_side) / slabs;
  Random random(4);
  const TilingNoise stains(9, random), grains(picture_side, random);
  std::vector<float> tones(slabs * slabs);
  for (float& tone : tones) tone = random.uniform(-9.0f, 9.0f);
  return grey_picture("pavement", glm::vec3(1.0f, 0.985f, 0.95f), [&](int x, int y) {
    const float row = float(y) / slab_pixels, column = float(x) / slab_pixels + (int(row) % 2 ? 0.5f : 0.0f);
    const glm::vec2 p = glm::vec2(x, y) / float(picture_side);
    const float soil = 22.0f * stains.at(p) + 14.0f * grains.at(p);
    const bool is_joint = (row - std::floor(row)) < 0.06f || (column - std::floor(column)) < 0.06f;
    return is_joint
               ? 92.0f + soil
               : 138.0f + soil +
                     tones[std::size_t(int(row)) * std::size_t(slabs) + std::size_t(int(column) % slabs)];
  });
}

Model empty_paving() {
  Model model;
  model.name = "paving";
  model.textures = {pavement_picture(), asphalt_picture()};
  const auto add = [&](const char* name, glm::vec3 colour, int texture, float roughness) {
    Material material;
    material.name = name;
    material.base_colour = colour;
    material.base_colour_texture = texture;
    material.roughness = roughness;
    Part part;
    part.object = name;
    part.material = int(model.materials.size());
    part.casts_shadow = false;
    model.materials.push_back(material);
    model.parts.push_back(part);
  };
  add("pavement", glm::vec3(1.0f), 0, 0.9f);
  add("kerb", glm::vec3(0.33f, 0.32f, 0.30f), no_index, 0.8f);
  add("carriageway", glm::vec3(1.0f), 1, 0.9f);
  add("markings", glm::vec3(0.55f), no_index, 0.6f);
  return model;
}

/// Points of a ribbon across its line, from left to right.
using Row = std::vector<glm::vec3>;

/// Whether the row between two others lies on the straight lines between their points.
bool lies_between(const Row& row, const Row& before, const Row& after) {
  for (std::size_t k = 0; k < row.size(); ++k) {
    const glm::vec3 chord = after[k] - before[k];
    const float fraction =
        glm::clamp(glm::dot(row[k] - before[k], chord) / glm::dot(chord, chord), 0.0f, 1.0f);
    const glm::vec3 off = row[k] - (before[k] + fraction * chord);
    if (!(glm::length(glm::vec2(off)) < chord_m && std::abs(off.z) < chord_rise_m)) return false;
  }
  return true;
}

/// Leaves out rows that lie on straight lines between others. The end of each line is sought by doubling its
/// length, then by halving the last step: time grows with the rows, and with the logarithm of their number on
/// a line, which `max_straight_rows` bounds.
std::vector<Row> without_needless_rows(const std::vector<Row>& rows) {
  const auto is_straight = [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from + 1; i < to; ++i)
      if (!lies_between(rows[i], rows[from], rows[to])) return false;
    return true;
  };
  std::vector<Row> kept{rows.front()};
  for (std::size_t last = 0; last + 1 < rows.size();) {
    const std::size_t max_length = std::min(max_straight_rows, rows.size() - 1 - last);
    std::size_t length = 1, step = 1;
    for (; length + step <= max_length && is_straight(last, last + length + step); step *= 2) length += step;
    for (; step > 0; step /= 2)
      if (length + step <= max_length && is_straight(last, last + length + step)) length += step;
    last += length;
    kept.push_back(rows[last]);
  }
  return kept;
}

/// Leaves out the points across that lie on straight lines between others in all rows.
void leave_out_needless_points(std::vector<Row>& rows) {
  std::vector<Row> columns(rows.front().size());
  for (const Row& row : rows)
    for (std::size_t k = 0; k < row.size(); ++k) columns[k].push_back(row[k]);
  columns = without_needless_rows(columns);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].clear();
    for (const Row& column : columns) rows[i].push_back(column[i]);
  }
}

/// Adds the triangles between rows, as few as the rows allow.
void add_rows(Mesh& mesh, std::vector<Row> rows) {
  leave_out_needless_points(rows);
  rows = without_needless_rows(rows);
  const std::uint32_t first = std::uint32_t(mesh.positions.size()),
                      width = std::uint32_t(rows.front().size());
  for (const Row& row : rows)
    for (const glm::vec3& p : row) mesh.positions.push_back(p), mesh.uvs.push_back(glm::vec2(p) / tile_m);
  for (std::uint32_t i = 0; i + 1 < rows.size(); ++i)
    for (std::uint32_t k = 0; k + 1 < width; ++k) {
      const std::uint32_t near_left = first + i * width + k, far_left = near_left + width;
      mesh.indices.insert(mesh.indices.end(),
                          {near_left, near_left + 1, far_left, near_left + 1, far_left + 1, far_left});
    }
}

/// The directions in which a line begins and ends.
using Ends = std::array<glm::vec3, 2>;
Ends ends_of(const Path& line) { return {line[1] - line[0], line.back() - line[line.size() - 2]}; }

/// Rows of a ribbon along `line` from `left_m` to `right_m` beside it (to the right positive), lying `lift`
/// over the ground; the first and the last one square to `ends`.
std::vector<Row> ribbon(const Path& line, const Ends& ends, float left_m, float right_m,
                        const GroundHeights& ground, float lift) {
  const std::uint32_t strips = std::uint32_t(std::max(1.0f, std::ceil((right_m - left_m) / paving_step_m)));
  std::vector<Row> rows;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const glm::vec3 right = right_of(i == 0                 ? ends[0]
                                     : i + 1 == line.size() ? ends[1]
                                                            : line[i + 1] - line[i - 1]);
    Row& row = rows.emplace_back();
    for (std::uint32_t k = 0; k <= strips; ++k) {
      glm::vec3 p = line[i] + right * glm::mix(left_m, right_m, float(k) / float(strips));
      p.z = ground.beside_lane(glm::vec2(p), line[i].z) + lift;
      row.push_back(p);
    }
  }
  return rows;
}

/// Adds what is to be seen of a ribbon: not the pieces that asphalt of other strips than `own` hides.
void add_seen(Mesh& mesh, const std::vector<Row>& rows, const AsphaltCover& asphalt, std::uint32_t own) {
  std::vector<Row> seen;
  for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
    const Row &near = rows[i], &far = rows[i + 1];
    if (!asphalt.hides(own, near.front(), near.back(), far.front(), far.back())) {
      if (seen.empty()) seen.push_back(near);
      seen.push_back(far);
    } else if (!seen.empty()) {
      add_rows(mesh, std::exchange(seen, {}));
    }
  }
  if (!seen.empty()) add_rows(mesh, std::move(seen));
}

/// The lane's points at every metre or nearer, on the ground.
Path laid(const Path& points, const GroundHeights& ground) {
  const MeasuredPath path(points);
  const int count = std::max(1, int(std::ceil(path.length() / paving_step_m)));
  Path result;
  for (int i = 0; i <= count; ++i) {
    glm::vec3 p = path.at(path.length() * float(i) / float(count));
    p.z = ground.beside_lane(glm::vec2(p), p.z);
    result.push_back(p);
  }
  return result;
}

/// Dashes on the left edge of innermost lanes; of two opposite lanes the one that heads east draws them.
void add_markings(Mesh& mesh, const Lane& lane, const Path& line, bool is_innermost,
                  const GroundHeights& ground) {
  const MeasuredPath path(line);
  const float left_m = -0.5f * lane.width_m;
  const float lift = paint_lift_m;
  for (float from = 0.5f * dash_gap_m; is_innermost && from + dash_m < path.length();
       from += dash_m + dash_gap_m) {
    const glm::vec3 direction = path.direction_at(from);
    const Path dash = path.part(from, from + dash_m);
    if (direction.x > 0.0f || (direction.x == 0.0f && direction.y > 0.0f))
      add_rows(mesh, ribbon(dash, ends_of(dash), left_m - dash_half_width_m, left_m + dash_half_width_m,
                            ground, lift));
  }
  const bool waits_at_end = lane.next.size() > 1 && path.length() > 6.0f;
  const float stop_m = path.length() - 2.0f * line_half_width_m;
  if (!waits_at_end) return;
  const Path stop = path.part(stop_m, path.length());
  add_rows(mesh, ribbon(stop, ends_of(stop), left_m + 0.15f, 0.5f * lane.width_m, ground, lift));
}

/// The directions in which each lane begins and ends; of one through a crossing those of the lanes that it
/// joins, so that no wedge of the ground stays open between their ribbons where it begins in a bend.
std::vector<Ends> joined_ends(const RoadGraph& roads, const std::vector<AsphaltStrip>& strips) {
  std::vector<Ends> own;
  for (const AsphaltStrip& strip : strips) own.push_back(ends_of(strip.middle));
  std::vector<Ends> joined = own;
  for (std::size_t i = 0; i < roads.lanes.size(); ++i)
    for (const int next : roads.lanes[i].next) {
      if (roads.lanes[std::size_t(next)].crossing >= 0) joined[std::size_t(next)][0] = own[i][1];
      if (roads.lanes[i].crossing >= 0) joined[i][1] = own[std::size_t(next)][0];
    }
  return joined;
}

/// Lanes that lie on the ground as they are stay as they are: their length is what traffic counts by.
void lay(RoadGraph& roads, const GroundHeights& ground) {
  for (Lane& lane : roads.lanes) {
    Path on_ground = laid(lane.points, ground);
    const MeasuredPath own(lane.points);
    bool lies = true;
    for (std::size_t i = 0; lies && i < on_ground.size(); ++i) {
      const float at_m = own.length() * float(i) / float(on_ground.size() - 1);
      lies = std::abs(own.at(at_m).z - on_ground[i].z) < lies_m;
    }
    if (!lies) lane.points = std::move(on_ground);
  }
}

/// Moves lanes up or down to ground that has changed below them.
void follow(RoadGraph& roads, const GroundHeights& ground) {
  for (Lane& lane : roads.lanes) {
    Path on_ground = lane.points;
    for (glm::vec3& p : on_ground) p.z = ground.beside_lane(glm::vec2(p), p.z);
    const bool lies = std::ranges::equal(lane.points, on_ground, [](const glm::vec3& a, const glm::vec3& b) {
      return std::abs(a.z - b.z) < lies_m;
    });
    if (!lies) lane.points = std::move(on_ground);
  }
}

}  // namespace

void lay_lanes(Scene& scene) {
  if (scene.roads.empty()) return;
  lay(scene.roads, GroundHeights(scene, beside_reach_m));
}

std::uint64_t paving_bytes(const RoadGraph& roads) {
  // Rows at every metre of three ribbons, of points at every metre across, as on ground that is nowhere even.
  constexpr std::uint64_t bytes_per_point =
      2 * sizeof(glm::vec3) + sizeof(glm::vec2) + 6 * sizeof(std::uint32_t);
  double points = 0.0;
  for (const Lane& lane : roads.lanes)
    points += 3.0 * double(MeasuredPath(lane.points).length() / paving_step_m + 2.0f) *
              double((lane.width_m + pavement_m) / paving_step_m + 2.0f);
  return std::uint64_t(points) * bytes_per_point;
}

void pave(Scene& scene) {
  lay_lanes(scene);
  pave_laid_lanes(scene);
}

void pave_laid_lanes(Scene& scene) {
  if (scene.roads.empty()) return;
  const GroundHeights ground(scene, beside_reach_m);
  follow(scene.roads, ground);
  const OppositeLanes opposite(scene.roads);
  auto model = std::make_shared<Model>(empty_paving());
  std::vector<AsphaltStrip> strips;
  strips.reserve(scene.roads.lanes.size());
  for (const Lane& lane : scene.roads.lanes)
    strips.push_back({laid(lane.points, ground), 0.5f * lane.width_m + margin_m});
  const AsphaltCover cover(strips);
  const std::vector<Ends> ends = joined_ends(scene.roads, strips);
  for (std::uint32_t i = 0; i < strips.size(); ++i) {
    const Lane& lane = scene.roads.lanes[i];
    const auto rows = [&](float beside_m, float lift_m) {
      const float half_m = strips[i].half_m + beside_m;
      return ribbon(strips[i].middle, ends[i], -half_m, half_m, ground, lift_m);
    };
    const bool is_street = lane.speed_limit >= aisle_m_s;
    if (is_street && lane.speed_limit <= fast_m_s) {
      add_seen(model->parts[pavement].mesh, rows(pavement_m, pavement_lift_m), cover, i);
      add_seen(model->parts[kerb].mesh, rows(kerb_m, kerb_lift_m), cover, i);
    }
    add_rows(model->parts[asphalt].mesh, rows(0.0f, asphalt_lift_m));
    if (is_street && lane.crossing < 0)
      add_markings(model->parts[paint].mesh, lane, strips[i].middle, opposite.has(lane), ground);
  }
  for (Lane& lane : scene.roads.lanes)
    for (glm::vec3& p : lane.points) p.z += asphalt_lift_m;
  std::erase_if(model->parts, [](const Part& part) { return part.mesh.indices.empty(); });
  for (Part& part : model->parts) fill_normals(part.mesh);

  Object object;
  object.name = "paving";
  object.model = std::move(model);
  scene.objects.push_back(std::move(object));
}

}  // namespace parvis::scene
