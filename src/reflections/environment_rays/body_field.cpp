#include "reflections/environment_rays/body_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/colour.h"

namespace parvis::environment_rays {
namespace {

using namespace shading;

std::size_t index_of(glm::ivec3 size, int x, int y, int z) {
  return std::size_t(x) + std::size_t(size.x) * (std::size_t(y) + std::size_t(size.y) * std::size_t(z));
}

constexpr float exact_share = 0.5f;  // of the reach: so far cells are compared with every face

/// Gives the shared functions the distances that a shader has in its sampler, filtered as there.
struct Tracer {
  const BodyField& body;

  float field_distance(vec3 cell, int) {
    const glm::ivec3 size(field_cells), last = size - 1;
    const vec3 between = glm::clamp(cell - 0.5f, vec3(0.0f), vec3(last));
    const glm::ivec3 low(between), high = glm::min(low + 1, last);
    const vec3 share = between - vec3(low);
    const auto known = [&](int x, int y, int z) { return float(body.cells[index_of(size, x, y, z)].w); };
    const auto along_x = [&](int y, int z) { return mix(known(low.x, y, z), known(high.x, y, z), share.x); };
    const auto along_y = [&](int z) { return mix(along_x(low.y, z), along_x(high.y, z), share.y); };
    const float byte = mix(along_y(low.z), along_y(high.z), share.z);
    return (2.0f * byte / 255.0f - 1.0f) * field_reach_m(0.5f * body.box.size());
  }

#include "reflections/environment_rays/body_field.glsl"
};

/// The point of a triangle nearest to `p`, as shares of its corners (Ericson 2005, section 5.1.5).
vec3 nearest_shares(vec3 p, vec3 a, vec3 b, vec3 c) {
  const vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const float d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp),
              d6 = dot(ac, cp);
  if (d1 <= 0.0f && d2 <= 0.0f) return {1, 0, 0};
  if (d3 >= 0.0f && d4 <= d3) return {0, 1, 0};
  if (d6 >= 0.0f && d5 <= d6) return {0, 0, 1};
  const float in_ab = d1 * d4 - d3 * d2, in_ac = d5 * d2 - d1 * d6, in_bc = d3 * d6 - d5 * d4;
  if (in_ab <= 0.0f && d1 >= 0.0f && d3 <= 0.0f) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  if (in_ac <= 0.0f && d2 >= 0.0f && d6 <= 0.0f) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  if (in_bc <= 0.0f && d4 >= d3 && d5 >= d6) {
    const float of_c = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - of_c, of_c};
  }
  return vec3(in_bc, in_ac, in_ab) / (in_ab + in_ac + in_bc);
}

/// A triangle in the model's frame.
struct Face {
  vec3 corners[3], normal;
  glm::vec2 uvs[3];
  vec3 tints[3];  ///< colours of the vertices
  const scene::Material* material;
  vec3 centre;  ///< of a ball about it
  float radius_m;

  vec3 at(vec3 shares) const { return shares.x * corners[0] + shares.y * corners[1] + shares.z * corners[2]; }
};

std::vector<Face> solid_faces(const scene::Model& model, const std::vector<scene::Material>& materials) {
  const std::vector<glm::mat4> model_from_node = scene::rest_pose(model);
  std::vector<Face> faces;
  for (const scene::Part& part : model.parts) {
    const scene::Material& material = materials[std::size_t(part.material)];
    if (material.alpha_mode == scene::Alpha::blend) continue;
    const glm::mat4& to_model = model_from_node[std::size_t(part.node)];
    const std::vector<std::uint32_t>& indices = part.mesh.indices;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
      Face face{};
      face.material = &material;
      for (std::size_t k = 0; k < 3; ++k) {
        face.corners[k] = vec3(to_model * glm::vec4(part.mesh.positions[indices[i + k]], 1.0f));
        face.tints[k] = part.mesh.colours.empty() ? vec3(1.0f) : vec3(part.mesh.colours[indices[i + k]]);
        if (!part.mesh.uvs.empty()) face.uvs[k] = part.mesh.uvs[indices[i + k]];
      }
      const vec3 normal = cross(face.corners[1] - face.corners[0], face.corners[2] - face.corners[0]);
      const float length = glm::length(normal);
      if (!(length > 0.0f)) continue;
      face.normal = normal / length;
      face.centre = (face.corners[0] + face.corners[1] + face.corners[2]) / 3.0f;
      for (const vec3 corner : face.corners)
        face.radius_m = std::max(face.radius_m, glm::distance(corner, face.centre));
      faces.push_back(face);
    }
  }
  return faces;
}

