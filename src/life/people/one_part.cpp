#include "life/people/one_part.h"

#include <algorithm>
#include <cmath>

#include "base/colour.h"
#include "life/people/person_model.h"

namespace parvis::people {
namespace {

using glm::vec3;

/// A section of a tube: an ellipse across it.
struct Section {
  vec3 centre;
  float half_x, half_y;  ///< along the first and the second axis across; 0: the tube's tip
};

/// A tube of few sides. `across` are unit vectors; sections go along their cross product.
Mesh tube(const std::vector<Section>& sections, int sides, vec3 first_across, vec3 second_across) {
  Mesh mesh;
  for (const Section& section : sections)
    for (int i = 0; i < sides; ++i) {
      const float angle = 2.0f * pi * (float(i) + 0.5f) / float(sides);
      mesh.positions.push_back(section.centre + section.half_x * std::cos(angle) * first_across +
                               section.half_y * std::sin(angle) * second_across);
    }
  const auto n = std::uint32_t(sides);
  for (std::uint32_t s = 0; s + 1 < sections.size(); ++s)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = s * n + i, b = s * n + (i + 1) % n, c = a + n, d = b + n;
      mesh.indices.insert(mesh.indices.end(), {a, b, d, a, d, c});
    }
  mesh.normals.resize(mesh.positions.size(), vec3(0.0f)), mesh.uvs.resize(mesh.positions.size());
  fill_normals(mesh);
  return mesh;
}

Mesh upright(const std::vector<Section>& sections, int sides) {
  return tube(sections, sides, vec3(1, 0, 0), vec3(0, 1, 0));
}

Mesh head_tube(const HeadField& head) {
  const auto at = [&](float x, float z, float half_x, float half_y) {
    return Section{head.in_model({x, 0.0f, z}), half_x * head.size_m(), half_y * head.size_m()};
  };
  return upright(
      {at(-0.12f, -0.25f, 0.22f, 0.21f), at(0.05f, 0.10f, 0.24f, 0.20f), at(-0.02f, 0.45f, 0.40f, 0.31f),
       at(-0.05f, 0.80f, 0.38f, 0.29f), at(-0.05f, 1.0f, 0.04f, 0.04f)},
      6);
}

Mesh trunk_tube(const BodyField& body, float cloth_m) {
  const BodyShape& s = body.shape();
  std::vector<Section> sections;
  for (const float part : {-0.12f, 0.05f, 0.42f, 0.76f, 0.96f, 1.08f}) {
    const TrunkStation station = body.station(std::lerp(s.hip_z, s.shoulder_z, part));
    const float shoulders = part == 0.96f ? s.shoulder_y + 0.012f * s.stature : 0.0f;
    sections.push_back({{0.5f * (station.front - station.back), 0.0f, station.z},
                        0.5f * (station.front + station.back) + cloth_m,
                        std::max(station.half, shoulders) + cloth_m});
  }
  return upright(sections, 6);
}

Mesh arm_tube(const BodyField& body, float side, float cloth_m) {
  const Skeleton& k = body.skeleton();
  const std::size_t first = side > 0.0f ? left_upper_arm : right_upper_arm;
  const float h = body.shape().stature;
  const vec3 along = Skeleton::arm_direction(side);
  const auto at = [&](vec3 place, float radius) { return Section{place, radius * h, radius * h}; };
  return tube(
      {at(k.joint[first], 0.028f + cloth_m / h), at(k.joint[first + 1], 0.023f + cloth_m / h),
       at(k.joint[first + 2], 0.017f), at(k.joint[first + 2] + 0.5f * body.shape().hand * along, 0.020f),
       at(k.joint[first + 2] + 0.85f * body.shape().hand * along, 0.006f)},
      4, vec3(1, 0, 0), glm::cross(along, vec3(1, 0, 0)));
}

Mesh leg_tube(const BodyField& body, float side, float cloth_m) {
  const Skeleton& k = body.skeleton();
  const std::size_t first = side > 0.0f ? left_thigh : right_thigh;
  const float h = body.shape().stature, thick = body.shape().thickness;
  const auto at = [&](vec3 place, float radius) { return Section{place, radius * h, radius * h}; };
  return tube(
      {at(k.joint[first], 0.050f * thick + cloth_m / h), at(k.joint[first + 1], 0.033f * thick + cloth_m / h),
       at(glm::mix(k.joint[first + 1], k.joint[first + 2], 0.4f), 0.030f * thick + cloth_m / h),
       at(k.joint[first + 2] - vec3(0.0f, 0.0f, 0.012f * h), 0.022f + cloth_m / h)},
      5, vec3(1, 0, 0), vec3(0, -1, 0));
}

Mesh foot_tube(const BodyField& body, float side) {
  const Skeleton& k = body.skeleton();
  const vec3 ankle = k.joint[side > 0.0f ? left_foot : right_foot];
  const float foot = body.shape().foot, toe = ankle.x + 0.73f * foot;
  const auto at = [&](float x, float z, float half_z, float half_y) {
    return Section{{x, ankle.y, z * foot}, half_z * foot, half_y * foot};
  };
  return tube({at(ankle.x + k.heel_x, 0.14f, 0.13f, 0.11f), at(ankle.x + 0.1f * foot, 0.15f, 0.15f, 0.14f),
               at(toe - 0.15f * foot, 0.08f, 0.08f, 0.16f), at(toe + 0.05f * foot, 0.05f, 0.03f, 0.06f)},
              4, vec3(0, 0, -1), vec3(0, 1, 0));
}

/// A skirt, or the tails of a coat: from the waist down to `hem_z`.
Mesh hanging_tube(const BodyField& body, float hem_z, float cloth_m) {
  const BodyShape& s = body.shape();
  const TrunkStation waist = body.station(s.hip_z + 0.12f * s.stature), hips = body.station(s.hip_z);
  const auto at = [&](const TrunkStation& t, float z, float wider) {
    return Section{{0.5f * (t.front - t.back), 0.0f, z}, 0.5f * (t.front + t.back) + wider, t.half + wider};
  };
  return upright({at(hips, hem_z, 0.05f + cloth_m), at(hips, 0.5f * (hem_z + s.hip_z), 0.03f + cloth_m),
                  at(hips, s.hip_z + 0.01f, cloth_m + 0.005f), at(waist, waist.z, cloth_m + 0.004f)},
                 6);
}

}  // namespace

