// Sound: the mix against the sources by themselves, what is heard against the map, shadows, time.
#include "bench/parts.h"
#include "life/sound/listening.h"
#include "life/traffic/demand.h"
#include "planning/noise/noise_map.h"

namespace parvis::bench {
namespace {

using sound::BandNoise;
using sound::Octaves;
using sound::octaves;

/// Sounds that move about the listener at different speeds and distances.
std::vector<sound::HeardSound> crowd_of_sounds(std::size_t count, int moment, bool has_events) {
  std::vector<sound::HeardSound> sounds(count);
  for (std::size_t i = 0; i < count; ++i) {
    const float angle = 2.4f * float(i) + 0.002f * float(moment) * float(i % 7);
    const double distance_m = 5.0 + double(i % 200);
    sounds[i].id = i;
    sounds[i].kind = sound::SoundKind(i % (has_events ? sound::sound_names.size() : 6));
    sounds[i].direction = {std::sin(angle), std::cos(angle), 0.0f};
    sounds[i].energy.fill(1e-3 / (distance_m * distance_m));
    sounds[i].emitted_s = moment / 50.0 - distance_m / 340.0;
  }
  return sounds;
}

/// The fraction of a core that mixing so many moving sounds takes.
double core_fraction(std::size_t count, int moments) {
  sound::Mixer mixer(sound::Output::headphones);
  std::vector<float> left(sound::sample_rate / 50, 0.0f), right(left);
  double took_ms = 0.0;
  for (int i = 0; i < moments; ++i) {
    const auto sounds = crowd_of_sounds(count, i, true);
    took_ms += milliseconds([&] { mixer.mix(sounds, left, right); });
  }
  return took_ms / (1e3 * moments / 50.0);
}

void measure_mix(const BenchSetup& setup, Report& report) {
  const int moments = setup.is_quick ? 100 : 500;
  BandNoise::instance();
  std::size_t realtime = 0;
  for (const std::size_t count : {500u, 1000u, 2000u, 5000u, 10'000u, 20'000u}) {
    const double fraction = core_fraction(count, moments);
    report.note(fmt::format("{} sounds: {:.3f} of a core", count, fraction));
    if (fraction <= 0.25) realtime = count;
  }
  report.add("sources_realtime", double(realtime));

  // Steady noise at a microphone: each octave against the sum of all sounds.
  const auto sounds = crowd_of_sounds(2000, 0, false);
  sound::Mixer mixer(sound::Output::microphone), few(sound::Output::microphone, {.clusters = 2});
  std::vector<float> left(BandNoise::length, 0.0f), right(left);
  mixer.mix(sounds, std::span(left).first(960), std::span(right).first(960));
  std::ranges::fill(left, 0.0f);
  mixer.mix(sounds, left, right);
  few.mix(sounds, right, right);
  Octaves sum{};
  for (const sound::HeardSound& it : sounds)
    for (std::size_t band = 0; band < octaves; ++band) sum[band] += it.energy[band];
  double worst_db = 0.0;
  for (std::size_t band = 0; band < octaves; ++band)
    worst_db = std::max(worst_db, std::abs(propagation::level(sound::band_energy(left, band) / sum[band])));
  report.add("level_error_db_per_band", worst_db);
  report.add("direction_error_deg", glm::degrees(mixer.counts().direction_error_rad));
  report.add("direction_error_deg_of_two_clusters", glm::degrees(few.counts().direction_error_rad));
}

/// A street, a house and listeners about it.
scene::Scene street_with_house() {
  scene::Scene scene;
  scene::Lane lane;
  lane.points = {{-150, 0, 0}, {150, 0, 0}};
  scene.roads.lanes.push_back(lane);
  scene.data<traffic::TrafficDemand>().vehicles = 12;
  scene::Model model;
  model.materials.emplace_back();
  model.nodes.emplace_back();
  scene::Part part;
  part.material = 0, part.node = 0;
  const glm::vec3 low(-15, 12, 0), high(15, 24, 14);
  for (int i = 0; i < 8; ++i)
    part.mesh.positions.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
  part.mesh.indices = {0, 1, 5, 0, 5, 4, 3, 2, 6, 3, 6, 7, 2, 0, 4,
                       2, 4, 6, 1, 3, 7, 1, 7, 5, 4, 5, 7, 4, 7, 6};
  part.mesh.normals.assign(8, {0, 0, 1});
  part.mesh.uvs.assign(8, {0, 0});
  model.parts.push_back(std::move(part));
  scene::Object house;
  house.name = "house";
  house.model = std::make_shared<const scene::Model>(std::move(model));
  scene.objects.push_back(std::move(house));
  return scene;
}

void measure_listening(Report& report) {
  const scene::Scene scene = street_with_house();
  noise::NoiseOptions options;
  options.favourable_fraction = 0.0, options.has_facades = false, options.paths.directions = 72;
  options.area = glm::dvec4(-50, 30, 50, 50), options.cell_m = 20.0;
  const noise::NoiseMap map = must(noise::compute_noise(scene, options));
  sound::Listening listening(scene, sound::Output::microphone);
  std::vector<sound::Emitter> emitters;
  for (std::size_t i = 0; i < map.sources.patches.size(); ++i) {
    sound::Emitter emitter{i, sound::SoundKind::car, map.sources.patches[i].middle, {}};
    for (std::size_t band = 0; band < octaves; ++band)
      emitter.power_db[band] = propagation::level(map.sources.power[i][0][band]);
    emitters.push_back(emitter);
  }
  double worst_db = 0.0, worst_far_db = 0.0;
  const std::size_t listeners = std::min<std::size_t>(map.receivers.size(), 10);
  for (std::size_t r = 0; r < listeners; ++r) {
    Octaves expected{};
    for (std::size_t k = map.transfers.first[r]; k < map.transfers.first[r + 1]; ++k)
      for (std::size_t band = 0; band < octaves; ++band)
        expected[band] +=
            double(map.transfers.energies[k][band]) * map.sources.power[map.transfers.patches[k]][0][band];
    const auto heard_at = [&](glm::dvec3 place) {
      Camera ears;
      ears.world_from_camera[3] = glm::vec4(glm::vec3(place), 1.0f);
      std::vector<float> left(BandNoise::length, 0.0f), right(left);
      listening.hear(emitters, ears, 1.0, std::span(left).first(960), std::span(right).first(960));
      std::ranges::fill(left, 0.0f);
      listening.hear(emitters, ears, 3.0, left, right);
      double worst = 0.0;
      for (std::size_t band = 0; band < octaves; ++band) {
        const double heard = propagation::level(sound::band_energy(left, band)) + sound::full_scale_db;
        worst = std::max(worst, std::abs(heard - propagation::level(expected[band])));
      }
      return worst;
    };
    worst_db = std::max(worst_db, heard_at(map.receivers[r].place));
    if (r == 0) worst_far_db = heard_at(map.receivers[r].place + glm::dvec3(0, 40, 0));
  }
  report.add("map_over_listening_db", worst_db);
  report.add("map_over_listening_db_elsewhere", worst_far_db);
  report.note(fmt::format("{} listeners, {} sources", listeners, emitters.size()));

  // A walk round the corner of the house, past its shadow, in steps of a moment.
  const sound::Emitter car{
      1, sound::SoundKind::car, {0, 4, 0.3}, sound::power_db(sound::SoundKind::car, 10.0)};
  double step_db = 0.0, before_db = 0.0;
  for (double x = -60.0; x < 60.0; x += 1.4 / 60.0) {
    const Octaves levels = listening.level_at(car, {x, 27.0, 1.7});
    const double now_db = propagation::a_weighted(levels);
    if (x > -60.0) step_db = std::max(step_db, std::abs(now_db - before_db));
    before_db = now_db;
  }
  report.add("shadow_edge_step_db", step_db);
}

}  // namespace

void measure_sound(const BenchSetup& setup, Report& report) {
  measure_mix(setup, report);
  measure_listening(report);
}

}  // namespace parvis::bench
