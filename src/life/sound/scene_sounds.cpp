#include "life/sound/scene_sounds.h"

#include <algorithm>
#include <numbers>

#include "capture/trees/scene_tree.h"
#include "life/propagation/noise_source.h"
#include "life/tram/tram_line.h"
#include "life/vegetation/scene_plant.h"
#include "scene/data/object_names.h"

namespace parvis::sound {
namespace {

constexpr double vehicle_height_m = 0.3, roof_height_m = 3.3, fountain_m = 1.5, max_speed_m_s = 60.0;
constexpr double ring_s = 2.2;       // of a tram that sets off
constexpr double max_piece_m = 5.0;  // of a line source that one place stands for
constexpr double people_reach_m = 40.0, trees_reach_m = 60.0, min_tree_m = 2.0;
constexpr std::size_t max_people = 32, max_trees = 24;  // that are heard one by one

/// "person 12"; what somebody pushes or leads has another name.
bool is_of_crowd(std::string_view name) { return name.starts_with("person ") && name.back() <= '9'; }

/// Somebody or something near the ears.
struct Near {
  std::uint64_t id = 0;
  glm::dvec3 place{0.0};
  double height_m = 0.0, speed_m_s = 0.0;
};

/// Leaves of all the `count` nearest within reach.
void keep_nearest(std::vector<Near>& all, const glm::dvec3& ears, double reach_m, std::size_t count) {
  const auto away_m = [&](const Near& it) { return glm::distance(it.place, ears); };
  std::erase_if(all, [&](const Near& it) { return away_m(it) > reach_m; });
  if (all.size() <= count) return;
  std::ranges::nth_element(all, all.begin() + std::ptrdiff_t(count), {}, away_m);
  all.resize(count);
}

std::uint64_t id_of(std::string_view name, std::uint64_t part) {
  return std::hash<std::string_view>()(name) * 31u + part;
}

bool is_bus(const scene::Object& object) {
  const std::string& name = object.model->name;
  return name.find("bus") != std::string::npos || name.find("truck") != std::string::npos;
}

glm::dvec3 place_of(const scene::Object& object, glm::vec3 offset) {
  return glm::dvec3(object.world_from_model * glm::vec4(offset, 1.0f));
}

}  // namespace

bool is_fountain(std::string_view name) {
  while (!name.empty() && (name.back() == ' ' || (name.back() >= '0' && name.back() <= '9')))
    name.remove_suffix(1);
  return name.ends_with("fountain");
}

void Bed::add(double time_s, Buffers buffers) const {
  const auto length = std::ptrdiff_t(recording->left.size());
  auto at = std::ptrdiff_t(std::llround(time_s * sample_rate)) - std::ptrdiff_t(buffers[0].size());
  at = (at % length + length) % length;
  for (std::size_t i = 0; i < buffers[0].size(); ++i, at = at + 1 == length ? 0 : at + 1) {
    buffers[0][i] += gain * recording->left[std::size_t(at)];
    buffers[1][i] += gain * recording->right[std::size_t(at)];
  }
}

std::vector<Bed> beds_of(const scene::Scene& scene) {
  std::vector<Bed> beds;
  for (const PlacedSound& sound : scene.items<PlacedSound>()) {
    if (!sound.is_on || sound.kind != SoundKind::bed || !sound.recording) continue;
    const double gain =
        propagation::energy(recording_db + sound.level_db - full_scale_db) / sound.recording->mean_square();
    beds.push_back({sound.recording, float(std::sqrt(gain))});
  }
  return beds;
}

double SceneSounds::speed_of(std::uint64_t id, glm::dvec3 position, double step_s) {
  now_[id].position = position;
  const auto before = last_.find(id);
  if (before == last_.end() || step_s <= 0.0) return 0.0;
  const double speed = glm::distance(before->second.position, position) / step_s;
  return speed < max_speed_m_s ? speed : 0.0;  // it was set down elsewhere
}

void SceneSounds::add_placed(const scene::Scene& scene, double step_s, std::vector<Emitter>& emitters) {
  for (const PlacedSound& sound : scene.items<PlacedSound>()) {
    if (!sound.is_on || sound.kind == SoundKind::bed) continue;
    glm::dvec3 position(sound.position);
    if (!sound.follows.empty()) {
      const auto object = std::ranges::find(scene.objects, sound.follows, &scene::Object::name);
      if (object == scene.objects.end() || !object->is_visible) continue;
      position = place_of(*object, sound.position);
    }
    const std::uint64_t id = id_of(sound.called, emitters.size());
    Octaves power = power_db(sound.kind, speed_of(id, position, step_s));
    if (sound.recording)  // 11 dB from the level at 1 m to the sound power, which eight octaves share
      power.fill(recording_db + 11.0 - 10.0 * std::log10(double(octaves)));
    for (double& level : power) level += sound.level_db;
    emitters.push_back({id, sound.kind, position, power, sound.recording});
  }
  // Fountains that no node has given a sound; noise sources, which sound alike, come after them.
  for (const scene::Object& object : scene.objects) {
    if (!object.is_visible || object.is_dynamic || !is_fountain(object.name)) continue;
    const glm::dvec3 water = place_of(object, {0, 0, float(fountain_m)});
    constexpr double same_fountain_m = 10.0;
    if (std::ranges::none_of(emitters, [&](const Emitter& it) {
          return it.kind == SoundKind::fountain && glm::distance(it.position, water) < same_fountain_m;
        }))
      emitters.push_back(
          {id_of(object.name, 3), SoundKind::fountain, water, power_db(SoundKind::fountain, 0.0)});
  }
  for (const propagation::NoiseSource& source : scene.items<propagation::NoiseSource>()) {
    const auto pieces = source.pieces(max_piece_m);
    Octaves power = source.power_db;
    for (double& level : power) level -= 10.0 * std::log10(double(pieces.size()));
    for (const auto& [middle, half] : pieces)
      emitters.push_back({id_of("noise source", emitters.size()), SoundKind::fountain, middle, power});
  }
}

void SceneSounds::add_trams(const scene::Scene& scene, double step_s, std::vector<Emitter>& emitters) {
  for (const tram::TramLine& line : scene.items<tram::TramLine>())
    for (int tram = 0; tram < line.trams(); ++tram) {
      std::array<const scene::Object*, tram::section_count> sections{};
      for (int i = 0; i < tram::section_count; ++i) {
        const auto object =
            std::ranges::find(scene.objects, tram::section_name(line.called, tram, i), &scene::Object::name);
        if (object != scene.objects.end() && object->is_visible) sections[std::size_t(i)] = &*object;
      }
      for (std::size_t i = 0; i < sections.size(); ++i) {
        if (!sections[i]) continue;
        const scene::Object& object = *sections[i];
        const std::uint64_t id = id_of(object.name, 1);
        const glm::dvec3 rail = place_of(object, {0, 0, float(vehicle_height_m)});
        const double speed = speed_of(id, rail, step_s);
        const auto last = last_.find(id);
        const Seen before = last == last_.end() ? Seen{} : last->second;
        Seen& seen = now_[id];
        const auto add = [&](SoundKind kind, const glm::dvec3& place, double louder_db) {
          Octaves power = power_db(kind, speed);
          for (double& level : power) level += louder_db;
          emitters.push_back({id_of(object.name, 10 + std::uint64_t(kind)), kind, place, power});
        };
        add(SoundKind::tram, rail, -10.0 * std::log10(double(tram::section_count)));
        if (i == 0) {
          add(SoundKind::tram_roof, place_of(object, {-2, 0, float(roof_height_m)}), 0.0);
          // It rings as it sets off.
          seen.is_at_rest = last != last_.end() && speed < 0.1;
          seen.rings_until_s =
              before.is_at_rest && !seen.is_at_rest ? time_s_ + ring_s : before.rings_until_s;
          if (time_s_ < seen.rings_until_s) add(SoundKind::tram_bell, place_of(object, {0, 0, 1}), 0.0);
        }
        const std::vector<glm::mat4> rest = scene::rest_pose(*object.model);
        for (std::size_t n = 0; n < object.pose.size(); ++n)
          if (object.model->nodes[n].name.starts_with("door "))
            seen.doors_m += glm::distance(object.pose[n][3], rest[n][3]);
        if (last != last_.end() && std::abs(seen.doors_m - before.doors_m) > 1e-4f)
          add(SoundKind::tram_doors, place_of(object, {-3, 0, 1}), 0.0);
        // The bogies' sections turn against each other in curves.
        const std::size_t other = i == 4 ? 2 : i + 2;
        if (i % 2 != 0 || !sections[other] || speed < 1.0) continue;
        const glm::vec3 own(object.world_from_model[0]), next(sections[other]->world_from_model[0]);
        const double turn = std::acos(std::clamp(double(glm::dot(own, next)), -1.0, 1.0)),
                     apart_m =
                         glm::distance(rail, place_of(*sections[other], {0, 0, float(vehicle_height_m)}));
        constexpr double widest_m = 60.0, tightest_m = 20.0;
        const double tight = (widest_m - apart_m / std::max(turn, 1e-6)) / (widest_m - tightest_m);
        if (tight > 0.0) add(SoundKind::tram_squeal, rail, 20.0 * std::log10(std::min(tight, 1.0)) - 4.8);
      }
    }
}

/// Those who walk tread, and of those who stand or walk together every second one talks.
void SceneSounds::add_people(const scene::Scene& scene, double step_s, const glm::dvec3& ears,
                             const propagation::Terrain* terrain, std::vector<Emitter>& emitters) {
  std::vector<Near> people;
  for (const scene::Object& object : scene.objects)
    if (object.is_visible && (object.name == "person" || is_of_crowd(object.name)))
      people.push_back({id_of(object.name, is_of_crowd(object.name) ? 0 : people.size()),
                        place_of(object, glm::vec3(0.0f))});
  for (Near& person : people) person.speed_m_s = speed_of(person.id, person.place, step_s);
  keep_nearest(people, ears, people_reach_m, max_people);
  for (std::size_t i = 0; i < people.size(); ++i) {
    const Near& person = people[i];
    if (person.speed_m_s > 0.3) {
      const double factor = terrain ? terrain->ground_factor(glm::dvec2(person.place)) : 0.0;
      emitters.push_back(
          {person.id, SoundKind::footsteps, person.place + glm::dvec3(0, 0, 0.05), footsteps_db(factor)});
    }
    constexpr double together_m = 1.6;
    const auto is_with = [&](const Near& other) {
      return other.id != person.id && glm::distance(other.place, person.place) < together_m;
    };
    if (person.id % 2 == 0 && std::ranges::any_of(people, is_with))
      emitters.push_back({person.id + 1, SoundKind::murmur, person.place + glm::dvec3(0, 0, 1.6),
                          power_db(SoundKind::murmur, 0.0)});
  }
}

/// Leaves rustle as the wind comes and goes over the place.
void SceneSounds::add_trees(const scene::Scene& scene, const glm::dvec3& ears,
                            std::vector<Emitter>& emitters) const {
  std::vector<Near> trees;
  const auto add = [&](const glm::mat4& world_from_tree, glm::vec3 foot, double height_m) {
    if (height_m < min_tree_m) return;
    const glm::dvec3 crown =
        glm::dvec3(world_from_tree * glm::vec4(foot, 1.0f)) + glm::dvec3(0, 0, 0.7 * height_m);
    trees.push_back({id_of("tree", trees.size()), crown, height_m});
  };
  for (const vegetation::ScenePlant& plant : vegetation::scene_plants(scene))
    if (plant.is_visible)
      add(plant.world_from_plant, glm::vec3(0.0f),
          double(plant.shape->recipe.height_m * glm::length(plant.world_from_plant[2])));
  for (const trees::SceneTree& tree : trees::scene_trees(scene))
    if (tree.is_visible)
      add(tree.world_from_tree, tree.tree->foot,
          double((tree.tree->box.max.z - tree.tree->foot.z) * glm::length(tree.world_from_tree[2])));
  keep_nearest(trees, ears, trees_reach_m, max_trees);
  for (const Near& tree : trees) {
    constexpr double gust_s = 11.7, usual_m = 8.0;  // a gust of the wind in which captured trees sway
    const double gust =
        0.6 + 0.4 * std::sin(2.0 * std::numbers::pi * time_s_ / gust_s + 0.2 * (tree.place.x + tree.place.y));
    Octaves power = power_db(SoundKind::leaves, 0.0);
    for (double& level : power) level += 20.0 * std::log10(gust * tree.height_m / usual_m);
    emitters.push_back({tree.id, SoundKind::leaves, tree.place, power});
  }
}

std::vector<Emitter> SceneSounds::at(const scene::Scene& scene, double step_s, const glm::dvec3& ears,
                                     const propagation::Terrain* terrain) {
  std::vector<Emitter> emitters;
  now_.clear();
  time_s_ += step_s;
  add_placed(scene, step_s, emitters);
  for (const scene::Object& object : scene.objects) {
    if (!object.is_visible || !object.is_dynamic || !object.name.starts_with("vehicle ")) continue;
    const std::uint64_t id = id_of(object.name, 0);
    const glm::dvec3 position = place_of(object, {0, 0, float(vehicle_height_m)});
    const SoundKind kind = is_bus(object) ? SoundKind::bus : SoundKind::car;
    emitters.push_back({id, kind, position, power_db(kind, speed_of(id, position, step_s))});
  }
  add_trams(scene, step_s, emitters);
  add_people(scene, step_s, ears, terrain, emitters);
  add_trees(scene, ears, emitters);
  std::swap(last_, now_);
  return emitters;
}

}  // namespace parvis::sound