scene::Part bound_part(const BodyField& body, const char* name, Mesh mesh, Surface surface, Moves moves) {
  auto deformation = std::make_shared<scene::Deformation>();
  deformation->positions = mesh.positions, deformation->normals = mesh.normals;
  scene::Skin& skin = deformation->skin;
  for (int b = 0; b < bone_count; ++b) {
    skin.joints.push_back(b + 1);
    glm::mat4 joint_from_mesh(1.0f);
    joint_from_mesh[3] = glm::vec4(-body.skeleton().joint[std::size_t(b)], 1.0f);
    skin.joint_from_mesh.push_back(joint_from_mesh);
  }
  for (const vec3 p : mesh.positions) {
    const BoundVertex v = bound(body, p, moves);
    skin.joints_of_vertex.push_back(v.bones), skin.weights.push_back(v.weights);
  }
  scene::Part part;
  part.object = name, part.mesh = std::move(mesh), part.material = surface;
  part.deformation = std::move(deformation);
  return part;
}

void OnePart::add(const scene::Part& bound, const Image8* texture) {
  auto joined = part.deformation ? std::make_shared<scene::Deformation>(*part.deformation)
                                 : std::make_shared<scene::Deformation>();
  const scene::Deformation& more = *bound.deformation;
  const auto append_to = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  append_to(joined->positions, more.positions), append_to(joined->normals, more.normals);
  append_to(joined->skin.joints_of_vertex, more.skin.joints_of_vertex);
  append_to(joined->skin.weights, more.skin.weights);
  joined->skin.joints = more.skin.joints, joined->skin.joint_from_mesh = more.skin.joint_from_mesh;
  part.deformation = std::move(joined);
  Mesh mesh = bound.mesh;
  mesh.colours.resize(mesh.positions.size(), glm::vec4(1.0f));
  for (std::size_t v = 0; texture && v < mesh.positions.size(); ++v) {
    const glm::ivec2 size(texture->width, texture->height);
    const glm::ivec2 texel = glm::clamp(glm::ivec2(mesh.uvs[v] * glm::vec2(size)), glm::ivec2(0), size - 1);
    const std::uint8_t* rgb = texture->at(texel.x, texel.y);
    mesh.colours[v] = glm::vec4(linear_from_srgb8(rgb[0], rgb[1], rgb[2]), 1.0f);
  }
  part.object = "person", part.material = 0;
  append(part.mesh, mesh);
  surfaces.insert(surfaces.end(), mesh.positions.size(), Surface(bound.material));
}

