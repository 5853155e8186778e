#include "life/sound/scene_sounds.h"

#include <algorithm>

#include "life/tram/tram_line.h"
#include "scene/data/object_names.h"

namespace parvis::sound {
namespace {

constexpr double vehicle_height_m = 0.3, roof_height_m = 3.3, max_speed_m_s = 60.0;

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
  now_[id] = position;
  const auto before = last_.find(id);
  if (before == last_.end() || step_s <= 0.0) return 0.0;
  const double speed = glm::distance(before->second, position) / step_s;
  return speed < max_speed_m_s ? speed : 0.0;  // it was set down elsewhere
}

std::vector<Emitter> SceneSounds::at(const scene::Scene& scene, double step_s) {
  std::vector<Emitter> emitters;
  now_.clear();
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
  for (const scene::Object& object : scene.objects) {
    if (!object.is_visible || !object.is_dynamic || !object.name.starts_with("vehicle ")) continue;
    const std::uint64_t id = id_of(object.name, 0);
    const glm::dvec3 position = place_of(object, {0, 0, float(vehicle_height_m)});
    const SoundKind kind = is_bus(object) ? SoundKind::bus : SoundKind::car;
    emitters.push_back({id, kind, position, power_db(kind, speed_of(id, position, step_s))});
  }
  for (const tram::TramLine& line : scene.items<tram::TramLine>())
    for (int tram = 0; tram < line.trams(); ++tram)
      for (int section = 0; section < tram::section_count; ++section) {
        const std::string name = tram::section_name(line.called, tram, section);
        const auto object = std::ranges::find(scene.objects, name, &scene::Object::name);
        if (object == scene.objects.end() || !object->is_visible) continue;
        const std::uint64_t id = id_of(name, 1);
        const glm::dvec3 rail = place_of(*object, {0, 0, float(vehicle_height_m)});
        Octaves rolling = power_db(SoundKind::tram, speed_of(id, rail, step_s));
        for (double& level : rolling) level -= 10.0 * std::log10(double(tram::section_count));
        emitters.push_back({id, SoundKind::tram, rail, rolling});
        if (section == 0)
          emitters.push_back({id_of(name, 2), SoundKind::tram_roof,
                              place_of(*object, {-2, 0, float(roof_height_m)}),
                              power_db(SoundKind::tram_roof, 0.0)});
      }
  std::swap(last_, now_);
  return emitters;
}

}  // namespace parvis::sound
