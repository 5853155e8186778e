#include "life/tram/track.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "life/tram/tram_body.h"

namespace parvis::tram {
namespace {

using glm::vec3;

enum Material : int { paving, rail, groove, kerb, post, pane, wire };

constexpr float paving_m = 0.03f;  // thickness
constexpr float half_paving_m = 1.30f;
constexpr float head_m = 0.056f, groove_m = 0.042f, groove_depth_m = 0.02f;
constexpr float wire_m = 5.5f, between_masts_m = 30.0f, mast_m = 6.4f, mast_beside_m = 2.45f;
constexpr float platform_m = 0.30f, platform_breadth_m = 2.6f, gap_m = 0.05f;
constexpr float ramp_m = 3.6f, back_step_m = 0.4f;  // beyond its ends; along its back

/// Chaikin's corner cutting: each corner becomes two of half its angle.
scene::Path corners_cut(const scene::Path& path) {
  scene::Path cut{path.front()};
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    if (i > 0) cut.push_back(glm::mix(path[i], path[i + 1], 0.25f));
    if (i + 2 < path.size()) cut.push_back(glm::mix(path[i], path[i + 1], 0.75f));
  }
  cut.push_back(path.back());
  return cut;
}

/// Builds meshes of the track's frame: x along, y left, z up.
class TrackBuilder {
 public:
  explicit TrackBuilder(const scene::MeasuredPath& line) : line_(line) {
    const scene::Path& points = line.points();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const vec3 in = points[i] - points[i > 0 ? i - 1 : i],
                 out = points[std::min(i + 1, points.size() - 1)] - points[i];
      const vec3 along = glm::normalize((glm::length(in) > 0.0f ? glm::normalize(in) : vec3(0.0f)) +
                                        (glm::length(out) > 0.0f ? glm::normalize(out) : vec3(0.0f)));
      stations_.push_back({points[i], -scene::right_of(along)});
      distance_.push_back(i == 0 ? 0.0f : distance_.back() + glm::length(in));
    }
    meshes_.resize(7);
  }

  /// A strip along the whole line between two places of its cross-section.
  void strip(Material material, glm::vec2 from, glm::vec2 to) {
    strip_between(material, from, to, 0, stations_.size() - 1);
  }

  /// The same between two arc lengths.
  void strip(Material material, glm::vec2 from, glm::vec2 to, float first_m, float last_m) {
    TrackBuilder part(scene::MeasuredPath(scene::without_repeats(line_.part(first_m, last_m))));
    part.strip(material, from, to);
    append(meshes_[std::size_t(material)], part.meshes_[std::size_t(material)]);
  }

  void quad(Material material, vec3 a, vec3 b, vec3 c, vec3 d, glm::vec2 uv_a, glm::vec2 uv_c) {
    Mesh& mesh = meshes_[std::size_t(material)];
    const auto first = std::uint32_t(mesh.positions.size());
    const vec3 across = glm::cross(c - a, d - b);
    if (glm::length(across) < 1e-9f) return;
    mesh.positions.insert(mesh.positions.end(), {a, b, c, d});
    mesh.normals.insert(mesh.normals.end(), 4, glm::normalize(across));
    mesh.uvs.insert(mesh.uvs.end(), {uv_a, {uv_c.x, uv_a.y}, uv_c, {uv_a.x, uv_c.y}});
    mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
  }

  /// A box in the frame of the track at a place.
  void box(Material material, float along_m, vec3 low, vec3 high) {
    const vec3 origin = line_.at(along_m),
               x = glm::normalize(glm::vec3(glm::vec2(line_.direction_at(along_m)), 0.0f)),
               y = -scene::right_of(x);
    const auto p = [&](int i) {
      return origin + (i & 1 ? high.x : low.x) * x + (i & 2 ? high.y : low.y) * y +
             vec3(0, 0, i & 4 ? high.z : low.z);
    };
    for (const auto& f :
         {std::array{1, 3, 7, 5}, {0, 4, 6, 2}, {2, 6, 7, 3}, {0, 1, 5, 4}, {4, 5, 7, 6}, {0, 2, 3, 1}})
      quad(material, p(f[0]), p(f[1]), p(f[2]), p(f[3]), {0, 0}, {1, 1});
  }

