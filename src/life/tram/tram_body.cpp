#include "life/tram/tram_body.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

namespace parvis::tram {
namespace {

using glm::vec2, glm::vec3;

enum Surface : int { lacquer, glass, trim, metal, lamp_white, lamp_red };

constexpr float floor_z = 0.35f, skirt_z = 0.18f, sill_z = 0.98f, lintel_z = 2.42f, eaves_z = 2.95f;
constexpr float half = 0.5f * width_m;
constexpr float nose_m = 2.3f;        // over which a cab narrows
constexpr float joint_gap_m = 0.22f;  // of a section's shell before its joint; bellows fill it
constexpr float door_m = 1.30f, door_from_end_m = 1.0f;  // double doors: two leaves
constexpr float wheel_radius_m = 0.29f;

/// Half breadth of the side wall at a height: it leans in above the sill.
float side_y(float z) {
  const float above = std::max(0.0f, z - sill_z) / (eaves_z - sill_z), below = std::max(0.0f, 0.45f - z);
  return half - 0.055f * above * above - 0.10f * below;
}

/// A cab's cross-section at a distance from its end: breadth, and how far the roof comes down.
struct Narrowing {
  float breadth = 1.0f, roof_drop = 0.0f;
};
Narrowing narrowed(float from_end_m, bool is_cab) {
  if (!is_cab || from_end_m >= nose_m) return {};
  const float t = 1.0f - from_end_m / nose_m;
  return {1.0f - 0.30f * std::pow(t, 2.4f), 0.55f * std::pow(t, 2.2f)};
}

class SectionBuilder {
 public:
  SectionBuilder(SectionKind kind, vec3 colour) : kind_(kind) {
    length_ = section_length_m[kind == SectionKind::front    ? 0
                               : kind == SectionKind::hung   ? 1
                               : kind == SectionKind::middle ? 2
                                                             : 4];
    model_->name = "tram section";
    add_materials(colour);
  }

  std::shared_ptr<const scene::Model> build() {
    add_shell();
    add_ends();
    if (kind_ == SectionKind::hung) add_doors();
    if (kind_ != SectionKind::hung) add_bogie();
    if (kind_ == SectionKind::middle) add_pantograph();
    if (is_cab()) add_lamps();
    for (std::size_t m = 0; m < meshes_.size(); ++m) add_part(std::move(meshes_[m]), int(m), 0);
    return std::move(model_);
  }

 private:
  bool is_cab() const { return kind_ == SectionKind::front || kind_ == SectionKind::rear; }

  void add_materials(vec3 colour) {
    const auto material = [](const char* name, vec3 base, float roughness) {
      scene::Material m;
      m.name = name, m.base_colour = base, m.roughness = roughness;
      return m;
    };
    scene::Material paint = material("lacquer", colour, 0.35f);
    paint.clear_coat = 1.0f, paint.is_mirror_like = true;
    scene::Material pane = material("glass", vec3(0.015f, 0.018f, 0.020f), 0.04f);
    pane.is_mirror_like = true;
    scene::Material white = material("headlamps", vec3(0.9f), 0.2f),
                    red = material("tail lamps", vec3(0.5f, 0.02f, 0.02f), 0.2f);
    white.emission = vec3(6.0f), red.emission = vec3(1.2f, 0.04f, 0.03f);
    model_->materials = {
        paint, pane, material("trim", vec3(0.035f), 0.6f), material("metal", vec3(0.28f), 0.45f), white, red};
    meshes_.resize(model_->materials.size());
  }

  /// Distance of a place from the section's free end.
  float from_end(float x) const { return kind_ == SectionKind::front ? -x : length_ + x; }

  vec3 on_side(float x, float z, float side) const {
    const Narrowing n = narrowed(from_end(x), is_cab());
    const float drop = n.roof_drop * std::max(0.0f, (z - sill_z) / (height_m - sill_z));
    return {x, side * side_y(z) * n.breadth, z - drop};
  }