vec3 colour_at(const scene::Model& model, const Face& face, vec3 shares) {
  const scene::Material& material = *face.material;
  const vec3 plain =
      material.base_colour * (shares.x * face.tints[0] + shares.y * face.tints[1] + shares.z * face.tints[2]);
  if (material.base_colour_texture == scene::no_index) return plain;
  const scene::Texture& texture = model.textures[std::size_t(material.base_colour_texture)];
  const Image8& image = texture.image;
  if (image.empty()) return plain;
  const glm::vec2 uv = shares.x * face.uvs[0] + shares.y * face.uvs[1] + shares.z * face.uvs[2];
  const vec3 in_texture = material.texture_from_mesh_uv * vec3(uv, 1.0f);
  const glm::vec2 repeated(scene::wrapped(in_texture.x, texture.wrap_u),
                           scene::wrapped(in_texture.y, texture.wrap_v));
  const std::uint8_t* texel = image.at(std::min(int(repeated.x * float(image.width)), image.width - 1),
                                       std::min(int(repeated.y * float(image.height)), image.height - 1));
  return plain * linear_from_srgb8(texel[0], texel[1], texel[2]);
}

/// The nearest face that a cell has met so far.
struct Nearest {
  float distance_m = std::numeric_limits<float>::max(),
        facing = 0.0f;  ///< facing: cosine; below 0 from behind
  int face = scene::no_index;
  vec3 shares{0.0f};
};

Bounds box_of(const std::vector<Face>& faces) {
  Bounds box;
  for (const Face& face : faces)
    for (const vec3 corner : face.corners) box.add(corner);
  if (box.empty()) return box;
  const vec3 margin = glm::max(1.5f * box.size() / (vec3(BodyField::size()) - 3.0f), vec3(1e-3f));
  return {box.min - margin, box.max + margin};
}

/// The cells of a field's box, in the model's frame.
struct Grid {
  glm::ivec3 size;
  vec3 low, cell_m;

  explicit Grid(const Bounds& box)
      : size(BodyField::size()), low(box.min), cell_m(box.size() / vec3(BodyField::size())) {}
  std::size_t index(glm::ivec3 cell) const { return index_of(size, cell.x, cell.y, cell.z); }
  vec3 middle(glm::ivec3 cell) const { return low + (vec3(cell) + 0.5f) * cell_m; }
};

/// Takes a face over into a cell where it is the nearest so far, and within reach.
void offer(const Face& face, int index, vec3 middle, float reach_m, Nearest& known) {
  constexpr float alike_m = 1e-4f;
  const float farthest_m = std::min(known.distance_m + alike_m, reach_m);
  // Most faces are too far by their ball or by their plane; the margin is for rounding.
  const vec3 from_centre = middle - face.centre;
  const float to_ball_m = farthest_m + face.radius_m + 0.1f * alike_m;
  if (dot(from_centre, from_centre) > to_ball_m * to_ball_m ||
      std::abs(dot(from_centre, face.normal)) > farthest_m + 0.1f * alike_m)
    return;
  const vec3 shares = nearest_shares(middle, face.corners[0], face.corners[1], face.corners[2]);
  const vec3 offset = middle - face.at(shares);
  const float distance_m = glm::length(offset);
  if (distance_m > farthest_m) return;
  const float facing = distance_m > 0.0f ? dot(offset, face.normal) / distance_m : 1.0f;
  // Faces meet at edges: the one that is seen most squarely decides between inside and outside.
  const bool is_nearer = distance_m < known.distance_m - alike_m;
  // Of a skin and a lining that lie in one plane, that which faces the cell.
  constexpr float alike_facing = 1e-3f;
  const float more = std::abs(facing) - std::abs(known.facing);
  const bool is_better = std::abs(more) > alike_facing ? more > 0.0f : facing > known.facing;
  if (is_nearer || is_better) known = {distance_m, facing, index, shares};
}

/// Offers a face to the cells that lie within reach of it.
void enter(const Face& face, int index, const Grid& grid, float reach_m, std::vector<Nearest>& cells) {
  const vec3 minimum = glm::min(face.corners[0], glm::min(face.corners[1], face.corners[2])) - reach_m;
  const vec3 maximum = glm::max(face.corners[0], glm::max(face.corners[1], face.corners[2])) + reach_m;
  const glm::ivec3 from = glm::max(glm::ivec3(glm::floor((minimum - grid.low) / grid.cell_m)), glm::ivec3(0));
  const glm::ivec3 to = glm::min(glm::ivec3(glm::floor((maximum - grid.low) / grid.cell_m)), grid.size - 1);
  for (int z = from.z; z <= to.z; ++z)
    for (int y = from.y; y <= to.y; ++y)
      for (int x = from.x; x <= to.x; ++x)
        offer(face, index, grid.middle({x, y, z}), reach_m, cells[grid.index({x, y, z})]);
}