  /// A slope from `high` above the line at one place down to it at another, with its sides.
  void ramp(Material material, float from_m, float to_m, float y0, float y1, float high) {
    const bool is_mirrored = (to_m > from_m) != (y1 > y0);
    const auto at = [&](float along_m, float y, float z) {
      const vec3 left = -scene::right_of(line_.direction_at(std::clamp(along_m, 0.0f, line_.length())));
      const float inside_m = std::clamp(along_m, 0.0f, line_.length());
      const vec3 ahead(glm::vec2(line_.direction_at(inside_m)), 0.0f);
      return line_.at(inside_m) + (along_m - inside_m) * ahead + y * left + vec3(0, 0, z);
    };
    const auto face = [&](vec3 a, vec3 b, vec3 c, vec3 d) {
      if (is_mirrored)
        quad(material, a, d, c, b, {0, 0}, {1, 1});
      else
        quad(material, a, b, c, d, {0, 0}, {1, 1});
    };
    face(at(from_m, y0, high), at(to_m, y0, 0.0f), at(to_m, y1, 0.0f), at(from_m, y1, high));
    face(at(from_m, y0, 0.0f), at(to_m, y0, 0.0f), at(from_m, y0, high), at(from_m, y0, 0.0f));
    face(at(from_m, y1, 0.0f), at(from_m, y1, high), at(to_m, y1, 0.0f), at(from_m, y1, 0.0f));
  }

  std::vector<Mesh> take() { return std::move(meshes_); }

 private:
  struct Station {
    vec3 point, left;
  };

  void strip_between(Material material, glm::vec2 from, glm::vec2 to, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const auto at = [&](std::size_t s, glm::vec2 yz) {
        return stations_[s].point + yz.x * stations_[s].left + vec3(0, 0, yz.y);
      };
      // Texture coordinates in metres.
      quad(material, at(i, from), at(i + 1, from), at(i + 1, to), at(i, to), {distance_[i], from.x},
           {distance_[i + 1], to.x});
    }
  }

  const scene::MeasuredPath line_;
  std::vector<Station> stations_;
  std::vector<float> distance_;
  std::vector<Mesh> meshes_;  ///< by Material
};

/// A square metre of granite setts in rows, the colour about 1.
Image8 setts() {
  constexpr int size = 256, rows = 8, stones = 5;
  Image8 image(size, size, 4);
  Random random(7, 3);
  std::array<std::array<float, stones>, rows> shade{};
  for (auto& row : shade)
    for (float& s : row) s = random.uniform(0.78f, 1.0f);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const int row = y * rows / size;
      const float u = float(x) / float(size) * float(stones) + (row % 2 == 0 ? 0.0f : 0.5f),
                  v = float(y) / float(size) * float(rows);
      const float in_u = u - std::floor(u), in_v = v - std::floor(v);
      const float edge = std::min(std::min(in_u, 1.0f - in_u) * 0.2f,
                                  std::min(in_v, 1.0f - in_v) * 0.125f);  // metres from the joint
      const float joint = std::clamp(edge / 0.008f, 0.0f, 1.0f);
      const float grain = random.uniform(0.93f, 1.0f);
      const float value =
          std::lerp(0.48f, shade[std::size_t(row)][std::size_t(int(u) % stones)] * grain, joint);
      for (int c = 0; c < 3; ++c) image.at(x, y)[c] = std::uint8_t(std::lround(255.0f * value));
      image.at(x, y)[3] = 255;
    }
  return image;
}

void lay_track(TrackBuilder& track) {
  const float z = paving_m, low = paving_m - groove_depth_m;
  // From right to left: the groove lies inside of the head.
  float y = -half_paving_m;
  const auto next = [&](Material material, float to, float height) {
    track.strip(material, {y, height}, {to, height}), y = to;
  };
  const auto wall = [&](float from, float to) { track.strip(groove, {y, from}, {y, to}); };
  track.strip(paving, {y, 0.0f}, {y, z});
  const float inner = 0.5f * gauge_m;
  next(paving, -inner - head_m, z), next(rail, -inner, z), wall(z, low), next(groove, -inner + groove_m, low),
      wall(low, z);
  next(paving, inner - groove_m, z), wall(z, low), next(groove, inner, low), wall(low, z),
      next(rail, inner + head_m, z), next(paving, half_paving_m, z);
  track.strip(paving, {y, z}, {y, 0.0f});
}