  void quad(Surface surface, vec3 a, vec3 b, vec3 c, vec3 d) {
    quad(meshes_[std::size_t(surface)], a, b, c, d);
  }
  static void quad(Mesh& mesh, vec3 a, vec3 b, vec3 c, vec3 d) {
    const vec3 across = glm::cross(c - a, d - b);
    if (glm::length(across) < 1e-7f) return;
    const vec3 n = glm::normalize(across);
    const auto first = std::uint32_t(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {a, b, c, d});
    mesh.normals.insert(mesh.normals.end(), 4, n);
    mesh.uvs.resize(mesh.positions.size());
    mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
  }
  static void box(Mesh& mesh, vec3 low, vec3 high) {
    const auto p = [&](int i) {
      return vec3(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
    };
    for (const auto& f :
         {std::array{1, 3, 7, 5}, {0, 4, 6, 2}, {2, 6, 7, 3}, {0, 1, 5, 4}, {4, 5, 7, 6}, {0, 2, 3, 1}})
      quad(mesh, p(f[0]), p(f[1]), p(f[2]), p(f[3]));
  }

  bool is_door(float x) const {
    if (kind_ != SectionKind::hung) return false;
    const float at = -x;
    return (at > door_from_end_m && at < door_from_end_m + door_m) ||
           (at > length_ - door_from_end_m - door_m && at < length_ - door_from_end_m);
  }

  /// Side walls and roof, in stations along x.
  void add_shell() {
    std::vector<float> xs;
    const float first = -(kind_ == SectionKind::front ? 0.0f : joint_gap_m),
                last = -(length_ - (kind_ == SectionKind::rear ? 0.0f : joint_gap_m));
    for (float x = first; x > last + 1e-3f; x -= is_cab() && from_end(x) < nose_m + 0.2f ? 0.15f : 0.25f)
      xs.push_back(x);
    xs.push_back(last);
    if (kind_ == SectionKind::hung) {
      for (const float at : {door_from_end_m, door_from_end_m + door_m, length_ - door_from_end_m - door_m,
                             length_ - door_from_end_m})
        xs.push_back(-at);
      std::ranges::sort(xs, std::greater<>());
    }
    const std::array<float, 6> heights{skirt_z, 0.45f, sill_z, 1.7f, lintel_z, eaves_z};
    for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
      const float a = xs[i], b = xs[i + 1], middle = 0.5f * (a + b);
      if (a - b < 1e-4f) continue;
      for (const float side : {1.0f, -1.0f}) {
        for (std::size_t h = 0; h + 1 < heights.size(); ++h) {
          const float low = heights[h], high = heights[h + 1];
          if (is_door(middle) && low >= floor_z - 0.2f && high <= lintel_z + 1e-3f && low > 0.3f) continue;
          const bool is_window = low >= sill_z - 1e-3f && high <= lintel_z + 1e-3f;
          const vec3 p = on_side(a, low, side), q = on_side(b, low, side), r = on_side(b, high, side),
                     s = on_side(a, high, side);
          if (side > 0.0f)
            quad(is_window ? glass : lacquer, p, q, r, s);
          else
            quad(is_window ? glass : lacquer, p, s, r, q);
        }
      }
      add_roof(a, b);
    }
  }

  void add_roof(float a, float b) {
    constexpr int steps = 8;
    const auto rim = [&](float x, int i) {
      const float t = float(i) / float(steps), angle = std::numbers::pi_v<float> * t;
      const Narrowing n = narrowed(from_end(x), is_cab());
      const float y = std::cos(angle), up = std::pow(std::max(0.0f, std::sin(angle)), 0.55f);
      const float z = eaves_z + (height_m - 0.12f - eaves_z) * up;
      return vec3(x, y * side_y(eaves_z) * n.breadth, z - n.roof_drop * (z - sill_z) / (height_m - sill_z));
    };
    for (int i = 0; i < steps; ++i)
      quad(i == 0 || i == steps - 1 ? lacquer : metal, rim(b, i), rim(b, i + 1), rim(a, i + 1), rim(a, i));
  }

