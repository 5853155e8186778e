// Sound: the mix against the sources by themselves, what is heard against the map, shadows, time.
#include <cstring>
#include <ctime>
#include <numbers>

#include "base/random.h"
#include "base/test_data.h"
#include "bench/parts.h"
#include "life/sound/listening.h"
#include "life/sound/openal_module.h"
#include "life/sound/sound_server.h"
#include "life/sound/wave_file.h"
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
    sounds[i].id = sounds[i].seed = i;
    sounds[i].kind = sound::SoundKind(i % (has_events ? sound::synthetic_kinds : sound::steady_kinds));
    sounds[i].direction = {std::sin(angle), std::cos(angle), 0.0f};
    sounds[i].energy.fill(1e-3 / (distance_m * distance_m));
    sounds[i].emitted_s = moment / 50.0 - distance_m / 340.0;
  }
  return sounds;
}

/// Processor time of this thread, which alone mixes: a core's fraction does not depend on what else runs.
template <class Work>
double processor_ms(const Work& work) {
  const auto now_ms = [] {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e3 * double(time.tv_sec) + 1e-6 * double(time.tv_nsec);
  };
  const double began_ms = now_ms();
  work();
  return now_ms() - began_ms;
}

/// The cost of a run of mixing, and how far its clusters are off.
struct MixRun {
  double core_fraction = 0.0, direction_error_deg = 0.0;
};

std::unique_ptr<sound::Loopback> loopback(std::size_t sources) {
  std::vector<float> loop(BandNoise::length, 0.0f);
  Octaves quiet;
  quiet.fill(1e-3);
  BandNoise::instance().add(loop, 0.0, 1.0, quiet, quiet);
  return must(sound::openal.call(&sound::OpenAlFunctions::open_loopback, sources, loop));
}

/// Moving sounds premixed into clusters, which OpenAL Soft renders by HRTF.
MixRun run_mix(std::size_t count, std::size_t clusters, int moments) {
  sound::Mixer mixer(sound::Output::headphones, {.clusters = clusters});
  const auto ears = loopback(clusters);
  std::vector<float> left(sound::device_moment), right(left);
  MixRun run;
  double took_ms = 0.0;
  for (int i = -5; i < moments; ++i) {
    const auto sounds = crowd_of_sounds(count, i, true);
    const double ms = processor_ms([&] { ears->render(mixer.premix(sounds, left.size()), left, right); });
    if (i < 0) continue;  // sources begin
    took_ms += ms;
    run.direction_error_deg += glm::degrees(mixer.counts().direction_error_rad) / moments;
  }
  run.core_fraction = took_ms / (1e3 * moments / 50.0);
  return run;
}

/// The same sounds by OpenAL Soft alone, each a source with HRTF.
double openal_core_fraction(std::size_t count, int moments) {
  const auto ears = loopback(count);
  std::vector<float> left(sound::device_moment), right(left);
  double took_ms = 0.0;
  for (int i = -5; i < moments; ++i) {
    std::vector<glm::vec3> directions;
    for (const sound::HeardSound& it : crowd_of_sounds(count, i, true)) directions.push_back(it.direction);
    const double ms = processor_ms([&] { ears->render_sources(directions, left, right); });
    if (i >= 0) took_ms += ms;
  }
  return took_ms / (1e3 * moments / 50.0);
}