/// The neighbours of a cell that come before it, row by row.
std::vector<glm::ivec3> steps_back() {
  constexpr std::size_t half_of_the_neighbours = 13;
  std::vector<glm::ivec3> steps;
  steps.reserve(half_of_the_neighbours);
  for (int z = -1; z <= 0; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x)
        if (z < 0 || y < 0 || (y == 0 && x < 0)) steps.emplace_back(x, y, z);
  return steps;
}

/// Offers cells the faces that are nearest to their neighbours, from the first cell to the last and back:
/// what is nearest to a cell is so to a neighbour that lies nearer (Danielsson 1980).
void spread(const std::vector<Face>& faces, const Grid& grid, float reach_m, std::vector<Nearest>& cells) {
  const glm::ivec3 last = grid.size - 1;
  const std::vector<glm::ivec3> steps = steps_back();
  const auto ask_neighbours = [&](glm::ivec3 cell, int side) {
    Nearest& known = cells[grid.index(cell)];
    for (const glm::ivec3 step : steps) {
      const glm::ivec3 beside = cell + side * step;
      if (beside != glm::clamp(beside, glm::ivec3(0), last)) continue;
      const int face = cells[grid.index(beside)].face;
      if (face != scene::no_index && face != known.face)
        offer(faces[std::size_t(face)], face, grid.middle(cell), reach_m, known);
    }
  };
  for (int z = 0; z <= last.z; ++z)
    for (int y = 0; y <= last.y; ++y)
      for (int x = 0; x <= last.x; ++x) ask_neighbours({x, y, z}, 1);
  for (int z = last.z; z >= 0; --z)
    for (int y = last.y; y >= 0; --y)
      for (int x = last.x; x >= 0; --x) ask_neighbours({x, y, z}, -1);
}

vec3 surface_of(const Nearest& nearest, const std::vector<Face>& faces) {
  return faces[std::size_t(nearest.face)].at(nearest.shares);
}

/// Flags of cells that can be reached from the sides and the top of the box, level or downward, without
/// passing a surface or a gap narrower than a cell: the inside of a body that is open below is not, but for
/// what lies behind its wheel arches.
std::vector<std::uint8_t> reached_cells(const Grid& grid, const std::vector<Face>& faces,
                                        const std::vector<Nearest>& cells) {
  const auto is_behind = [&](glm::ivec3 cell, glm::ivec3 other) {  // the surface next to `cell`
    const Nearest& nearest = cells[grid.index(cell)];
    if (nearest.face == scene::no_index) return false;
    const vec3 surface = surface_of(nearest, faces);
    return dot(grid.middle(other) - surface, grid.middle(cell) - surface) <= 0.0f;
  };
  const auto is_facing = [&](glm::ivec3 cell) { return cells[grid.index(cell)].facing > 0.0f; };
  std::vector<std::uint8_t> is_reached(cells.size(), 0);
  std::vector<glm::ivec3> next;
  const auto reach = [&](glm::ivec3 cell) {
    if (std::exchange(is_reached[grid.index(cell)], std::uint8_t(1)) == 0) next.push_back(cell);
  };
  const glm::ivec3 last = grid.size - 1;
  for (int z = 0; z <= last.z; ++z)
    for (int y = 0; y <= last.y; ++y) {
      const bool is_side = y == 0 || y == last.y || z == last.z;
      for (int x = 0; x <= last.x; x += is_side ? 1 : last.x) reach({x, y, z});
    }
  constexpr std::array<glm::ivec3, 5> steps{glm::ivec3(-1, 0, 0), glm::ivec3(1, 0, 0), glm::ivec3(0, -1, 0),
                                            glm::ivec3(0, 1, 0), glm::ivec3(0, 0, -1)};
  while (!next.empty()) {
    const glm::ivec3 cell = next.back();
    next.pop_back();
    for (const glm::ivec3 step : steps) {
      const glm::ivec3 beside = cell + step;
      if (beside != glm::clamp(beside, glm::ivec3(0), last)) continue;
      // Where a surface passes between the two, one is nearer to it than half of the way.
      const float half_way_m = 0.5f * glm::length(vec3(step) * grid.cell_m);
      const bool is_clear =
          std::min(cells[grid.index(cell)].distance_m, cells[grid.index(beside)].distance_m) > half_way_m;
      if (is_clear ||
          (!is_behind(cell, beside) && !is_behind(beside, cell) && is_facing(cell) && is_facing(beside)))
        reach(beside);
    }
  }
  return is_reached;
}