  /// A cab's face; bellows and a dark wall at joints.
  void add_ends() {
    const auto face = [&](float x, float towards) {
      const std::array<float, 6> heights{skirt_z, 0.45f, sill_z, 1.7f, lintel_z, eaves_z};
      for (std::size_t h = 0; h + 1 < heights.size(); ++h) {
        const bool is_window = heights[h] >= sill_z - 1e-3f;
        constexpr int pieces = 6;
        const auto point = [&](float z, int i) {
          const float t = 2.0f * float(i) / float(pieces) - 1.0f;
          vec3 p = on_side(x, z, 1.0f);
          p.y *= t;
          p.x += towards * (0.30f * (1.0f - t * t) -
                            0.24f * std::max(0.0f, (z - sill_z) / (eaves_z - sill_z)) * (1.0f - t * t));
          return p;
        };
        for (int i = 0; i < pieces; ++i) {
          const vec3 p = point(heights[h], i), q = point(heights[h], i + 1), r = point(heights[h + 1], i + 1),
                     s = point(heights[h + 1], i);
          if (towards > 0.0f)
            quad(is_window ? glass : lacquer, p, q, r, s);
          else
            quad(is_window ? glass : lacquer, p, s, r, q);
        }
      }
    };
    const auto joint = [&](float x, float towards) {  // bellows reach a little beyond the joint
      Mesh& mesh = meshes_[trim];
      box(mesh, vec3(std::min(x - 0.6f * towards, x + (joint_gap_m + 0.10f) * towards), -half + 0.10f, 0.28f),
          vec3(std::max(x - 0.6f * towards, x + (joint_gap_m + 0.10f) * towards), half - 0.10f,
               eaves_z - 0.02f));
    };
    if (kind_ == SectionKind::front)
      face(0.0f, 1.0f);
    else
      joint(-joint_gap_m, 1.0f);
    if (kind_ == SectionKind::rear)
      face(-length_, -1.0f);
    else
      joint(-length_ + joint_gap_m, -1.0f);
    box(meshes_[trim], vec3(-length_ + (kind_ == SectionKind::rear ? 1.0f : 0.3f), -half + 0.22f, 0.24f),
        vec3(kind_ == SectionKind::front ? -1.0f : -0.3f, half - 0.22f, 0.33f));
  }

  int add_node(const char* name, vec3 at) {
    scene::ModelNode node;
    node.name = name, node.parent = 0, node.translation = glm::dvec3(at);
    model_->nodes.push_back(node);
    return int(model_->nodes.size()) - 1;
  }
  void add_part(Mesh mesh, int material, int node) {
    if (mesh.indices.empty()) return;
    scene::Part part;
    part.object = model_->materials[std::size_t(material)].name, part.mesh = std::move(mesh),
    part.material = material, part.node = node;
    model_->parts.push_back(std::move(part));
  }

  void add_doors() {
    // A dark room behind the leaves.
    for (const float first : {door_from_end_m, length_ - door_from_end_m - door_m}) {
      box(meshes_[trim], vec3(-first - door_m, -half + 0.45f, floor_z), vec3(-first, half - 0.45f, lintel_z));
      box(meshes_[metal], vec3(-first - door_m, -half + 0.05f, floor_z - 0.05f),
          vec3(-first, half - 0.05f, floor_z));
      for (const float side : {1.0f, -1.0f})
        for (const int leaf : {0, 1}) {
          const float x0 = -first - 0.5f * door_m * float(leaf);  // its front edge
          const int node = add_node(fmt_name(side, leaf), vec3(x0, 0.0f, 0.0f));
          Mesh pane, frame;
          const auto strip = [&](Mesh& mesh, float from, float to, float low, float high) {
            const vec3 p(-from, side * side_y(low), low), q(-to, side * side_y(low), low),
                r(-to, side * side_y(high), high), s(-from, side * side_y(high), high);
            const vec3 in(0.0f, 0.03f * side, 0.0f);  // a leaf has two faces
            if (side > 0.0f)
              quad(mesh, p, q, r, s), quad(mesh, p - in, s - in, r - in, q - in);
            else
              quad(mesh, p, s, r, q), quad(mesh, p - in, q - in, r - in, s - in);
          };
          const float w = 0.5f * door_m;
          strip(frame, 0.0f, 0.06f, 0.45f, lintel_z), strip(frame, w - 0.06f, w, 0.45f, lintel_z);
          strip(frame, 0.06f, w - 0.06f, 0.45f, 0.66f),
              strip(frame, 0.06f, w - 0.06f, lintel_z - 0.08f, lintel_z);
          strip(pane, 0.06f, w - 0.06f, 0.66f, lintel_z - 0.08f);
          add_part(std::move(frame), lacquer, node), add_part(std::move(pane), glass, node);
        }
    }
  }
  static const char* fmt_name(float side, int leaf) {
    return side > 0.0f ? (leaf == 0 ? "door left front" : "door left rear")
                       : (leaf == 0 ? "door right front" : "door right rear");
  }

