// Band noise, kinds of sounds, the mixer and what is heard in a scene.
#include <gtest/gtest.h>

#include <chrono>
#include <numbers>
#include <numeric>
#include <thread>

#include "base/files.h"
#include "base/test_folder.h"
#include "life/sound/listening.h"
#include "life/sound/openal_module.h"
#include "life/sound/playback.h"
#include "life/sound/sound_server.h"
#include "life/sound/wave_file.h"
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

TEST(Server, PacketsGoBothWaysOverLoopback) {
  Result<Datagrams> server = Datagrams::listen(0, false);
  ASSERT_TRUE(server) << to_string(server.errors());
  Result<Datagrams> client = Datagrams::connect(fmt::format("127.0.0.1:{}", server->port()));
  ASSERT_TRUE(client) << to_string(client.errors());
  client->send("hello");
  EXPECT_EQ(server->receive(2000), "hello");
  server->send("hello yourself");
  EXPECT_EQ(client->receive(2000), "hello yourself");
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

class SoundNodeTest : public scene::ScriptTest<> {
 protected:
  SoundNodeTest()
      : ScriptTest([] {
          Registries registries;
          script::register_room(registries), sound::register_room(registries);
          return registries;
        }()) {}
};

TEST_F(SoundNodeTest, NodesBecomeEmitters) {
  const scene::Scene scene = scene_of(
      "group(position=\"5 0 0\") {\n  sound(kind=\"fountain\", position=\"1 2 0.5\", level_db=3)\n}\n"
      "sound(kind=\"bell\", on=0)\nsound(kind=\"car\", follows=\"nobody\")\n");
  const std::vector<Emitter> emitters = SceneSounds().at(scene, 0.02);
  ASSERT_EQ(emitters.size(), 1u);
  EXPECT_NEAR(emitters[0].position.x, 6.0, 1e-6);
  EXPECT_NEAR(emitters[0].power_db[4], power_db(SoundKind::fountain, 0.0)[4] + 3.0, 1e-9);
  EXPECT_TRUE(holds(errors_of("sound(kind=\"trumpet\")\n"), "scene.xp:1:"));
  EXPECT_TRUE(holds(errors_of("sound(kind=\"recording\")\n"), "needs a file="));
}

}  // namespace
}  // namespace parvis::sound