void hang_wire(TrackBuilder& track, float length) {
  constexpr float r = 0.012f;
  const float z = wire_m + paving_m;
  track.strip(wire, {-r, z}, {0, z - r}), track.strip(wire, {0, z - r}, {r, z}),
      track.strip(wire, {r, z}, {0, z + r}), track.strip(wire, {0, z + r}, {-r, z});
  const int masts = std::max(1, int(std::round(length / between_masts_m)));
  for (int i = 0; i < masts; ++i) {
    const float at = length * (float(i) + 0.5f) / float(masts), y = -mast_beside_m;
    track.box(post, at, {-0.08f, y - 0.08f, 0.0f}, {0.08f, y + 0.08f, mast_m});
    track.box(post, at, {-0.03f, y, wire_m + 0.55f}, {0.03f, 0.25f, wire_m + 0.61f});
    track.box(post, at, {-0.012f, -0.012f, wire_m + 0.02f}, {0.012f, 0.012f, wire_m + 0.57f});
  }
}

void build_platform(TrackBuilder& track, const Platform& platform) {
  const float sign = platform.is_on_left ? 1.0f : -1.0f;
  const float near = sign * (0.5f * width_m + gap_m), edge = near + sign * 0.35f,
              far = near + sign * platform_breadth_m;
  const float top = platform_m + paving_m;
  const auto lay = [&](Material material, glm::vec2 a, glm::vec2 b) {
    if (sign > 0.0f)
      track.strip(material, a, b, platform.from_m, platform.to_m);
    else
      track.strip(material, b, a, platform.from_m, platform.to_m);
  };
  lay(kerb, {near, 0.0f}, {near, top}), lay(kerb, {near, top}, {edge, top}),
      lay(paving, {edge, top}, {far, top}), lay(kerb, {far, top}, {far, 0.5f * top});
  const float back = far + sign * back_step_m;
  lay(kerb, {far, 0.5f * top}, {back, 0.5f * top}), lay(kerb, {back, 0.5f * top}, {back, 0.0f});
  for (const float step_end : {platform.from_m, platform.to_m})
    track.box(kerb, step_end, {-0.04f, std::min(far, back), 0.0f},
              {0.04f, std::max(far, back), 0.5f * top - 0.002f});
  track.ramp(kerb, platform.from_m, platform.from_m - ramp_m, near, far, top);
  track.ramp(kerb, platform.to_m, platform.to_m + ramp_m, near, far, top);
  // A shelter, open to the track, and the stop's sign.
  const float middle = 0.5f * (platform.from_m + platform.to_m), rear = near + sign * 2.35f,
              front = near + sign * 0.95f;
  const auto at = [&](Material material, float x0, float x1, float y0, float y1, float z0, float z1) {
    track.box(material, middle, {x0, std::min(y0, y1), z0}, {x1, std::max(y0, y1), z1});
  };
  for (const float x : {-2.4f, 0.0f, 2.4f})
    at(post, x - 0.04f, x + 0.04f, rear - 0.04f, rear + 0.04f, top, top + 2.45f);
  at(post, -2.6f, 2.6f, front, rear + 0.1f * sign, top + 2.45f, top + 2.53f);
  at(pane, -2.35f, 2.35f, rear - 0.008f, rear + 0.008f, top + 0.25f, top + 2.25f);
  at(post, -1.6f, 1.6f, rear - 0.50f * sign, rear - 0.12f * sign, top + 0.43f, top + 0.47f);
  for (const float x : {-1.4f, 1.4f})
    at(post, x - 0.03f, x + 0.03f, rear - 0.42f * sign, rear - 0.2f * sign, top, top + 0.43f);
  at(post, 4.0f, 4.08f, front, front + 0.08f * sign, top, top + 2.9f);
  at(kerb, 3.78f, 4.30f, front + 0.01f * sign, front + 0.06f * sign, top + 2.35f, top + 2.87f);
}

}  // namespace

