// Band noise, kinds of sounds, the mixer and what is heard in a scene.
#include <gtest/gtest.h>

#include <chrono>
#include <complex>
#include <map>
#include <numbers>
#include <numeric>
#include <thread>

#include "base/files.h"
#include "base/test_folder.h"
#include "capture/trees/scene_tree.h"
#include "life/propagation/noise_source.h"
#include "life/sound/listening.h"
#include "life/sound/openal_module.h"
#include "life/sound/playback.h"
#include "life/sound/sound_server.h"
#include "life/sound/wave_file.h"
#include "life/tram/tram_process.h"
#include "room_list.h"
#include "scene/script/test_script.h"

namespace parvis::sound {
namespace {

double mean_square(std::span<const float> samples) {
  double sum = 0.0;
  for (const float sample : samples) sum += double(sample) * double(sample);
  return sum / double(samples.size());
}

Octaves only(std::size_t band, double value) {
  Octaves result{};
  result[band] = value;
  return result;
}

TEST(BandNoise, EachBandHasUnitEnergyAndNoOther) {
  for (std::size_t band = 0; band < octaves; ++band) {
    std::vector<float> samples(BandNoise::length, 0.0f);
    BandNoise::instance().add(samples, 1234.0, 1.0, only(band, 1.0), only(band, 1.0));
    EXPECT_NEAR(mean_square(samples), 1.0, 0.01) << band;
    for (std::size_t other = 0; other < octaves; ++other)
      EXPECT_NEAR(band_energy(samples, other), other == band ? 1.0 : 0.0, 0.01) << band << " " << other;
  }
}

TEST(Sounds, AreBoundedAndFollowFromTheTimeAlone) {
  Octaves one;
  one.fill(1.0);
  const double cut_s = 3.0 + 24'064.0 / sample_rate;  // envelopes of noise have steps of 128 samples
  for (std::size_t kind = 0; kind < synthetic_kinds; ++kind) {
    std::vector<float> samples(48'000, 0.0f), halves(48'000, 0.0f);
    add_sound(SoundKind(kind), 5, 3.0, 4.0, one, one, samples);
    add_sound(SoundKind(kind), 5, 3.0, cut_s, one, one, std::span(halves).first(24'064));
    add_sound(SoundKind(kind), 5, cut_s, 4.0, one, one, std::span(halves).last(23'936));
    double apart = 0.0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      ASSERT_TRUE(std::isfinite(samples[i])) << sound_names[kind];
      ASSERT_LT(std::abs(samples[i]), 30.0f) << sound_names[kind];
      apart = std::max(apart, double(std::abs(samples[i] - halves[i])));
    }
    EXPECT_LT(apart, 0.5) << sound_names[kind];
  }
}

TEST(Mixer, KeepsTheEnergyOfManySourcesAtAMicrophone) {
  std::vector<HeardSound> sounds(5000);
  for (std::size_t i = 0; i < sounds.size(); ++i) {
    const float angle = float(i) * 2.4f;
    sounds[i].id = i, sounds[i].kind = SoundKind::car;
    sounds[i].direction = {std::sin(angle), std::cos(angle), 0.0f};
    sounds[i].energy.fill(1e-6);
  }
  Mixer mixer(Output::microphone);
  std::vector<float> left(BandNoise::length, 0.0f), right(left);
  mixer.mix(sounds, std::span(left).first(480), std::span(right).first(480));  // faded in
  std::ranges::fill(left, 0.0f), std::ranges::fill(right, 0.0f);
  mixer.mix(sounds, left, right);
  EXPECT_EQ(mixer.counts().clusters, 1u);
  for (std::size_t band = 0; band < octaves; ++band)
    EXPECT_NEAR(propagation::level(band_energy(left, band) / 5e-3), 0.0, 0.1) << band;
  EXPECT_EQ(left, right);
}

TEST(Sounds, TonesAreWhereTheirKindsHaveThem) {
  Octaves one;
  one.fill(1.0);
  for (const auto& [kind, low, high] : {std::tuple(SoundKind::tram_bell, 1000.0, 4000.0),
                                        std::tuple(SoundKind::tram_squeal, 1600.0, 8500.0)}) {
    std::vector<float> samples(48'000, 0.0f);
    add_sound(kind, 5, 3.0, 4.0, one, one, samples);
    double loudest_hz = 0.0, loudest = 0.0;
    for (double hz = 200.0; hz < 9000.0; hz += 5.0) {
      std::complex<double> sum = 0.0;
      for (std::size_t i = 0; i < samples.size(); ++i)
        sum += double(samples[i]) * std::polar(1.0, -2.0 * std::numbers::pi * hz * double(i) / sample_rate);
      if (std::abs(sum) > loudest) loudest = std::abs(sum), loudest_hz = hz;
    }
    EXPECT_GT(loudest_hz, low) << sound_names[std::size_t(kind)];
    EXPECT_LT(loudest_hz, high) << sound_names[std::size_t(kind)];
  }
}

TEST(Sounds, FeetAreLouderOnGravelAndSofterOnALawn) {
  const auto loud = [](double factor) { return propagation::a_weighted(footsteps_db(factor)); };
  EXPECT_GT(loud(propagation::gravel_factor), loud(0.0) + 3.0);
  EXPECT_LT(loud(1.0), loud(0.0) - 10.0);
}

TEST(Mixer, TenThousandSoundsInOnePointAndNoneAreMixed) {
  std::vector<HeardSound> sounds(10'000);
  for (std::size_t i = 0; i < sounds.size(); ++i)
    sounds[i].id = i, sounds[i].kind = SoundKind::murmur, sounds[i].energy.fill(1e-6);
  for (const Output output : {Output::headphones, Output::stereo, Output::microphone}) {
    Mixer mixer(output);
    std::vector<float> left(960, 0.0f), right(left);
    mixer.mix(sounds, left, right);
    mixer.mix({}, left, right);
    sounds[7].energy.fill(std::numeric_limits<double>::quiet_NaN());
    mixer.mix(std::span(sounds).first(8), left, right);
    for (const float sample : left) ASSERT_TRUE(std::isfinite(sample));
  }
}

TEST(Mixer, TheLoudestStayWhereFewerCanBeMixed) {
  std::vector<HeardSound> sounds;
  for (const double energy : {3.0, 1.0, 4.0, 1.0, 5.0, 1.0}) {
    HeardSound sound;
    sound.id = sounds.size(), sound.energy.fill(energy);
    sounds.push_back(sound);
  }
  const auto kept = [&](std::size_t count) {
    std::vector<HeardSound> some = sounds;
    keep_loudest(some, count);
    std::vector<std::uint64_t> ids;
    for (const HeardSound& sound : some) ids.push_back(sound.id);
    return ids;
  };
  using Ids = std::vector<std::uint64_t>;
  EXPECT_EQ(kept(3), (Ids{0, 2, 4}));
  EXPECT_EQ(kept(4), (Ids{0, 1, 2, 4})) << "of equally loud ones the first";
  EXPECT_EQ(kept(0), Ids{});
  EXPECT_EQ(kept(9), (Ids{0, 1, 2, 3, 4, 5}));
}

TEST(Mixer, HearsTheLeftOnTheLeft) {
  HeardSound sound;
  sound.kind = SoundKind::fountain;
  sound.direction = {-1, 0, 0};
  sound.energy.fill(1e-4);
  for (const Output output : {Output::headphones, Output::stereo}) {
    Mixer mixer(output);
    std::vector<float> left(9600, 0.0f), right(left);
    mixer.mix({&sound, 1}, left, right);
    EXPECT_GT(mean_square(left), 2.0 * mean_square(right));
  }
}

TEST(Loudspeakers, TheNearestSoundAndTheEnergyStays) {
  for (const Output output : {Output::surround_4, Output::surround_5, Output::surround_7}) {
    const std::span<const Channel> channels = channels_of(output);
    const std::vector<float> signal(64, 1.0f);
    for (int degrees = 0; degrees < 360; degrees += 5) {
      const float angle = float(degrees) * 0.0174533f;
      const Stream stream{
          {std::sin(angle), std::cos(angle), 0}, {std::sin(angle), std::cos(angle), 0}, signal, true};
      std::vector<std::vector<float>> buffers(channels.size(), std::vector<float>(64, 0.0f));
      Spatialiser(output, 1).add({&stream, 1}, std::vector<std::span<float>>(buffers.begin(), buffers.end()));
      double energy = 0.0;
      std::size_t loudest = 0;
      for (std::size_t c = 0; c < channels.size(); ++c) {
        energy += mean_square(buffers[c]);
        if (buffers[c][0] > buffers[loudest][0]) loudest = c;
        EXPECT_TRUE(channels[c].azimuth_deg || buffers[c][0] == 0.0f) << channels[c].name;
      }
      EXPECT_NEAR(energy, 1.0, 1e-4) << degrees;
      const float apart = std::remainder(*channels[loudest].azimuth_deg - float(degrees), 360.0f);
      EXPECT_LT(std::abs(apart), 71.0f) << degrees << " " << channels[loudest].name;
    }
  }
}

TEST(Mixer, ASourceThatCirclesTheHeadMakesNoClick) {
  Mixer mixer(Output::headphones);
  HeardSound sound;
  sound.kind = SoundKind::fountain;
  sound.energy = only(1, 1e-2);  // 125 Hz: steps between samples are small unless it clicks
  std::vector<float> left, right;
  for (int i = 0; i < 200; ++i) {
    const float angle = 0.05f * float(i);
    sound.direction = {std::sin(angle), std::cos(angle), 0.0f};
    std::vector<float> l(960, 0.0f), r(l);
    mixer.mix({&sound, 1}, l, r);
    left.insert(left.end(), l.begin(), l.end());
  }
  double step = 0.0;
  for (std::size_t i = 1; i < left.size(); ++i)
    step = std::max(step, double(std::abs(left[i] - left[i - 1])));
  EXPECT_LT(step, 0.02) << "of an amplitude of about 0.3";
}

TEST(Wave, HasItsHeaderAndClips) {
  const std::array<std::vector<float>, 2> both{std::vector{0.0f, 2.0f}, std::vector{-1.0f, 0.5f}};
  std::size_t clipped = 0;
  const std::string bytes = encode_wave(both, Output::stereo, &clipped);
  EXPECT_EQ(bytes.size(), 44u + 8u);
  EXPECT_EQ(bytes.substr(0, 4), "RIFF");
  EXPECT_EQ(clipped, 1u);
  const std::vector<std::vector<float>> eight(8, std::vector<float>(10, 0.1f));
  const std::string named = encode_wave(eight, Output::surround_7);
  EXPECT_EQ(named.size(), 68u + 160u);
  EXPECT_EQ(named.substr(40, 4), std::string("\x3f\x06\0\0", 4)) << "the mask of 7.1 with sides and backs";
}

TEST(Listening, HearsWhatTheTransferSays) {
  scene::Scene scene;
  Listening listening(scene, Output::microphone);
  Emitter fountain{1, SoundKind::fountain, {10, 0, 1}, power_db(SoundKind::fountain, 0.0)};
  Camera ears;
  ears.world_from_camera[3] = {0, 0, 1.7f, 1};
  std::vector<float> left(BandNoise::length, 0.0f), right(left);
  listening.hear({&fountain, 1}, ears, 1.0, std::span(left).first(480), std::span(right).first(480));
  std::ranges::fill(left, 0.0f);
  listening.hear({&fountain, 1}, ears, 3.0, left, right);
  const Octaves expected = listening.level_at(fountain, {0, 0, 1.7});
  for (std::size_t band = 0; band < octaves; ++band)
    EXPECT_NEAR(propagation::level(band_energy(left, band)) + full_scale_db, expected[band], 0.1) << band;
}

/// A box with all its faces.
scene::Object box(glm::vec3 low, glm::vec3 high) {
  scene::Model model;
  model.materials.emplace_back();
  model.nodes.emplace_back();
  scene::Part part;
  part.material = 0, part.node = 0;
  for (int i = 0; i < 8; ++i)
    part.mesh.positions.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
  part.mesh.indices = {0, 1, 5, 0, 5, 4, 3, 2, 6, 3, 6, 7, 2, 0, 4, 2, 4, 6,
                       1, 3, 7, 1, 7, 5, 4, 5, 7, 4, 7, 6, 0, 2, 3, 0, 3, 1};
  part.mesh.normals.assign(8, {0, 0, 1});
  part.mesh.uvs.assign(8, {0, 0});
  model.parts.push_back(std::move(part));
  scene::Object object;
  object.name = "box", object.model = std::make_shared<const scene::Model>(std::move(model));
  return object;
}

TEST(Listening, AWallReflectsFromItsOwnSideAndLater) {
  scene::Scene scene;
  scene.objects = {box({20, -30, 0}, {30, 30, 15})};
  Listening listening(scene, Output::headphones);
  PlacedSound bell;
  bell.kind = SoundKind::bell, bell.position = {-10, 0, 2};
  scene.data<scene::ItemsOf<PlacedSound>>().add(bell, 0);
  Camera ears;  // looks down: right is east
  ears.world_from_camera[3] = {0, 0, 2, 1};
  const std::vector<HeardSound> heard = listening.heard(scene, ears, 5.0, 0.02);
  ASSERT_EQ(heard.size(), 2u) << "bells have no late field";
  const HeardSound& echo = heard[0].direction.x > 0.0f ? heard[0] : heard[1];
  const HeardSound& direct = heard[0].direction.x > 0.0f ? heard[1] : heard[0];
  EXPECT_NEAR(echo.direction.x, 1.0f, 1e-3f);
  EXPECT_NEAR(direct.direction.x, -1.0f, 1e-3f);
  EXPECT_NEAR(direct.emitted_s, 5.0 - 10.0 / 340.0, 1e-6);
  EXPECT_NEAR(echo.emitted_s, 5.0 - 50.0 / 340.0, 1e-6);
  EXPECT_LT(echo.energy[4], direct.energy[4]);
  EXPECT_EQ(echo.seed, direct.seed) << "the same strikes";
  EXPECT_NE(echo.id, direct.id);
}

TEST(Listening, HearsTheStreetFromAnArcade) {
  scene::Scene open, closed;
  open.objects = {box({-40, 0, 3.5f}, {40, 4, 12}), box({-40, 4, 0}, {40, 12, 12})};
  closed.objects = {box({-40, 0, 0}, {40, 12, 12})};
  for (scene::Scene* scene : {&open, &closed}) scene->objects.push_back(box({-60, -40, -1}, {60, 40, 0}));
  Listening in_arcade(open, Output::microphone), in_house(closed, Output::microphone);
  const propagation::Terrain& terrain = in_arcade.site().terrain();
  EXPECT_NEAR(terrain.ceiling_z({0.5, 2.5}).value_or(0.0), 3.5, 1e-3);
  EXPECT_FALSE(terrain.ceiling_z({0.5, 8.5})) << "in the house";
  EXPECT_FALSE(in_house.site().terrain().ceiling_z({0.5, 2.5}));
  EXPECT_TRUE(std::ranges::any_of(in_arcade.site().walls(),
                                  [](const propagation::Wall& wall) { return wall.bottom > 3.0; }));
  const Emitter car{1, SoundKind::car, {3, -10, 0.3}, power_db(SoundKind::car, 10.0)};
  const double arcade_db = propagation::a_weighted(in_arcade.level_at(car, {0, 2, 1.7})),
               before_db = propagation::a_weighted(in_arcade.level_at(car, {0, -1, 1.7})),
               house_db = propagation::a_weighted(in_house.level_at(car, {0, 2, 1.7}));
  EXPECT_NEAR(arcade_db, before_db, 4.0);
  EXPECT_GT(arcade_db, house_db + 15.0);
}

/// A WAVE file of the room's own.
std::string tone_file(std::size_t samples, float amplitude) {
  std::array<std::vector<float>, 2> both;
  for (std::size_t i = 0; i < samples; ++i)
    for (std::vector<float>& channel : both)
      channel.push_back(amplitude *
                        float(std::sin(2.0 * std::numbers::pi * 1000.0 * double(i) / sample_rate)));
  return encode_wave(both, Output::stereo);
}

TEST(Recordings, AreAsLoudAsAskedForInTheirOctave) {
  const TestFolder folder;
  ASSERT_TRUE(write_file(folder.path() / "tone.wav", tone_file(96'000, 0.1f)));
  const Result<Recording> tone = read_recording(folder.path() / "tone.wav");
  ASSERT_TRUE(tone) << to_string(tone.errors());
  EXPECT_NEAR(tone->loudness_lufs, -23.0, 0.2) << "a tone of -20 dBFS, of which the mean square is 3 dB less";
  Octaves flat;
  flat.fill(1.0);
  std::vector<float> samples(48'000, 0.0f), again(samples);
  tone->add(0.2, 1.2, flat, flat, samples);
  EXPECT_NEAR(propagation::level(mean_square(samples) / double(octaves)), 0.0, 0.2);
  tone->add(0.2, 0.7, flat, flat, std::span(again).first(24'000));
  tone->add(0.7, 1.2, flat, flat, std::span(again).last(24'000));
  for (std::size_t i = 0; i < samples.size(); ++i) ASSERT_NEAR(samples[i], again[i], 0.02f) << i;
  Octaves without = flat;
  without[4] = 0.0;
  std::vector<float> rest(48'000, 0.0f);
  tone->add(0.2, 1.2, without, without, rest);
  EXPECT_LT(mean_square(rest), 0.5 * mean_square(samples)) << "the tone's own octave is taken away";
}

TEST(Recordings, BadFilesAreErrorsThatNameThem) {
  const TestFolder folder;
  const auto errors = [&](const char* name, const std::string& bytes) {
    const std::filesystem::path file = folder.path() / name;
    EXPECT_TRUE(write_file(file, bytes));
    const Result<Recording> read = read_recording(file);
    EXPECT_FALSE(read) << name;
    return read ? std::string() : to_string(read.errors());
  };
  EXPECT_NE(errors("empty.wav", "").find("empty.wav"), std::string::npos);
  EXPECT_NE(errors("text.ogg", "no sound at all").find("expected WAVE"), std::string::npos);
  EXPECT_NE(errors("silent.wav", tone_file(48'000, 0.0f)).find("silent"), std::string::npos);
  EXPECT_NE(errors("cut.wav", tone_file(48'000, 0.5f).substr(0, 60)).find("copy it again"),
            std::string::npos);
  EXPECT_NE(
      errors("large.wav", tone_file(16, 0.5f) + std::string(max_recording_bytes, '\0')).find("large.wav"),
      std::string::npos);
  std::string numbers = tone_file(4800, 0.5f);
  numbers[20] = 3, numbers[34] = 32;  // floats, of which there are half as many
  numbers[32] = 8;
  const float nothing = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(numbers.data() + 44 + 800, &nothing, sizeof nothing);
  EXPECT_NE(errors("nan.wav", numbers).find("is no number"), std::string::npos);
  EXPECT_FALSE(read_recording(folder.path() / "missing.wav"));
  // A file that ends early is heard as far as it goes.
  ASSERT_TRUE(write_file(folder.path() / "half.wav", tone_file(96'000, 0.5f).substr(0, 200'000)));
  EXPECT_TRUE(read_recording(folder.path() / "half.wav"));
}

TEST(Beds, AreTheirSamplesTimesTheGain) {
  Recording recording;
  for (int i = 0; i < 1000; ++i) recording.left.push_back(float(i)), recording.right.push_back(float(-i));
  const Bed bed{std::make_shared<const Recording>(recording), 0.25f};
  std::vector<float> left(1500, 0.0f), right(left);
  const std::array buffers{std::span(left), std::span(right)};
  bed.add(1500.0 / sample_rate, buffers);
  for (std::size_t i = 0; i < left.size(); ++i) {
    EXPECT_EQ(left[i], 0.25f * float(i % 1000));
    EXPECT_EQ(right[i], -left[i]);
  }
}

/// A device that goes away after some moments.
class FleetingDevice final : public Device {
 public:
  explicit FleetingDevice(int moments) : left_(moments) {}
  Status play(std::span<const Stream> streams, const std::array<std::span<const float>, 2>&) override {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    for (const Stream& stream : streams)
      for (const float sample : stream.signal) EXPECT_TRUE(std::isfinite(sample));
    return left_-- > 0 ? Status(Ok{}) : error("the device is unplugged");
  }

 private:
  int left_;
};

/// Waits for what a playback says.
std::string next_message(Playback& playback) {
  std::string message;
  for (int i = 0; i < 2000 && message.empty(); ++i) {
    message = playback.take_message();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return message;
}

TEST(Playback, ADeviceThatGoesAwayIsAMessageAndIsOpenedAgain) {
  int opened = 0;
  Playback playback(
      [&opened](std::size_t) -> Result<std::unique_ptr<Device>> {
        if (++opened == 2) return error("none is there");
        return std::unique_ptr<Device>(std::make_unique<FleetingDevice>(opened == 1 ? 5 : 1'000'000));
      },
      0.0, 0.05);
  EXPECT_NE(next_message(playback).find("unplugged"), std::string::npos);
  EXPECT_NE(next_message(playback).find("back"), std::string::npos);
  EXPECT_EQ(opened, 3);
  HeardSound sound;
  sound.kind = SoundKind::bell, sound.energy.fill(1e-4);
  for (int i = 0; i < 5; ++i) {
    playback.update({sound}, {}, 0.1 * i);
    playback.mute(i % 2 == 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  for (int i = 0; i < 2000 && playback.cost().voices == 0; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_EQ(playback.cost().voices, 1u);
  EXPECT_GT(playback.cost().core_fraction, 0.0);
  playback.update({}, {}, 1.0);
  EXPECT_GT(playback.moments(), 5u);
}

/// A device that keeps what comes to its left channel by itself.
class KeepingDevice final : public Device {
 public:
  explicit KeepingDevice(std::vector<float>& kept) : kept_(kept) {}
  Status play(std::span<const Stream>, const std::array<std::span<const float>, 2>& channels) override {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    kept_.insert(kept_.end(), channels[0].begin(), channels[0].end());
    return Ok{};
  }

 private:
  std::vector<float>& kept_;
};

TEST(Playback, BedsBeginAndEndWithoutAClick) {
  Recording recording;
  recording.left.assign(4800, 0.5f), recording.right = recording.left;
  const Bed bed{std::make_shared<const Recording>(recording), 1.0f};
  std::vector<float> heard;
  {
    Playback playback(
        [&heard](std::size_t) -> Result<std::unique_ptr<Device>> {
          return std::unique_ptr<Device>(std::make_unique<KeepingDevice>(heard));
        },
        0.0);
    const auto play_some = [&] {
      const std::size_t until = playback.moments() + 4;
      for (int i = 0; i < 2000 && playback.moments() < until; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    };
    play_some();
    playback.update({}, {bed}, 0.1);
    play_some();
    playback.update({}, {}, 0.2);
    play_some();
  }
  float largest_step = 0.0f;
  for (std::size_t i = 1; i < heard.size(); ++i)
    largest_step = std::max(largest_step, std::abs(heard[i] - heard[i - 1]));
  EXPECT_EQ(*std::ranges::max_element(heard), 0.5f);
  EXPECT_EQ(heard.back(), 0.0f);
  EXPECT_LT(largest_step, 0.01f);
}

TEST(Devices, FilesHoldWhatWasPlayedAndTheNullDeviceTakesTime) {
  const TestFolder folder;
  const std::string file = (folder.path() / "played.wav").string();
  std::vector<float> signal(device_moment);
  for (std::size_t i = 0; i < signal.size(); ++i) signal[i] = i % 12 < 6 ? 0.1f : -0.1f;  // 4 kHz
  const std::vector<float> none(device_moment, 0.0f);
  const Stream stream{{-1, 0, 0}, {-1, 0, 0}, signal, true};
  for (const std::string& name : {std::string("null"), file}) {
    Result<std::unique_ptr<Device>> device = open_device(name, 1);
    ASSERT_TRUE(device) << name;
    for (int i = 0; i < 10; ++i) ASSERT_TRUE((*device)->play({&stream, 1}, {none, none}));
  }
  EXPECT_EQ(std::filesystem::file_size(file), 44u + 4u * 10u * device_moment);
  const Result<Recording> played = read_recording(file);
  ASSERT_TRUE(played) << to_string(played.errors());
  EXPECT_GT(mean_square(played->left), 2.0 * mean_square(played->right));
  EXPECT_FALSE(open_device("/proc/none/played.wav", 1));
  {
    const Result<std::unique_ptr<Device>> room = open_device(file + "@5.1", 1);
    ASSERT_TRUE(room);
    ASSERT_TRUE((*room)->play({&stream, 1}, {none, none}));
  }
  EXPECT_EQ(std::filesystem::file_size(file), 68u + 12u * device_moment) << "six channels, with their names";
}

TEST(Devices, OpenAlHearsTheLeftOnTheLeft) {
  const std::vector<float> loop(4800, 0.1f);
  const Result<std::unique_ptr<Loopback>> ears = openal.call(&OpenAlFunctions::open_loopback, 4u, loop);
  ASSERT_TRUE(ears) << to_string(ears.errors());
  HeardSound sound;
  sound.kind = SoundKind::fountain, sound.direction = {-1, 0, 0};
  sound.energy.fill(1e-4);
  Mixer mixer(Output::headphones, {.clusters = 4});
  double left_energy = 0.0, right_energy = 0.0;
  for (int i = 0; i < 20; ++i) {
    std::vector<float> left(device_moment), right(left);
    (*ears)->render(mixer.premix({&sound, 1}, device_moment), left, right);
    left_energy += mean_square(left), right_energy += mean_square(right);
  }
  EXPECT_GT(left_energy, 2.0 * right_energy);
  EXPECT_GT(right_energy, 0.0);
}

TEST(Server, PlaysSoundsUntilTheClientIsGone) {
  ServedSounds served;
  HeardSound bell;
  bell.id = 7, bell.kind = SoundKind::bell, bell.direction = {0.6f, 0.8f, 0}, bell.emitted_s = 4.5;
  bell.energy.fill(1e-3);
  const Result<std::string> packet = liblo.call(&LibloFunctions::encode, message_of(bell, 5.0));
  ASSERT_TRUE(packet) << to_string(packet.errors());
  ASSERT_TRUE(served.take(*packet, 20.0));
  const std::vector<HeardSound> heard = served.heard(21.0);
  ASSERT_EQ(heard.size(), 1u);
  EXPECT_EQ(heard[0].kind, SoundKind::bell);
  EXPECT_NEAR(heard[0].direction.x, 0.6f, 1e-5f);
  EXPECT_NEAR(heard[0].energy[3], 1e-3, 1e-6);
  EXPECT_NEAR(heard[0].emitted_s, 20.5, 1e-6) << "half a second before it is heard";
  EXPECT_TRUE(served.heard(25.0).empty()) << "the client has vanished";
  ASSERT_TRUE(served.take(*packet, 26.0));
  EXPECT_EQ(served.heard(26.0).size(), 1u) << "and is back";
  const std::string types_cut = packet->substr(0, 16);
  for (const std::string& bad : {std::string(), std::string("/parvis/sound\0\0\0", 16), types_cut,
                                 std::string("#bundle\0", 8), std::string(4096, '/'), packet->substr(0, 60)})
    EXPECT_FALSE(served.take(bad, 26.0));
  EXPECT_FALSE(
      served.take(*liblo.call(&LibloFunctions::encode, OscMessage{"/parvis/sound", {1, 2}, {"", ""}}), 26.0));
  const Result<std::string> pong =
      served.take(*liblo.call(&LibloFunctions::encode, OscMessage{"/parvis/ping", {}, {}}), 26.0);
  ASSERT_TRUE(pong);
  EXPECT_TRUE(pong->starts_with("/parvis/pong"));
}

TEST(Server, SizesBeyondTheWholeNumbersOfFloatsArriveUnchanged) {
  const std::string large((std::size_t(1) << 24) + 1, 'x');
  const std::size_t last = large.size() / part_bytes;
  const Result<std::string> packet =
      liblo.call(&LibloFunctions::encode, part_of(name_of_recording(large), large, last));
  ASSERT_TRUE(packet) << to_string(packet.errors());
  const Result<OscMessage> read = liblo.call(&LibloFunctions::decode, *packet);
  ASSERT_TRUE(read) << to_string(read.errors());
  EXPECT_EQ(read->numbers[1], double(last));
  EXPECT_EQ(read->numbers[2], double(large.size()));
  EXPECT_EQ(read->blob.size(), 1u);
}

/// Encoded, taken by the server.
Result<std::string> given_to(ServedSounds& served, const OscMessage& message, double now_s) {
  return served.take(*liblo.call(&LibloFunctions::encode, message), now_s);
}

TEST(Server, AsksForRecordingsThatItLacksAndPlaysThem) {
  const std::string file = tone_file(24'000, 0.3f), name = name_of_recording(file);
  HeardSound sound;
  sound.id = 3, sound.kind = SoundKind::recording, sound.energy.fill(1e-3);
  ServedSounds served;
  const auto say = [&](double now_s) {
    ASSERT_TRUE(given_to(served, message_of(sound, 0.0, name), now_s));
    ASSERT_TRUE(given_to(served, {"/parvis/bed", {0.0, 0.5}, {name, ""}}, now_s));
  };
  double now_s = 0.0;
  int lost = 0;
  EXPECT_FALSE(given_to(served, part_of(name, file, 0), now_s)) << "nobody asked";
  for (int round = 0; round < 200 && served.heard(now_s).empty(); ++round, now_s += 0.05) {
    say(now_s);
    for (const std::string& packet : served.recordings().wanted(now_s)) {
      const Result<OscMessage> want = liblo.call(&LibloFunctions::decode, packet);
      ASSERT_TRUE(want && want->address == "/parvis/want" && want->texts[0] == name);
      for (std::size_t i = std::size_t(want->numbers[1]);
           i < std::size_t(want->numbers[1] + want->numbers[2]) && i * part_bytes < file.size(); ++i)
        if (++lost % 7 != 0) {
          ASSERT_TRUE(given_to(served, part_of(name, file, i), now_s));
        }
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ASSERT_EQ(served.heard(now_s).size(), 1u) << "each seventh part was lost, and asked for again";
  ASSERT_EQ(served.beds(now_s).size(), 1u);
  EXPECT_EQ(served.beds(now_s)[0].gain, 0.5f);
  EXPECT_NEAR(served.heard(now_s)[0].recording->length_s(), 0.45, 0.06);
  EXPECT_TRUE(served.recordings().wanted(now_s).empty());
  EXPECT_TRUE(served.beds(now_s + 3.0).empty()) << "the client has vanished";

  // A part that claims another size holds nothing up: all are asked for again.
  const std::string whole(3000, 'y'), other = name_of_recording(whole);
  ASSERT_TRUE(given_to(served, {"/parvis/bed", {0.0, 0.5}, {other, ""}}, now_s));
  EXPECT_TRUE(served.beds(now_s).size() <= 1u);
  EXPECT_TRUE(given_to(served, part_of(other, whole + std::string(2000, 'y'), 0), now_s));
  EXPECT_FALSE(given_to(served, part_of(other, whole, 0), now_s));
  for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(given_to(served, part_of(other, whole, i), now_s));
  EXPECT_TRUE(served.recordings().wanted(now_s).empty()) << "it has come whole";

  // What is no sound, or does not fit, is refused and said.
  const std::string text(3000, 'x'), bad = name_of_recording(text);
  ASSERT_TRUE(given_to(served, {"/parvis/bed", {0.0, 0.5}, {bad, ""}}, now_s));
  EXPECT_TRUE(served.beds(now_s).size() <= 1u);
  EXPECT_FALSE(given_to(served, part_of(bad, text.substr(0, 100), 5), now_s));
  for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(given_to(served, part_of(bad, text, i), now_s));
  std::string message;
  for (int i = 0; i < 500 && message.empty(); ++i) {
    ASSERT_TRUE(given_to(served, {"/parvis/bed", {0.0, 0.5}, {bad, ""}}, now_s));
    served.beds(now_s), message = served.recordings().take_message();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_NE(message.find("expected WAVE"), std::string::npos) << message;
  EXPECT_TRUE(served.recordings().wanted(now_s).empty()) << "it is not asked for again";
  EXPECT_FALSE(given_to(served, message_of(sound, 0.0), now_s)) << "a recording without a file";
}

TEST(Server, PacketsGoBothWaysOverLoopback) {
  Result<Datagrams> server = Datagrams::listen(0, false);
  ASSERT_TRUE(server) << to_string(server.errors());
  Result<Datagrams> client = Datagrams::connect(fmt::format("127.0.0.1:{}", server->port()));
  ASSERT_TRUE(client) << to_string(client.errors());
  client->send("hello");
  EXPECT_EQ(server->receive(2000), "hello");
  server->send("hello yourself");
  EXPECT_EQ(client->receive(2000), "hello yourself");
  Result<Datagrams> stranger = Datagrams::connect(fmt::format("127.0.0.1:{}", client->port()));
  ASSERT_TRUE(stranger);
  stranger->send("to me");
  EXPECT_EQ(client->receive(50), "");
  client->send("hello again");
  EXPECT_EQ(server->receive(2000), "hello again") << "the stranger has not taken the client over";
  EXPECT_FALSE(Datagrams::connect("nowhere"));
}

/// Level ground.
class Plain final : public propagation::Terrain {
 public:
  double ground_z(glm::dvec2) const override { return 0.0; }
  double ground_factor(glm::dvec2) const override { return 0.0; }
  std::optional<double> roof_z(glm::dvec2) const override { return std::nullopt; }
  void add_breaks(glm::dvec2, glm::dvec2, std::vector<double>&) const override {}
};

TEST(LateField, OfASquareIsLouderAndLongerThanNothingAndThanAWiderOne) {
  const Plain plain;
  const auto court = [&](double half_m, double top_m) {
    Octaves absorption;
    absorption.fill(propagation::facade_absorption);
    const glm::dvec2 corners[]{{-half_m, -half_m}, {half_m, -half_m}, {half_m, half_m}, {-half_m, half_m}};
    std::vector<propagation::Wall> walls;
    for (int i = 0; i < 4; ++i) walls.push_back({corners[i], corners[(i + 1) % 4], top_m, top_m, absorption});
    return propagation::Site(plain, walls);
  };
  const Octaves air = propagation::absorption_db_per_m({});
  const glm::dvec3 middle(1, 2, 1.7);
  const Enclosure small = enclosure_about(court(10, 15), middle, 1, air),
                  large = enclosure_about(court(40, 15), middle, 1, air),
                  none = enclosure_about(propagation::Site(plain, {}), middle, 1, air);
  EXPECT_NEAR(small.reach_m, 11.3, 2.0);
  EXPECT_GT(small.energy[4], 4.0 * large.energy[4]);
  const Enclosure twice = enclosure_about(court(20, 30), 2.0 * middle, 1, Octaves{}),
                  once = enclosure_about(court(10, 15), middle, 1, Octaves{});
  EXPECT_NEAR(twice.decay_s[4] / once.decay_s[4], 2.0, 0.05) << "a place twice as large, without air";
  EXPECT_GT(small.energy[4], small.energy[7]) << "air takes high octaves";
  EXPECT_LT(propagation::level(small.energy[4]), propagation::level(1.0 / (4.0 * std::numbers::pi)))
      << "less than the source itself at 1 m";
  EXPECT_EQ(none.energy[4], 0.0);
  LateField field;
  Octaves one;
  one.fill(1.0);
  for (int i = 0; i < 200; ++i) field.advance(small, one, 0.02);
  const double loud = field.advance(small, one, 0.02)[4];
  EXPECT_NEAR(loud / small.energy[4], 1.0, 1e-3);
  EXPECT_NEAR(field.advance(small, {}, small.decay_s[4])[4] / loud, std::exp(-1.0), 1e-6);
}

/// An endless arcade 4 m deep before a house, as a terrain.
class Arcade final : public propagation::Terrain {
 public:
  double ground_z(glm::dvec2) const override { return 0.0; }
  double ground_factor(glm::dvec2) const override { return 0.0; }
  std::optional<double> roof_z(glm::dvec2 p) const override {
    return p.y >= 0.0 ? std::optional(12.0) : std::nullopt;
  }
  std::optional<double> ceiling_z(glm::dvec2 p) const override {
    return p.y >= 0.0 && p.y < 4.0 ? std::optional(height_m) : std::nullopt;
  }
  void add_breaks(glm::dvec2, glm::dvec2, std::vector<double>&) const override {}
  double height_m = 3.5;
};

TEST(LateField, OfAnArcadeIsThatBelowItsCeiling) {
  Octaves absorption;
  absorption.fill(propagation::facade_absorption);
  const std::vector<propagation::Wall> walls{{{-60, 0}, {60, 0}, 12, 12, absorption, 3.5},
                                             {{-60, 4}, {60, 4}, 12, 12, absorption}};
  Arcade low, high;
  high.height_m = 7.0;
  const propagation::Site narrow(low, walls), tall(high, walls);
  const Octaves air = propagation::absorption_db_per_m({});
  const Enclosure below = covered_about(narrow, {0, 2, 1.7}, 1, air);
  EXPECT_GT(below.energy[4], 2.0 * covered_about(tall, {0, 2, 1.7}, 1, air).energy[4]);
  EXPECT_GT(below.decay_s[4], 0.01);
  EXPECT_LT(below.decay_s[4], 0.2) << "one side is open";
  EXPECT_GT(below.reach_m, 2.0);
  EXPECT_EQ(covered_about(narrow, {0, -5, 1.7}, 1, air).energy[4], 0.0) << "under the sky";
  // Before it, rays that enter it do not rise through its ceiling: less comes back than from its back wall
  // under the sky.
  std::vector<propagation::Wall> street = walls;
  street.push_back({{-60, -12}, {60, -12}, 12, 12, absorption});
  const Plain plain;
  const propagation::Site before(low, street), without_ceiling(plain, street);
  EXPECT_LT(enclosure_about(before, {0, -5, 1.7}, 1, air).energy[4],
            enclosure_about(without_ceiling, {0, -5, 1.7}, 1, air).energy[4]);
}

class SoundNodeTest : public scene::ScriptTest<> {
 protected:
  SoundNodeTest()
      : ScriptTest([] {
          Registries registries;
          script::register_room(registries), sound::register_room(registries),
              tram::register_room(registries);
          return registries;
        }()) {}
};

TEST_F(SoundNodeTest, NodesBecomeEmitters) {
  const scene::Scene scene = scene_of(
      "group(position=\"5 0 0\") {\n  sound(kind=\"fountain\", position=\"1 2 0.5\", level_db=3)\n}\n"
      "sound(kind=\"bell\", on=0)\nsound(kind=\"car\", follows=\"nobody\")\n");
  const std::vector<Emitter> emitters = SceneSounds().at(scene, 0.02, glm::dvec3(0.0));
  ASSERT_EQ(emitters.size(), 1u);
  EXPECT_NEAR(emitters[0].position.x, 6.0, 1e-6);
  EXPECT_NEAR(emitters[0].power_db[4], power_db(SoundKind::fountain, 0.0)[4] + 3.0, 1e-9);
  EXPECT_TRUE(holds(errors_of("sound(kind=\"trumpet\")\n"), "scene.xp:1:"));
  EXPECT_TRUE(holds(errors_of("sound(kind=\"recording\")\n"), "needs a file="));
}

TEST_F(SoundNodeTest, ATramRingsItsDoorsMoveAndItSquealsInTightCurves) {
  auto loaded = load(
      "tram(name=\"t\", path=\"-130 0, 30 0, 30 120\", radius=22, headway_s=200) {\n"
      "  tramStop(position=\"-60 -3 0\", dwell_s=12)\n}\n");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  scene::Scene& scene = loaded->scene;
  tram::TramProcess process;
  action::SharedByProcesses shared;
  process.begin(scene, shared);
  SceneSounds sounds;
  std::map<SoundKind, std::pair<double, double>> heard_s;  // first and last
  std::map<SoundKind, glm::dvec3> first_at;
  const double step_s = action::step_s;
  for (double time_s = 0.0; time_s < 60.0; time_s += step_s) {
    process.step(scene);
    process.present(scene, 0.0);
    for (const Emitter& it : sounds.at(scene, step_s, glm::dvec3(0.0))) {
      const bool is_new = heard_s.try_emplace(it.kind, time_s, time_s).second;
      heard_s[it.kind].second = time_s;
      if (is_new) first_at[it.kind] = it.position;
    }
  }
  ASSERT_TRUE(heard_s.contains(SoundKind::tram_doors));
  ASSERT_TRUE(heard_s.contains(SoundKind::tram_bell));
  ASSERT_TRUE(heard_s.contains(SoundKind::tram_squeal));
  EXPECT_NEAR(heard_s[SoundKind::tram_doors].second - heard_s[SoundKind::tram_doors].first, 12.0, 1.0);
  EXPECT_NEAR(heard_s[SoundKind::tram_bell].first, heard_s[SoundKind::tram_doors].second, 2.0);
  EXPECT_NEAR(first_at[SoundKind::tram_squeal].x, 15.0, 25.0) << "where the curve begins";
  EXPECT_LT(heard_s[SoundKind::tram_squeal].second, 58.0) << "the end of the line is straight";
}

TEST_F(SoundNodeTest, PeopleTreesAndFountainsSoundByThemselves) {
  scene::Scene scene;
  const auto add = [&](const std::string& name, glm::vec3 place) {
    scene::Object object;
    object.name = name, object.model = std::make_shared<const scene::Model>();
    object.world_from_model[3] = glm::vec4(place, 1.0f);
    object.is_dynamic = name.starts_with("person");
    scene.objects.push_back(std::move(object));
  };
  add("fountain", {5, 0, 0}), add("fountain bench", {60, 0, 0});
  for (int i = 1; i <= 6; ++i) add("person " + std::to_string(i), {0, float(i % 2), 0});
  add("person 7", {500, 0, 0});
  trees::TreeLevels levels;
  levels.foot = glm::vec3(0.0f), levels.box.max = {2, 2, 8};
  for (const float x : {10.0f, 500.0f}) {
    trees::SceneTree tree;
    tree.tree = std::make_shared<const trees::TreeLevels>(levels);
    tree.world_from_tree[3].x = x;
    scene.data<trees::SceneTrees>().add(std::move(tree), 0);
  }
  scene.objects.back().is_visible = true;
  SceneSounds sounds;
  sounds.at(scene, 0.02, glm::dvec3(0.0));
  scene.objects[2].world_from_model[3].x += 0.03f;  // 1.5 m/s
  const std::vector<Emitter> emitters = sounds.at(scene, 0.02, glm::dvec3(0.0));
  const auto count = [&](SoundKind kind) { return std::ranges::count(emitters, kind, &Emitter::kind); };
  EXPECT_EQ(count(SoundKind::fountain), 1) << "a bench of that name has no water";
  EXPECT_EQ(count(SoundKind::footsteps), 1) << "one walks";
  EXPECT_GE(count(SoundKind::murmur), 1);
  EXPECT_LE(count(SoundKind::murmur), 6);
  ASSERT_EQ(count(SoundKind::leaves), 1) << "one tree is near";
  const auto leaves = std::ranges::find(emitters, SoundKind::leaves, &Emitter::kind);
  EXPECT_NEAR(leaves->position.x, 10.0, 1e-6);
  EXPECT_NEAR(leaves->position.z, 5.6, 1e-5) << "in its crown";

  // A fan beside the fountain sounds, too.
  propagation::NoiseSource fan;
  fan.line = {{8, 0, 3}}, fan.power_db.fill(60.0);
  scene.data<scene::ItemsOf<propagation::NoiseSource>>().add(fan, 0);
  const std::vector<Emitter> with_fan = SceneSounds().at(scene, 0.02, glm::dvec3(0.0));
  EXPECT_EQ(std::ranges::count(with_fan, SoundKind::fountain, &Emitter::kind), 2);
}

}  // namespace
}  // namespace parvis::sound