void measure_realtime(const BenchSetup& setup, Report& report) {
  constexpr double quarter = 0.25;
  const int moments = setup.is_quick ? 50 : 250;
  std::size_t realtime = 0;
  for (const std::size_t count : {500u, 1000u, 2000u, 5000u, 7000u, 10'000u, 14'000u, 20'000u}) {
    const double fraction = run_mix(count, sound::MixerLimits{}.clusters, moments).core_fraction;
    report.note(fmt::format("{} sounds in clusters: {:.3f} of a core", count, fraction));
    if (fraction > quarter) break;
    realtime = count;
  }
  report.add("sources_realtime", double(realtime));
  constexpr std::size_t few = 200, some = 400;
  const double of_few = openal_core_fraction(few, moments), of_some = openal_core_fraction(some, moments);
  report.note(fmt::format("OpenAL Soft alone: {} sounds {:.3f}, {} sounds {:.3f} of a core", few, of_few,
                          some, of_some));
  const double alone = double(some) * quarter / of_some;  // its cost grows in proportion
  report.add("sources_realtime_openal_alone", alone);
  report.add("sources_over_openal_alone", double(realtime) / alone);
  const double unclustered = run_mix(some, some, moments).core_fraction;
  report.add("sources_over_openal_alone_unclustered", double(some) * quarter / unclustered / alone);
}

/// Sum of all sounds by octave against both channels of clusters in stereo.
double level_error_db(std::span<const sound::HeardSound> sounds, const sound::MixerLimits& limits) {
  sound::Mixer mixer(sound::Output::stereo, limits);
  std::vector<float> left(BandNoise::length, 0.0f), right(left);
  mixer.mix(sounds, std::span(left).first(960), std::span(right).first(960));
  std::ranges::fill(left, 0.0f), std::ranges::fill(right, 0.0f);
  mixer.mix(sounds, left, right);
  Octaves sum{};
  for (const sound::HeardSound& it : sounds)
    for (std::size_t band = 0; band < octaves; ++band) sum[band] += it.energy[band];
  double worst_db = 0.0;
  for (std::size_t band = 0; band < octaves; ++band)
    worst_db = std::max(worst_db,
                        std::abs(propagation::level(
                            (sound::band_energy(left, band) + sound::band_energy(right, band)) / sum[band])));
  return worst_db;
}

/// The loudest 10 ms above 1.5 kHz of a mix of low sounds alone, against the mean level of the mix: what
/// clusters add when they change. `is_renewed`: a mixer that starts over at each moment.
double click_db(std::size_t clusters, bool is_renewed, int moments) {
  constexpr std::size_t count = 300, window = sound::sample_rate / 100;
  std::optional<sound::Mixer> mixer;
  std::vector<float> heard;
  for (int i = 0; i < moments; ++i) {
    auto sounds = crowd_of_sounds(count, 20 * i, false);
    for (sound::HeardSound& it : sounds)
      for (std::size_t band = 2; band < octaves; ++band) it.energy[band] = 0.0;
    if (!mixer || is_renewed)
      mixer.emplace(sound::Output::headphones, sound::MixerLimits{.clusters = clusters});
    std::vector<float> left(sound::device_moment, 0.0f), right(left);
    mixer->mix(sounds, left, right);
    if (i > 1) heard.insert(heard.end(), left.begin(), left.end());
  }
  double total = 0.0;
  for (const float sample : heard) total += double(sample) * double(sample);
  // Four times a high-pass filter of first order.
  const double weight = std::exp(-2.0 * std::numbers::pi * 1500.0 / sound::sample_rate);
  std::vector<double> high(heard.begin(), heard.end());
  for (int pass = 0; pass < 4; ++pass) {
    double in = high.front(), out = 0.0;
    for (double& sample : high) {
      out = weight * (out + sample - in);
      in = std::exchange(sample, out);
    }
  }
  double loudest = 0.0;
  for (std::size_t begin = 0; begin + window <= high.size(); begin += window) {
    double sum = 0.0;
    for (std::size_t i = begin; i < begin + window; ++i) sum += high[i] * high[i];
    loudest = std::max(loudest, sum / double(window));
  }
  return propagation::level(loudest / (total / double(heard.size())));
}

void measure_mix(const BenchSetup& setup, Report& report) {
  BandNoise::instance();
  measure_realtime(setup, report);
  const int moments = setup.is_quick ? 50 : 250;
  report.add("direction_error_deg",
             run_mix(2000, sound::MixerLimits{}.clusters, moments).direction_error_deg);
  report.add("direction_error_deg_of_two_clusters", run_mix(2000, 2, moments).direction_error_deg);
  const auto sounds = crowd_of_sounds(2000, 0, false);
  report.add("level_error_db_per_band", level_error_db(sounds, {}));
  report.add("level_error_db_per_band_of_deep_masking", level_error_db(sounds, {.masked_db = 3.0}));
  report.add("cluster_switch_click_db", click_db(sound::MixerLimits{}.clusters, false, 4 * moments));
  report.add("cluster_switch_click_db_of_the_unclustered_mix", click_db(300, false, 4 * moments));
  report.add("cluster_switch_click_db_without_crossfades",
             click_db(sound::MixerLimits{}.clusters, true, moments));
}

/// 1 where a bed of birds is heard as its samples times its gain, bit by bit.
double bed_is_identical(const std::shared_ptr<const sound::Recording>& birds, bool has_fountain) {
  scene::Scene scene;
  sound::PlacedSound bed;
  bed.kind = sound::SoundKind::bed, bed.recording = birds, bed.level_db = -4.0;
  scene.data<scene::ItemsOf<sound::PlacedSound>>().add(bed, 0);
  if (has_fountain) scene.data<scene::ItemsOf<sound::PlacedSound>>().add(sound::PlacedSound{}, 0);
  sound::Listening listening(scene, sound::Output::headphones);
  const float gain = sound::beds_of(scene).front().gain;
  Camera ears;
  ears.world_from_camera[3] = {0, 5, 1.7f, 1};
  std::size_t differing = 0;
  for (int i = 1; i <= 100; ++i) {
    std::vector<float> left(sound::device_moment, 0.0f), right(left);
    const std::array buffers{std::span(left), std::span(right)};
    listening.hear(scene, ears, i / 50.0, buffers);
    for (std::size_t k = 0; k < left.size(); ++k) {
      const std::size_t at = (std::size_t(i) - 1) * left.size() + k;
      differing += left[k] != gain * birds->left[at] || right[k] != gain * birds->right[at];
    }
  }
  return differing == 0 ? 1.0 : 0.0;
}

void measure_beds(Report& report) {
  const auto folder = shared_data("sounds", std::filesystem::current_path());
  if (!folder) return report.skip("bed_bit_identical", "the shared data is absent");
  const auto birds =
      std::make_shared<const sound::Recording>(must(sound::read_recording(*folder / "birds.ogg")));
  report.add("bed_bit_identical", bed_is_identical(birds, false));
  report.add("bed_bit_identical_beside_a_fountain", bed_is_identical(birds, true));
}

/// Whether a message asks for what could be played as it stands.
bool asks_for_sound(const std::string& packet) {
  const auto read = sound::liblo.call(&sound::LibloFunctions::decode, packet);
  if (!read || read->address != "/parvis/sound" || read->numbers.size() < 14) return true;
  const std::vector<double>& numbers = read->numbers;
  const double length = glm::length(glm::dvec3(numbers[2], numbers[3], numbers[4]));
  return std::abs(length - 1.0) < 1e-3 &&
         std::all_of(numbers.begin() + 5, numbers.begin() + 13, [](double level) { return level < 160.0; });
}

/// Random packets, of which most begin as true messages: after how many the server's state is sound.
void measure_server(Report& report) {
  constexpr int packets = 1'000'000, checked_each = 100;
  sound::HeardSound bell;
  bell.kind = sound::SoundKind::bell, bell.energy.fill(1e-3);
  sound::HeardSound recording = bell;
  recording.kind = sound::SoundKind::recording;
  const std::string bytes(40'000, 'x'), file = sound::name_of_recording(bytes);
  std::vector<std::string> whole;
  for (const sound::OscMessage& message :
       {sound::message_of(bell, 0.0), sound::message_of(recording, 0.0, file), sound::part_of(file, bytes, 3),
        sound::OscMessage{"/parvis/bed", {0.0, 0.5}, {file, ""}},
        sound::OscMessage{"/parvis/mute", {0.0}, {""}}, sound::OscMessage{"/parvis/silent", {0.0}, {""}},
        sound::OscMessage{"/parvis/ping", {}, {}}})
    whole.push_back(must(sound::liblo.call(&sound::LibloFunctions::encode, message)));
  Random random{48};
  sound::ServedSounds served;
  int sound_packets = 0, taken = 0, unchecked = 0;
  std::size_t max_heard = 0, max_wanted = 0;
  for (int i = 1; i <= packets; ++i) {
    // Sounds are what can do harm: every second packet.
    std::string packet = whole[random.chance(0.5f) ? 0 : std::size_t(random.index(int(whole.size())))];
    for (int flips = random.index(12); flips > 0; --flips)
      packet[std::size_t(random.index(int(packet.size())))] = char(random.index(256));
    if (random.index(4) == 0) packet.resize(std::size_t(random.index(int(packet.size()))));
    const double now_s = 1e-3 * i;
    taken += served.take(packet, now_s) ? 1 : 0;
    unchecked += asks_for_sound(packet) ? 1 : 0;
    if (i % checked_each != 0) continue;
    const std::vector<sound::HeardSound> heard = served.heard(now_s);
    const std::vector<sound::Bed> beds = served.beds(now_s);
    const std::size_t wanted = served.recordings().wanted(now_s).size();
    max_heard = std::max(max_heard, heard.size()), max_wanted = std::max(max_wanted, wanted);
    const bool is_sound =
        heard.size() <= sound::ServedSounds::max_sounds && beds.size() <= sound::ServedSounds::max_beds &&
        wanted <= sound::SentRecordings::max_files &&
        std::ranges::all_of(heard, [](const sound::HeardSound& it) {
          return std::isfinite(it.emitted_s) && std::abs(glm::length(it.direction) - 1.0f) < 1e-3f &&
                 std::ranges::all_of(it.energy, [](double e) { return e >= 0.0 && e < 1e6; });
        });
    sound_packets += is_sound ? checked_each : 0;
  }
  if (taken < packets / 100 || max_heard == 0 || max_wanted == 0)
    fail("of {} packets the server took {}, heard {} sounds and asked for {} recordings: it was not tried",
         packets, taken, max_heard, max_wanted);
  report.note(fmt::format("{} packets, {} of them messages", packets, taken));
  report.add("osc_packets_fuzzed", sound_packets);
  report.add("osc_packets_fuzzed_unchecked", unchecked);
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
  options.area = glm::dvec4(-50, 30, 50, 70), options.cell_m = 20.0;
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
      std::ranges::fill(left, 0.0f), std::ranges::fill(right, 0.0f);
      listening.hear(emitters, ears, 3.0, left, right);
      // What a listener gets is the file.
      const std::string wave = sound::encode_wave(std::array{left, right}, sound::Output::microphone);
      const std::size_t header = wave.size() - 4 * left.size();
      for (std::size_t k = 0; k < left.size(); ++k) {
        std::int16_t sample = 0;
        std::memcpy(&sample, wave.data() + header + 4 * k, sizeof sample);
        left[k] = float(sample) / 32767.0f;
      }
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
  const Octaves air = propagation::absorption_db_per_m({});
  const auto of_map = [&](glm::dvec3 place) {
    const auto sequences = listening.site().sequences_seen_from(place, options.paths);
    Octaves levels =
        listening.site().transfer(car.position, place, sequences, options.paths, air).homogeneous_db;
    for (std::size_t band = 0; band < octaves; ++band) levels[band] += car.power_db[band];
    return levels;
  };
  const auto largest_step_db = [](const auto& levels_at) {
    double step_db = 0.0, before_db = 0.0;
    for (double x = -60.0; x < 60.0; x += 1.4 / 60.0) {
      const double now_db = propagation::a_weighted(levels_at(glm::dvec3(x, 27.0, 1.7)));
      if (x > -60.0) step_db = std::max(step_db, std::abs(now_db - before_db));
      before_db = now_db;
    }
    return step_db;
  };
  report.add("shadow_edge_step_db",
             largest_step_db([&](glm::dvec3 place) { return listening.level_at(car, place); }));
  report.add("shadow_edge_step_db_of_the_map", largest_step_db(of_map));
}

}  // namespace

void measure_sound(const BenchSetup& setup, Report& report) {
  measure_mix(setup, report);
  measure_beds(report);
  measure_server(report);
  measure_listening(report);
}

}  // namespace parvis::bench