OnePart distant_body(const BodyField& body, const HeadField& head, const Someone& who) {
  OnePart result;
  const Outfit& outfit = who.outfit;
  const BodyShape& s = body.shape();
  const bool is_thick = outfit.top == Top::jacket || outfit.top == Top::coat;
  const float cloth_m = is_thick ? 0.02f : 0.012f;
  const bool wears_skirt = outfit.bottom == Bottom::skirt || outfit.bottom == Bottom::dress;
  const auto add = [&](Mesh mesh, Surface surface, Moves moves) {
    result.add(bound_part(body, "person", std::move(mesh), surface, moves));
  };
  add(head_tube(head), skin, Moves::head_and_neck);
  const bool has_hat = outfit.hat != Hat::none;
  const bool is_long = who.head.style == HairStyle::long_hair || who.head.style == HairStyle::bob;
  for (std::size_t v = 0; v < result.surfaces.size() && (has_hat || who.head.style != HairStyle::bald); ++v) {
    const vec3 p = result.part.mesh.positions[v], origin = head.in_model(vec3(0.0f));
    const float hairline = p.x > origin.x ? 0.75f : is_long ? 0.0f : 0.3f;
    if (p.z > origin.z + hairline * head.size_m()) result.surfaces[v] = has_hat ? accessory : hair;
  }
  for (const float side : {1.0f, -1.0f}) {
    const std::size_t before = result.surfaces.size();
    add(arm_tube(body, side, cloth_m), top_cloth, Moves::top);
    const float bare = outfit.top == Top::t_shirt ? 0.5f * s.upper_arm : s.upper_arm + s.forearm + 0.01f;
    for (std::size_t v = before; v < result.surfaces.size(); ++v)
      if (body.along_arm(result.part.mesh.positions[v], side) > bare) result.surfaces[v] = skin;
    const bool has_bare_legs = wears_skirt || outfit.bottom == Bottom::shorts;
    add(leg_tube(body, side, has_bare_legs ? 0.0f : 0.012f), has_bare_legs ? skin : bottom_cloth,
        Moves::bottom);
    add(foot_tube(body, side), shoe, Moves::shoes);
  }
  add(trunk_tube(body, cloth_m), top_cloth, Moves::top);
  if (wears_skirt)
    add(hanging_tube(body, s.knee_z + (outfit.bottom == Bottom::dress ? -0.06f : 0.03f) * s.stature, 0.012f),
        bottom_cloth, Moves::skirt);
  else if (outfit.top == Top::coat)
    add(hanging_tube(body, s.knee_z + 0.045f * s.stature, cloth_m), top_cloth, Moves::skirt);
  if (outfit.bag == Bag::backpack) {
    const float scale = std::max(0.78f, s.stature / 1.75f), chest = std::lerp(s.hip_z, s.shoulder_z, 0.62f),
                x = -body.station(chest).back - cloth_m - 0.07f * scale;
    add(upright({{{x, 0, chest - 0.21f * scale}, 0.01f, 0.01f},
                 {{x, 0, chest - 0.2f * scale}, 0.1f * scale, 0.17f * scale},
                 {{x, 0, chest + 0.2f * scale}, 0.08f * scale, 0.15f * scale},
                 {{x, 0, chest + 0.21f * scale}, 0.01f, 0.01f}},
                4),
        accessory, Moves::top);
  }
  return result;
}

}  // namespace parvis::people