  void add_bogie() {
    const float middle = -bogie_m[kind_ == SectionKind::front ? 0 : kind_ == SectionKind::middle ? 2 : 4];
    box(meshes_[trim], vec3(middle - 1.25f, -0.62f, 0.20f), vec3(middle + 1.25f, 0.62f, 0.42f));
    for (const float axle : {0.5f, -0.5f}) {
      const int node = add_node("wheels", vec3(middle + axle * wheelbase_m, 0.0f, wheel_radius_m));
      Mesh mesh;
      for (const float side : {1.0f, -1.0f}) {
        constexpr int steps = 20;
        const float inner = side * (0.5f * gauge_m - 0.02f), outer = side * (0.5f * gauge_m + 0.055f);
        for (int i = 0; i < steps; ++i) {
          const auto on_rim = [&](int k, float y) {
            const float a = 2.0f * std::numbers::pi_v<float> * float(k) / float(steps);
            return vec3(wheel_radius_m * std::cos(a), y, wheel_radius_m * std::sin(a));
          };
          const float low = std::min(inner, outer), high = std::max(inner, outer);
          quad(mesh, on_rim(i, low), on_rim(i, high), on_rim(i + 1, high), on_rim(i + 1, low));
          quad(mesh, on_rim(i, high), vec3(0, high, 0), vec3(0, high, 0), on_rim(i + 1, high));
          quad(mesh, on_rim(i + 1, low), vec3(0, low, 0), vec3(0, low, 0), on_rim(i, low));
        }
      }
      add_part(std::move(mesh), metal, node);
    }
  }

  void add_pantograph() {
    Mesh& mesh = meshes_[trim];
    const float x = -2.6f;
    const auto bar = [&](vec3 a, vec3 b, float r) {
      const vec3 along = glm::normalize(b - a),
                 u = glm::normalize(glm::cross(along, vec3(0.0f, 1.0f, 0.01f))) * r, v = glm::cross(along, u);
      quad(mesh, a + u, b + u, b + v, a + v), quad(mesh, a + v, b + v, b - u, a - u);
      quad(mesh, a - u, b - u, b - v, a - v), quad(mesh, a - v, b - v, b + u, a + u);
    };
    box(mesh, vec3(x - 0.7f, -0.5f, height_m - 0.13f), vec3(x + 0.7f, 0.5f, height_m - 0.02f));
    for (const float y : {0.25f, -0.25f})
      bar({x + 0.5f, y, height_m}, {x - 0.9f, 0.6f * y, 4.35f}, 0.025f),
          bar({x - 0.9f, 0.6f * y, 4.35f}, {x + 0.1f, y, contact_z}, 0.02f);
    bar({x + 0.1f, -0.7f, contact_z}, {x + 0.1f, 0.7f, contact_z}, 0.03f);
  }
  static constexpr float contact_z = 5.48f;