/// Which cells of a field lie outside of its body. What is behind the outer surface belongs to the inside, be
/// it a driver, seats or a lining: between them and a pane nearer than a cell the field would have no inside,
/// and rays would pass the pane. Faces alone do not tell: linings face the other way.
class Outside {
 public:
  Outside(const Grid& grid, const std::vector<Face>& faces, const std::vector<Nearest>& cells)
      : grid_(grid), faces_(faces), cells_(cells), is_reached_(reached_cells(grid, faces, cells)) {}

  bool holds(glm::ivec3 cell) const {
    const Nearest& nearest = cells_[grid_.index(cell)];
    if (!is_reached(cell)) return false;
    return nearest.face == scene::no_index || nearest.facing >= 0.0f || !is_reached_behind(cell);
  }

 private:
  bool is_reached(glm::ivec3 cell) const { return is_reached_[grid_.index(cell)] != 0; }

  /// Whether the other side of the surface next to a cell is reached, too: of an open sheet the faces tell
  /// which side is its outside.
  bool is_reached_behind(glm::ivec3 cell) const {
    const vec3 surface = surface_of(cells_[grid_.index(cell)], faces_);
    const vec3 offset = surface - grid_.middle(cell);
    const float distance_m = glm::length(offset);
    if (!(distance_m > 0.0f)) return true;
    const float beyond_m = 1.5f * std::max(grid_.cell_m.x, std::max(grid_.cell_m.y, grid_.cell_m.z));
    const vec3 behind = surface + beyond_m / distance_m * offset;
    const glm::ivec3 there = glm::ivec3(glm::floor((behind - grid_.low) / grid_.cell_m));
    return there != glm::clamp(there, glm::ivec3(0), grid_.size - 1) || is_reached(there);
  }

  const Grid& grid_;
  const std::vector<Face>& faces_;
  const std::vector<Nearest>& cells_;
  std::vector<std::uint8_t> is_reached_;
};

}  // namespace

glm::ivec3 BodyField::size() {
  const BodyField nothing;
  return glm::ivec3(Tracer{nothing}.field_cells);
}

float BodyField::reach_m() const { return Tracer{*this}.field_reach_m(0.5f * box.size()); }

BodyField body_field(const scene::Model& model, const std::vector<scene::Material>& materials) {
  const std::vector<Face> faces = solid_faces(model, materials);
  BodyField field{box_of(faces), {}};
  if (field.box.empty()) return field;
  const float reach_m = field.reach_m();
  const glm::ivec3 size = BodyField::size();
  std::vector<Nearest> cells(std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z));
  const Grid grid(field.box);
  for (std::size_t i = 0; i < faces.size(); ++i) enter(faces[i], int(i), grid, exact_share * reach_m, cells);
  spread(faces, grid, reach_m, cells);

  const Outside outside(grid, faces, cells);
  field.cells.resize(cells.size());
  bool is_inside = false;  // along a row, reached cells far from the surface lie where the last near one did
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const glm::ivec3 cell(int(i) % size.x, int(i) / size.x % size.y, int(i) / (size.x * size.y));
    if (cell.x == 0) is_inside = false;
    const Nearest& nearest = cells[i];
    float share = 1.0f;
    vec3 colour(0.0f);
    if (nearest.face != scene::no_index) {
      is_inside = !outside.holds(cell);
      share = nearest.distance_m / reach_m;
      colour = colour_at(model, faces[std::size_t(nearest.face)], nearest.shares);
    } else if (!outside.holds(cell)) {
      is_inside = true;
    }
    const float distance = 0.5f + 0.5f * (is_inside ? -share : share);
    field.cells[i] =
        glm::u8vec4(255.0f * glm::clamp(glm::vec4(glm::sqrt(colour), distance), 0.0f, 1.0f) + 0.5f);
  }
  return field;
}

float distance_to_body(const BodyField& field, glm::vec3 origin, glm::vec3 direction, float reach_m,
                       bool is_own) {
  if (field.box.empty()) return reach_m;
  Tracer tracer{field};
  return tracer.distance_to_body(origin - field.box.centre(), direction, 0.5f * field.box.size(), 0, reach_m,
                                 is_own);
}

float own_share(const BodyField& field, float distance_m) {
  return Tracer{field}.own_share(distance_m, 0.5f * field.box.size());
}

}  // namespace parvis::environment_rays