PlatformEdge platform_edge(const scene::MeasuredPath& line, const Platform& platform) {
  const float sign = platform.is_on_left ? 1.0f : -1.0f;
  const auto at = [&](float along_m) {
    const vec3 left = -scene::right_of(line.direction_at(along_m));
    return line.at(along_m) + sign * (0.5f * width_m + gap_m) * left + vec3(0, 0, platform_m + paving_m);
  };
  const vec3 left = -scene::right_of(line.direction_at(0.5f * (platform.from_m + platform.to_m)));
  return {at(platform.from_m), at(platform.to_m), sign * glm::vec2(left), platform_breadth_m};
}

scene::Path smooth_line(const scene::Path& corners, float radius_m) {
  scene::Path line = scene::without_repeats(corners);
  if (line.size() < 3) return line;
  line = scene::rounded(line, radius_m);
  return corners_cut(corners_cut(line));
}

Result<scene::MeasuredPath> driveable(scene::Path line) {
  constexpr float max_m = 20'000.0f, min_length_m = length_m + 20.0f;
  scene::MeasuredPath path(std::move(line));
  if (path.points().size() < 2 || path.length() < min_length_m)
    return error("the track is {:.1f} m long; a tram of {:.0f} m needs {:.0f} m or more", path.length(),
                 length_m, min_length_m);
  if (path.length() > max_m)
    return error(
        "the track is {:.1f} km long, at most {:.0f} km are run: shorten it to the part that is seen",
        path.length() / 1000.0f, max_m / 1000.0f);
  constexpr float reach_m = 3.0f, step_m = 1.0f;
  for (float at = reach_m; at < path.length() - reach_m; at += step_m) {
    const vec3 a = path.direction_at(at - reach_m), b = path.direction_at(at + reach_m), here = path.at(at);
    const float turn = std::abs(std::atan2(scene::cross_in_plan(a, b), a.x * b.x + a.y * b.y));
    constexpr float tolerance = 0.93f;  // chords of a curve are a little tighter than the curve
    if (2.0f * reach_m < tolerance * min_radius_m * turn)
      return error(
          "the curve at {:.1f} {:.1f} has a radius of {:.1f} m; the tram needs {:.0f} m: move the points of "
          "path apart, or give a larger radius",
          here.x, here.y, 2.0f * reach_m / turn, min_radius_m);
    const vec3 rise = path.at(at + reach_m) - path.at(at - reach_m);
    const float gradient = std::abs(rise.z) / std::max(glm::length(glm::vec2(rise)), 1e-3f);
    if (gradient > max_gradient)
      return error("the track climbs {:.0f} % at {:.1f} {:.1f}; the tram climbs {:.0f} %: lengthen the slope",
                   100.0f * gradient, here.x, here.y, 100.0f * max_gradient);
  }
  return path;
}

std::shared_ptr<const scene::Model> track_model(const scene::MeasuredPath& line, bool has_wire,
                                                std::span<const Platform> platforms) {
  TrackBuilder track(line);
  lay_track(track);
  if (has_wire) hang_wire(track, line.length());
  for (const Platform& platform : platforms) build_platform(track, platform);
  auto model = std::make_shared<scene::Model>();
  model->name = "tram track";
  model->textures.push_back({.name = "setts", .image = setts()});
  const auto material = [](const char* name, vec3 colour, float roughness, float metallic = 0.0f) {
    scene::Material m;
    m.name = name, m.base_colour = colour, m.roughness = roughness, m.metallic = metallic;
    return m;
  };
  model->materials = {material("paving", vec3(0.36f, 0.34f, 0.32f), 0.85f),
                      material("rail", vec3(0.55f, 0.54f, 0.52f), 0.28f, 1.0f),
                      material("groove", vec3(0.03f), 0.9f),
                      material("kerb", vec3(0.52f, 0.51f, 0.49f), 0.8f),
                      material("post", vec3(0.11f, 0.12f, 0.13f), 0.5f),
                      material("pane", vec3(0.05f, 0.06f, 0.06f), 0.05f),
                      material("wire", vec3(0.05f, 0.035f, 0.03f), 0.5f)};
  model->materials[paving].base_colour_texture = 0;
  std::vector<Mesh> meshes = track.take();
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    if (meshes[m].indices.empty()) continue;
    scene::Part part;
    part.object = model->materials[m].name, part.mesh = std::move(meshes[m]), part.material = int(m);
    model->parts.push_back(std::move(part));
  }
  return model;
}

}  // namespace parvis::tram
