#include "life/people/person_model.h"

#include <algorithm>
#include <cmath>

#include "base/colour.h"
#include "life/people/one_part.h"
#include "scene/data/mip_levels.h"

namespace parvis::people {
namespace {

using glm::vec3;

vec3 rgb(int r, int g, int b) { return linear_from_srgb8(r, g, b); }

template <class T, std::size_t n>
const T& pick(const std::array<T, n>& list, Random& random) {
  return list[std::size_t(random.index(int(n)))];
}

const std::array<vec3, 7>& skins() {
  static const std::array<vec3, 7> tones{rgb(233, 196, 172), rgb(226, 184, 156), rgb(214, 168, 136),
                                         rgb(197, 147, 112), rgb(168, 116, 82),  rgb(122, 80, 56),
                                         rgb(86, 56, 42)};
  return tones;
}
const std::array<vec3, 7>& hairs() {
  static const std::array<vec3, 7> tones{rgb(30, 24, 22), rgb(48, 34, 26),   rgb(70, 48, 34),
                                         rgb(98, 68, 44), rgb(150, 110, 70), rgb(186, 150, 100),
                                         rgb(112, 56, 34)};
  return tones;
}

constexpr int walk_keys = 32, spot_keys = 25;
constexpr float spot_s = 12.0f;  // a cycle of somebody on the spot

/// Keys of the pelvis and of every bone.
scene::Animation animation(const char* name, const std::vector<Posture>& postures, float duration_s) {
  scene::Animation result;
  result.name = name, result.duration_s = duration_s;
  const auto time = [&](std::size_t i) { return duration_s * float(i) / float(postures.size() - 1); };
  scene::AnimationChannel place;
  place.node = pelvis + 1;
  for (std::size_t i = 0; i < postures.size(); ++i) {
    place.times_s.push_back(time(i));
    place.values.emplace_back(postures[i].pelvis_position, 0.0f);
  }
  result.channels.push_back(std::move(place));
  for (int b = 0; b < bone_count; ++b) {
    scene::AnimationChannel turn;
    turn.node = b + 1, turn.property = scene::AnimationChannel::Property::rotation;
    glm::quat before(1, 0, 0, 0);
    for (std::size_t i = 0; i < postures.size(); ++i) {
      glm::quat q = postures[i].turn[std::size_t(b)];
      if (glm::dot(q, before) < 0.0f) q = -q;
      before = q;
      turn.times_s.push_back(time(i));
      turn.values.emplace_back(q.x, q.y, q.z, q.w);
    }
    result.channels.push_back(std::move(turn));
  }
  return result;
}

void add_animations(const BodyField& body, float speed_m_s, bool holds_handle, scene::Model& model) {
  const auto with_hands = [&](Posture posture) {
    if (holds_handle) hold_handle(body, posture);
    return posture;
  };
  const Stride stride = stride_of(body.shape(), speed_m_s);
  std::vector<Posture> walk;
  for (int i = 0; i <= walk_keys; ++i)
    walk.push_back(with_hands(
        walking(body, stride, straight_feet(body, stride, float(i % walk_keys) / float(walk_keys)))));
  model.animations.push_back(animation("walk", walk, stride.length_m / speed_m_s));
  const std::array<std::pair<const char*, Activity>, 5> activities{{{"stand", Activity::stand},
                                                                    {"wait", Activity::wait},
                                                                    {"talk", Activity::talk},
                                                                    {"phone", Activity::phone},
                                                                    {"sit", Activity::sit}}};
  for (const auto& [name, activity] : activities) {
    std::vector<Posture> keys;
    for (int i = 0; i < spot_keys; ++i) {
      // There and back, so that the end is the beginning.
      const float t = 1.0f - std::abs(2.0f * float(i) / float(spot_keys - 1) - 1.0f);
      keys.push_back(
          with_hands(on_the_spot(body, activity, 0.5f * spot_s * t, body.shape().stature * 31.0f)));
    }
    model.animations.push_back(animation(name, keys, spot_s));
  }
}

void add_part(const BodyField& body, const char* name, Mesh mesh, Surface surface, Moves moves,
              scene::Model& model) {
  if (!mesh.indices.empty()) model.parts.push_back(bound_part(body, name, std::move(mesh), surface, moves));
}

Mesh hat_mesh(const HeadField& head, Hat hat, float cell_m) {
  const Field field = [&, hat](vec3 p) {
    float d;
    if (hat == Hat::woollen) {
      d = ellipsoid(p, {-0.055f, 0.0f, 0.70f}, {0.470f, 0.378f, 0.365f});
      d = smooth_max(d, 0.655f - 0.20f * (p.x + 0.05f) * -1.0f - p.z, 0.02f);
      const float fold = 0.69f + 0.20f * (p.x + 0.05f);
      d -= 0.020f * std::exp(-std::pow((p.z - fold) / 0.05f, 4.0f));
    } else {
      d = smooth_max(ellipsoid(p, {-0.05f, 0.0f, 0.70f}, {0.465f, 0.372f, 0.345f}), 0.735f - p.z, 0.02f);
      d = smooth_min(d,
                     smooth_max(ellipsoid(p, {0.36f, 0.0f, 0.755f - 0.12f * p.x}, {0.32f, 0.27f, 0.016f}),
                                0.25f - p.x, 0.01f),
                     0.012f);
    }
    return d;
  };
  Mesh mesh = surface_net(field, {-0.65f, -0.55f, 0.45f}, {0.85f, 0.55f, 1.15f}, cell_m / head.size_m());
  for (vec3& p : mesh.positions) p = head.in_model(p);
  return mesh;
}

std::vector<scene::Texture> textures(Image8 face) {
  std::vector<scene::Texture> list(4);
  list[0].name = "face", list[0].image = std::move(face);
  list[0].wrap_u = scene::Wrap::repeat, list[0].wrap_v = scene::Wrap::clamp;
  static const Image8 strands = strand_texture(256), normals = strand_normals(256),
                      yarns = cloth_texture(256);
  list[1].name = "strands", list[1].image = strands;
  list[2].name = "strand normals", list[2].image = normals, list[2].is_srgb = false;
  list[3].name = "yarns", list[3].image = yarns;
  return list;
}

scene::Material material(const char* name, vec3 colour, float roughness) {
  scene::Material result;
  result.name = name, result.base_colour = colour, result.roughness = roughness;
  return result;
}

/// A person's parts and materials, without textures and animations.
scene::Model dressed_model(const BodyField& body, const HeadField& head, const Someone& who,
                           const Colours& colours, Detail detail) {
  scene::Model model;
  model.name = "person";
  model.nodes = nodes_of(body.skeleton());
  model.materials = {material("face", vec3(1.0f), 0.52f),     material("skin", who.head.skin, 0.55f),
                     material("hair", who.head.hair, 0.62f),  material("top", colours.top, 0.88f),
                     material("shirt", colours.shirt, 0.85f), material("bottom", colours.bottom, 0.88f),
                     material("shoes", colours.shoes, 0.5f),  material("accessory", colours.accessory, 0.6f)};
  model.materials[face_skin].base_colour_texture = 0;
  scene::Material& locks_of = model.materials[hair];
  locks_of.base_colour_texture = 1, locks_of.normal_texture = 2, locks_of.is_double_sided = true;
  for (const Surface s : {top_cloth, bottom_cloth}) model.materials[s].is_double_sided = true;
  for (const Surface s : {top_cloth, shirt, bottom_cloth}) model.materials[s].base_colour_texture = 3;
  constexpr std::array<float, 3> cells{1.24f, 1.95f, 3.9f};
  constexpr std::array<glm::ivec2, 3> head_cells{{{52, 48}, {30, 28}, {12, 12}}},
      hair_cells{{{44, 26}, {24, 14}, {10, 7}}};
  const auto level = std::size_t(detail);
  add_part(body, "head", head_mesh(head, head_cells[level].x, head_cells[level].y), face_skin,
           Moves::head_and_neck, model);
  Mesh locks = hair_mesh(head, who.head, hair_cells[level].x, hair_cells[level].y);
  if (who.outfit.hat != Hat::none && !locks.indices.empty()) {  // below the hat
    const float rim = head.in_model(vec3(0.0f, 0.0f, 0.70f)).z;
    locks = clipped(locks, [&](vec3 p) { return p.z - rim; });
  }
  add_part(body, "hair", std::move(locks), hair, Moves::head_and_neck, model);
  if (who.outfit.hat != Hat::none)
    add_part(body, "hat", hat_mesh(head, who.outfit.hat, 0.011f * cells[level]), accessory,
             Moves::head_and_neck, model);
  for (Garment& garment : dressed(body, who.outfit, cells[level]))
    add_part(body, garment.name, std::move(garment.mesh), garment.surface, garment.moves, model);
  return model;
}

}  // namespace

Someone someone(std::uint64_t number) {
  Random random(number, 77);
  // Ages as on a pavement by day.
  constexpr std::array<float, 12> ages{9.0f,  22.0f, 26.0f, 30.0f, 34.0f, 38.0f,
                                       43.0f, 48.0f, 55.0f, 62.0f, 68.0f, 75.0f};
  const float age = pick(ages, random) + random.uniform(-2.0f, 2.0f);
  return someone(number, random.chance(0.5f) ? Sex::male : Sex::female, age);
}

Someone someone(std::uint64_t number, Sex sex, float age) {
  Random random(number, 78);
  Someone who;
  who.person.sex = sex, who.person.age = std::clamp(age, 4.0f, 95.0f);
  who.person.taller_sd = 1.2f * (random.uniform() + random.uniform() + random.uniform() - 1.5f);
  who.person.bmi =
      std::clamp(23.5f + (age > 35.0f ? 2.2f : 0.0f) + 5.5f * (random.uniform() + random.uniform() - 1.0f),
                 18.5f, 33.0f);
  const bool is_female = sex == Sex::female, is_child = age < 15.0f;
  if (is_child) who.person.bmi = std::min(who.person.bmi, 24.0f);
  HeadLook& head = who.head;
  head.is_female = is_female, head.age = age;
  constexpr std::array<int, 12> tone_of{0, 0, 1, 1, 1, 2, 2, 3, 3, 4, 5, 6};
  const int tone = pick(tone_of, random);
  head.skin = skins()[std::size_t(tone)];
  head.hair = tone >= 4 ? hairs()[std::size_t(random.index(2))] : pick(hairs(), random);
  const float grey = std::clamp((age - 45.0f) / 25.0f, 0.0f, 0.92f) * (random.chance(0.7f) ? 1.0f
                                                                       : is_female         ? 0.0f
                                                                                           : 0.5f);
  head.hair = glm::mix(head.hair, rgb(172, 168, 162), grey);
  const std::array<vec3, 5> irises{rgb(64, 42, 28), rgb(92, 62, 38), rgb(88, 110, 130), rgb(96, 110, 84),
                                   rgb(70, 86, 104)};
  head.iris = tone >= 3 ? irises[std::size_t(random.index(2))] : pick(irises, random);
  constexpr std::array<HairStyle, 6> female{HairStyle::bob, HairStyle::long_hair, HairStyle::long_hair,
                                            HairStyle::bun, HairStyle::pony_tail, HairStyle::parted};
  constexpr std::array<HairStyle, 5> male{HairStyle::parted, HairStyle::parted, HairStyle::cropped,
                                          HairStyle::cropped, HairStyle::bald};
  head.style = is_female ? pick(female, random) : pick(male, random);
  if (!is_female && head.style == HairStyle::bald && age < 35.0f) head.style = HairStyle::cropped;
  if (is_female && age > 60.0f && head.style == HairStyle::long_hair) head.style = HairStyle::bob;
  head.beard = !is_female && age > 20.0f && random.chance(0.35f) ? random.uniform(0.5f, 0.9f) : 0.0f;
  head.has_make_up = is_female && age > 17.0f && random.chance(0.5f);
  head.nose = random.uniform(-1.0f, 1.0f), head.jaw = random.uniform(-1.0f, 1.0f);
  head.cheeks = std::clamp((who.person.bmi - 24.0f) / 6.0f, -1.0f, 1.0f) + (is_child ? 0.6f : 0.0f);
  head.lips = random.uniform(-1.0f, 1.0f), head.eyes = is_child ? 0.9f : random.uniform(-1.0f, 0.7f);
  if (is_child) head.nose = -1.0f, head.jaw = -1.0f;
  Outfit& outfit = who.outfit;
  constexpr std::array<Top, 7> male_tops{Top::t_shirt, Top::pullover, Top::jacket,  Top::jacket,
                                         Top::coat,    Top::t_shirt,  Top::pullover};
  constexpr std::array<Top, 7> female_tops{Top::t_shirt, Top::blouse, Top::pullover, Top::jacket,
                                           Top::coat,    Top::blouse, Top::pullover};
  outfit.top = is_female ? pick(female_tops, random) : pick(male_tops, random);
  if (is_child) outfit.top = random.chance(0.5f) ? Top::t_shirt : Top::pullover;
  constexpr std::array<Bottom, 6> male_bottoms{Bottom::trousers, Bottom::trousers, Bottom::jeans,
                                               Bottom::jeans,    Bottom::trousers, Bottom::shorts};
  constexpr std::array<Bottom, 6> female_bottoms{Bottom::trousers, Bottom::jeans, Bottom::jeans,
                                                 Bottom::skirt,    Bottom::dress, Bottom::trousers};
  outfit.bottom = is_female ? pick(female_bottoms, random) : pick(male_bottoms, random);
  if (outfit.bottom == Bottom::shorts && outfit.top != Top::t_shirt) outfit.bottom = Bottom::jeans;
  if (outfit.bottom == Bottom::dress && outfit.top != Top::blouse && outfit.top != Top::jacket)
    outfit.bottom = Bottom::skirt;
  if (outfit.top == Top::coat && outfit.bottom == Bottom::skirt) outfit.bottom = Bottom::jeans;
  if (random.chance(is_child ? 0.6f : 0.2f))
    outfit.bag = Bag::backpack;
  else if (random.chance(is_female ? 0.45f : 0.15f))
    outfit.bag = Bag::shoulder_bag;
  if (head.style != HairStyle::bun && head.style != HairStyle::pony_tail &&
      random.chance(outfit.top == Top::coat ? 0.4f : 0.1f))
    outfit.hat = outfit.top == Top::coat ? Hat::woollen : Hat::cap;
  return who;
}

Colours colours_of(const Someone& who, std::uint64_t number) {
  Random random(number, 79);
  const bool is_warm = who.outfit.top == Top::t_shirt || who.outfit.top == Top::blouse;
  const std::array<vec3, 10> bright{
      rgb(238, 236, 230), rgb(206, 216, 226), rgb(70, 98, 142),   rgb(176, 62, 56),   rgb(222, 196, 120),
      rgb(110, 140, 116), rgb(40, 44, 56),    rgb(226, 170, 160), rgb(124, 160, 178), rgb(160, 156, 150)};
  const std::array<vec3, 10> sober{rgb(44, 48, 60), rgb(66, 62, 58),  rgb(96, 84, 68),  rgb(124, 112, 96),
                                   rgb(52, 66, 56), rgb(116, 44, 46), rgb(60, 80, 112), rgb(150, 146, 140),
                                   rgb(34, 34, 38), rgb(164, 132, 92)};
  const std::array<vec3, 6> shirts{rgb(236, 236, 234), rgb(196, 210, 226), rgb(226, 214, 206),
                                   rgb(120, 126, 136), rgb(150, 60, 60),   rgb(60, 66, 80)};
  const std::array<vec3, 5> jeans{rgb(52, 66, 96), rgb(72, 90, 122), rgb(38, 44, 60), rgb(104, 122, 148),
                                  rgb(34, 34, 38)};
  const std::array<vec3, 6> trousers{rgb(50, 50, 54), rgb(84, 76, 66),   rgb(150, 136, 112),
                                     rgb(62, 66, 76), rgb(112, 106, 98), rgb(36, 40, 52)};
  const std::array<vec3, 5> shoes{rgb(30, 28, 28), rgb(78, 52, 36), rgb(210, 208, 204), rgb(56, 58, 64),
                                  rgb(118, 84, 56)};
  const std::array<vec3, 5> bags{rgb(44, 42, 44), rgb(96, 62, 40), rgb(120, 50, 46), rgb(62, 76, 70),
                                 rgb(70, 84, 116)};
  Colours c;
  const vec3 vary(random.uniform(0.88f, 1.08f), random.uniform(0.90f, 1.06f), random.uniform(0.88f, 1.08f));
  c.top = vary * (is_warm               ? pick(bright, random)
                  : random.chance(0.3f) ? pick(bright, random)
                                        : pick(sober, random));
  c.shirt = pick(shirts, random);
  const bool is_skirt = who.outfit.bottom == Bottom::skirt || who.outfit.bottom == Bottom::dress;
  c.bottom = who.outfit.bottom == Bottom::jeans ? pick(jeans, random)
             : is_skirt                         ? pick(sober, random)
                                                : pick(trousers, random);
  if (who.outfit.bottom == Bottom::dress) c.bottom = c.top;
  c.shoes = pick(shoes, random), c.accessory = pick(bags, random);
  return c;
}

std::vector<scene::Material> painted(const scene::Model& model, const Colours& colours) {
  std::vector<scene::Material> materials = model.materials;
  materials[top_cloth].base_colour = colours.top, materials[shirt].base_colour = colours.shirt;
  materials[bottom_cloth].base_colour = colours.bottom, materials[shoe].base_colour = colours.shoes;
  materials[accessory].base_colour = colours.accessory;
  return materials;
}

PersonMesh make_person(const Someone& who, const Colours& colours, float speed_m_s, bool holds_handle) {
  PersonMesh result{BodyField(shape_of(who.person)), nullptr};
  const HeadField head(result.body, who.head);
  scene::Model model = dressed_model(result.body, head, who, colours, Detail::near);
  model.textures = textures(face_texture(head, who.head, 512));
  add_animations(result.body, speed_m_s, holds_handle, model);
  result.model = std::make_shared<const scene::Model>(std::move(model));
  return result;
}

PersonLevels make_levels(const Someone& who, const Colours& colours) {
  PersonLevels result{BodyField(shape_of(who.person)), {}, {}};
  const HeadField head(result.body, who.head);
  std::vector<scene::Texture> list = textures(face_texture(head, who.head, 384));
  const std::vector<Image8> smaller = scene::smaller_mip_levels(list[0], 0);
  const Image8 &half = smaller[0], &small = smaller[2];
  const auto keep = [&](Detail detail, scene::Model model) {
    result.models[std::size_t(detail)] = std::make_shared<const scene::Model>(std::move(model));
  };
  scene::Model near = dressed_model(result.body, head, who, colours, Detail::near);
  near.textures = list;
  keep(Detail::near, std::move(near));
  scene::Model middle = dressed_model(result.body, head, who, colours, Detail::middle);
  list[0].image = half;
  middle.textures = std::move(list);
  keep(Detail::middle, std::move(middle));
  scene::Model far = dressed_model(result.body, head, who, colours, Detail::far);
  OnePart joined;
  for (const scene::Part& part : far.parts) joined.add(part, part.material == face_skin ? &small : nullptr);
  OnePart simple = distant_body(result.body, head, who);
  for (const auto& [detail, one] : {std::pair(Detail::far, &joined), {Detail::distant, &simple}}) {
    PersonLevels::Cover& cover = result.covers[std::size_t(detail)];
    cover = {std::move(one->surfaces), std::move(one->part.mesh.colours)};
    one->part.mesh.colours = painted_vertices(cover, who, colours);
    scene::Model model;
    model.name = "person", model.nodes = nodes_of(result.body.skeleton());
    model.materials = {material("person", vec3(1.0f), 0.8f)};
    model.materials[0].is_double_sided = detail == Detail::far;
    model.parts = {std::move(one->part)};
    keep(detail, std::move(model));
  }
  return result;
}

std::vector<glm::vec4> painted_vertices(const PersonLevels::Cover& cover, const Someone& who,
                                        const Colours& colours) {
  constexpr float strands = 0.7f, yarns = 0.86f;  // means of their textures
  const std::array<vec3, surface_count> of_surface{
      vec3(1.0f),          who.head.skin,         strands * who.head.hair,
      yarns * colours.top, yarns * colours.shirt, yarns * colours.bottom,
      colours.shoes,       colours.accessory};
  std::vector<glm::vec4> result = cover.shades;
  for (std::size_t v = 0; v < result.size(); ++v) result[v] *= glm::vec4(of_surface[cover.surfaces[v]], 1.0f);
  return result;
}

}  // namespace parvis::people