  void add_lamps() {
    const bool is_front = kind_ == SectionKind::front;
    const float x = is_front ? 0.03f : -length_ - 0.03f, toward = is_front ? 1.0f : -1.0f;
    for (const float y : {0.62f, -0.62f})
      box(meshes_[is_front ? lamp_white : lamp_red], vec3(x - 0.08f + 0.02f * toward, y - 0.10f, 0.70f),
          vec3(x + 0.08f + 0.10f * toward, y + 0.10f, 0.80f));
  }

  SectionKind kind_;
  float length_ = 0.0f;
  std::shared_ptr<scene::Model> model_ = std::make_shared<scene::Model>();
  std::vector<Mesh> meshes_;  ///< by Surface, of the root
};

/// The frame at `origin` that looks along `forward`.
glm::mat4 frame(vec3 origin, vec3 forward) {
  forward = glm::normalize(forward);
  const vec3 left = glm::normalize(glm::cross(vec3(0, 0, 1), forward));
  return {glm::vec4(forward, 0), glm::vec4(left, 0), glm::vec4(glm::cross(forward, left), 0),
          glm::vec4(origin, 1)};
}

}  // namespace

std::shared_ptr<const scene::Model> section_model(SectionKind kind, glm::vec3 colour) {
  return SectionBuilder(kind, colour).build();
}

std::vector<float> doors_behind_front() {
  std::vector<float> doors;
  float before_m = 0.0f;
  for (std::size_t section = 0; section < section_count; ++section) {
    const float long_m = section_length_m[section], middle_m = door_from_end_m + 0.5f * door_m;
    if (kind_of_section[section] == SectionKind::hung)
      doors.insert(doors.end(), {before_m + middle_m, before_m + long_m - middle_m});
    before_m += long_m;
  }
  return doors;
}

std::vector<glm::mat4> section_pose(const scene::Model& model, float doors, bool is_left_side,
                                    double travelled_m) {
  std::vector<glm::mat4> pose = scene::rest_pose(model);
  const double turns = travelled_m / (2.0 * std::numbers::pi * double(wheel_radius_m));
  const float angle = float((turns - std::floor(turns)) * 2.0 * std::numbers::pi);
  for (std::size_t n = 1; n < pose.size(); ++n) {
    const std::string& name = model.nodes[n].name;
    if (name == "wheels") {
      pose[n] = glm::rotate(pose[n], angle, vec3(0, 1, 0));
    } else if (name.starts_with(is_left_side ? "door left" : "door right")) {
      // Leaves come out first, then slide along the wall.
      const float out = std::min(1.0f, 5.0f * doors) * 0.07f,
                  along = 0.5f * door_m * std::max(0.0f, 1.25f * doors - 0.25f);
      const float towards = name.ends_with("front") ? 1.0f : -1.0f;
      pose[n] = glm::translate(pose[n], vec3(towards * along, is_left_side ? out : -out, 0.0f));
    }
  }
  return pose;
}

std::array<glm::mat4, section_count> placed_sections(const scene::MeasuredPath& track, double front_m) {
  std::array<glm::mat4, section_count> placed{};
  std::array<float, section_count> begins{};
  for (std::size_t i = 1; i < begins.size(); ++i) begins[i] = begins[i - 1] + section_length_m[i - 1];
  for (const std::size_t i : {0u, 2u, 4u}) {
    const float middle = float(front_m) - begins[i] - bogie_m[i];
    const vec3 front = track.at(middle + 0.5f * wheelbase_m), rear = track.at(middle - 0.5f * wheelbase_m);
    const vec3 forward = glm::normalize(front - rear);
    placed[i] = frame(0.5f * (front + rear) + bogie_m[i] * forward, forward);
  }
  for (const std::size_t i : {1u, 3u}) {
    const vec3 front(placed[i - 1] * glm::vec4(-section_length_m[i - 1], 0, 0, 1)), rear(placed[i + 1][3]);
    // As long as the joints are apart, within a few centimetres: it lies in their middle.
    const vec3 forward = glm::normalize(front - rear);
    placed[i] = frame(0.5f * (front + rear) + 0.5f * section_length_m[i] * forward, forward);
  }
  return placed;
}

}  // namespace parvis::tram
