// Band noise, kinds of sounds, the mixer and what is heard in a scene.
#include <gtest/gtest.h>

#include <numeric>

#include "life/sound/listening.h"
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
  for (std::size_t kind = 0; kind < sound_names.size(); ++kind) {
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
  EXPECT_EQ(mixer.counts().clusters, 24u);
  for (std::size_t band = 0; band < octaves; ++band)
    EXPECT_NEAR(propagation::level(band_energy(left, band) / 5e-3), 0.0, 1.5) << band;
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
  const std::vector<float> left{0.0f, 2.0f}, right{-1.0f, 0.5f};
  std::size_t clipped = 0;
  const std::string bytes = encode_wave(left, right, &clipped);
  EXPECT_EQ(bytes.size(), 44u + 8u);
  EXPECT_EQ(bytes.substr(0, 4), "RIFF");
  EXPECT_EQ(clipped, 1u);
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
}

}  // namespace
}  // namespace parvis::sound
