// Each stream is a source in the direction from which it is heard, at 1 m and without distance laws: levels,
// delays and the Doppler effect are in the streams. Samples are floats at the rate of all sounds, so that
// OpenAL resamples nothing.
#include "life/sound/openal_module.h"

#include <AL/al.h>
#include <AL/alc.h>
#include <AL/alext.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <thread>

namespace parvis::sound {
namespace {

/// A device with its context, which is the calling thread's while work is done.
class Context {
 public:
  Context(ALCdevice* device, std::span<const ALCint> attributes)
      : device_(device),
        context_(alcCreateContext(device, attributes.data())),
        set_thread_context_(
            reinterpret_cast<PFNALCSETTHREADCONTEXTPROC>(alcGetProcAddress(nullptr, "alcSetThreadContext"))) {
    if (!context_) return;
    use();
    alDistanceModel(AL_NONE);
    alDopplerFactor(0.0f);
  }
  Context(const Context&) = delete;
  ~Context() {
    if (set_thread_context_) set_thread_context_(nullptr);
    if (context_) alcDestroyContext(context_);
    alcCloseDevice(device_);
  }

  bool is_there() const { return context_ != nullptr && set_thread_context_ != nullptr; }
  void use() const {
    if (set_thread_context_) set_thread_context_(context_);
  }
  ALCdevice* device() const { return device_; }

 private:
  ALCdevice* device_;
  ALCcontext* context_;
  PFNALCSETTHREADCONTEXTPROC set_thread_context_;
};

/// A source that stands about the listener's head; negative numbers of AL are errors, which leave 0.
ALuint head_source() {
  ALuint source = 0;
  alGenSources(1, &source);
  alSourcei(source, AL_SOURCE_RELATIVE, AL_TRUE);
  return source;
}

/// OpenAL looks along -z, with y up.
void place(ALuint source, glm::vec3 direction) {
  alSource3f(source, AL_POSITION, direction.x, direction.z, -direction.y);
}

/// A source with the buffers in which its samples wait.
struct Voice {
  ALuint source = 0;
  std::vector<ALuint> idle;

  void make(std::size_t buffers) {
    source = head_source();
    idle.resize(buffers);
    alGenBuffers(ALsizei(buffers), idle.data());
  }
  void collect() {
    ALint done = 0, state = 0;
    alGetSourcei(source, AL_SOURCE_STATE, &state);
    alGetSourcei(source, AL_BUFFERS_PROCESSED, &done);
    for (; done > 0; --done) {
      ALuint buffer = 0;
      alSourceUnqueueBuffers(source, 1, &buffer);
      idle.push_back(buffer);
    }
    // A source that has run out of samples counts all that is queued from then on as played.
    if (state == AL_STOPPED) alSourceRewind(source);
  }
  void queue(ALenum format, std::span<const float> samples) {
    if (idle.empty()) return;
    const ALuint buffer = idle.back();
    idle.pop_back();
    alBufferData(buffer, format, samples.data(), ALsizei(samples.size_bytes()), sample_rate);
    alSourceQueueBuffers(source, 1, &buffer);
  }
};

constexpr ALCint loudspeaker_attributes[]{ALC_FREQUENCY, sample_rate, ALC_HRTF_SOFT, ALC_FALSE, 0};

/// The attribute of the head that OpenAL's settings name, as it was measured at the rate of all sounds: with
/// one of 44.1 kHz, which stands first by default, all is resampled.
std::vector<ALCint> head_attributes(ALCdevice* device) {
  const auto string_of =
      reinterpret_cast<LPALCGETSTRINGISOFT>(alcGetProcAddress(device, "alcGetStringiSOFT"));
  ALCint count = 0;
  alcGetIntegerv(device, ALC_NUM_HRTF_SPECIFIERS_SOFT, 1, &count);
  std::vector<ALCint> result{ALC_HRTF_SOFT, ALC_TRUE};
  if (!string_of || count == 0) return result;
  const auto name_of = [&](ALCint i) { return std::string(string_of(device, ALC_HRTF_SPECIFIER_SOFT, i)); };
  std::string wanted = name_of(0);
  if (const std::size_t at = wanted.find("44100"); at != std::string::npos) wanted.replace(at, 5, "48000");
  for (ALCint i = 0; i < count; ++i)
    if (name_of(i) == wanted) {
      result.insert(result.end(), {ALC_HRTF_ID_SOFT, i});
      break;
    }
  return result;
}

std::vector<ALCint> listening_attributes(ALCdevice* device) {
  std::vector<ALCint> result = head_attributes(device);
  result.insert(result.end(), {ALC_FREQUENCY, sample_rate, 0});
  return result;
}

ALenum format_of(std::size_t channels) {
  return channels == 8   ? AL_FORMAT_71CHN32
         : channels == 6 ? AL_FORMAT_51CHN32
         : channels == 4 ? AL_FORMAT_QUAD32
                         : AL_FORMAT_STEREO_FLOAT32;
}

/// Signals of several channels, sample by sample.
template <class Signals>
std::vector<float> interleaved(const Signals& signals) {
  std::vector<float> all(std::size(signals) * device_moment);
  for (std::size_t c = 0; c < std::size(signals); ++c)
    for (std::size_t k = 0; k < device_moment; ++k) all[k * std::size(signals) + c] = signals[c][k];
  return all;
}

class OpenAlDevice final : public Device {
 public:
  /// A voice for each stream, or for `loudspeakers` one with all their channels.
  OpenAlDevice(ALCdevice* device, std::size_t streams, std::size_t loudspeakers)
      : context_(device, loudspeakers > 0 ? std::vector<ALCint>(std::begin(loudspeaker_attributes),
                                                                std::end(loudspeaker_attributes))
                                          : listening_attributes(device)),
        voices_((loudspeakers > 0 ? 1 : streams) + 1),
        silence_(device_moment, 0.0f),
        loudspeakers_(loudspeakers) {
    if (!context_.is_there()) return;
    for (Voice& voice : voices_) voice.make(queued);
    alSourcei(voices_.back().source, AL_DIRECT_CHANNELS_SOFT, AL_TRUE);  // beds
    // Else the front centre would be silent.
    if (loudspeakers > 0) alSourcei(voices_.front().source, AL_DIRECT_CHANNELS_SOFT, AL_TRUE);
  }
  bool is_there() const { return context_.is_there(); }

  Status play(std::span<const Stream> streams, const std::array<std::span<const float>, 2>& beds) override {
    context_.use();
    const auto begin = std::chrono::steady_clock::now();
    while (true) {
      ALCint connected = ALC_TRUE;
      alcGetIntegerv(context_.device(), ALC_CONNECTED, 1, &connected);
      if (connected == ALC_FALSE) return error("the sound device is gone");
      for (Voice& voice : voices_) voice.collect();
      if (std::ranges::none_of(voices_, [](const Voice& voice) { return voice.idle.empty(); })) break;
      if (std::chrono::steady_clock::now() - begin > std::chrono::seconds(1))
        return error("the sound device takes no samples");
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    std::vector<ALuint> halted;
    for (std::size_t i = 0; i < voices_.size(); ++i) {
      Voice& voice = voices_[i];
      if (i == 0 && loudspeakers_ > 0) {
        std::vector<std::span<const float>> signals;
        for (const Stream& stream : streams) signals.push_back(stream.signal);
        voice.queue(format_of(loudspeakers_), interleaved(signals));
      } else if (i + 1 < voices_.size() && i < streams.size() && streams[i].is_used) {
        place(voice.source, streams[i].to);
        voice.queue(AL_FORMAT_MONO_FLOAT32, streams[i].signal);
      } else if (i + 1 < voices_.size()) {
        voice.queue(AL_FORMAT_MONO_FLOAT32, silence_);
      } else {
        voice.queue(AL_FORMAT_STEREO_FLOAT32, interleaved(beds));
      }
      ALint state = 0;
      alGetSourcei(voice.source, AL_SOURCE_STATE, &state);
      if (state != AL_PLAYING) halted.push_back(voice.source);
    }
    // All together, so that they stay in step; not before half of the moments wait.
    if (!halted.empty() && 2 * voices_.front().idle.size() <= queued)
      alSourcePlayv(ALsizei(halted.size()), halted.data());
    return alGetError() == AL_NO_ERROR ? Status(Ok{}) : error("the sound device takes no samples");
  }

 private:
  static constexpr std::size_t queued = 6;  // moments: 120 ms

  Context context_;
  std::vector<Voice> voices_;
  std::vector<float> silence_;
  std::size_t loudspeakers_;
};

class OpenAlLoopback final : public Loopback {
 public:
  OpenAlLoopback(ALCdevice* device, std::size_t sources, std::span<const float> loop)
      : context_(device, attributes_for(device, sources)),
        render_(reinterpret_cast<LPALCRENDERSAMPLESSOFT>(alcGetProcAddress(device, "alcRenderSamplesSOFT"))),
        voices_(sources),
        loop_samples_(loop.size()) {
    if (!context_.is_there()) return;
    alGenBuffers(1, &loop_);
    alBufferData(loop_, AL_FORMAT_MONO_FLOAT32, loop.data(), ALsizei(loop.size_bytes()), sample_rate);
  }
  bool is_there() const { return context_.is_there() && render_; }

  void render(std::span<const Stream> streams, std::span<float> left, std::span<float> right) override {
    context_.use();
    std::vector<ALuint> halted;
    for (std::size_t i = 0; i < std::min(streams.size(), voices_.size()); ++i) {
      Voice& voice = voices_[i];
      if (!streams[i].is_used) continue;
      if (voice.source == 0) {  // one moment of silence goes before, so that the source never ends
        voice.make(3);
        voice.queue(AL_FORMAT_MONO_FLOAT32, std::vector<float>(streams[i].signal.size(), 0.0f));
      }
      voice.collect();
      place(voice.source, streams[i].to);
      voice.queue(AL_FORMAT_MONO_FLOAT32, streams[i].signal);
      ALint state = 0;
      alGetSourcei(voice.source, AL_SOURCE_STATE, &state);
      if (state != AL_PLAYING) halted.push_back(voice.source);
    }
    if (!halted.empty()) alSourcePlayv(ALsizei(halted.size()), halted.data());
    take(left, right);
  }

  void render_sources(std::span<const glm::vec3> directions, std::span<float> left,
                      std::span<float> right) override {
    context_.use();
    for (std::size_t i = 0; i < std::min(directions.size(), voices_.size()); ++i) {
      ALuint& source = voices_[i].source;
      const bool is_new = source == 0;
      if (is_new) {
        source = head_source();
        alSourcei(source, AL_BUFFER, ALint(loop_));
        alSourcei(source, AL_LOOPING, AL_TRUE);
        alSourcei(source, AL_SAMPLE_OFFSET, ALint(i * 997 % loop_samples_));
      }
      place(source, directions[i]);
      if (is_new) alSourcePlay(source);
    }
    take(left, right);
  }

 private:
  static std::vector<ALCint> attributes_for(ALCdevice* device, std::size_t sources) {
    std::vector<ALCint> result = head_attributes(device);
    result.insert(result.end(),
                  {ALC_FORMAT_CHANNELS_SOFT, ALC_STEREO_SOFT, ALC_FORMAT_TYPE_SOFT, ALC_FLOAT_SOFT,
                   ALC_FREQUENCY, sample_rate, ALC_MONO_SOURCES, ALCint(sources), 0});
    return result;
  }

  void take(std::span<float> left, std::span<float> right) {
    std::vector<float> both(2 * left.size());
    render_(context_.device(), both.data(), ALCsizei(left.size()));
    for (std::size_t i = 0; i < left.size(); ++i) left[i] = both[2 * i], right[i] = both[2 * i + 1];
  }

  Context context_;
  LPALCRENDERSAMPLESSOFT render_;
  std::vector<Voice> voices_;
  std::size_t loop_samples_;
  ALuint loop_ = 0;
};

Result<std::unique_ptr<Device>> open_with(const std::string& name, std::size_t streams,
                                          std::size_t loudspeakers) {
  ::setenv("ALSOFT_LOGLEVEL", "0", 0);  // what it would print is said in our words
  ALCdevice* const device = alcOpenDevice(name == "default" ? nullptr : name.c_str());
  if (!device)
    return name == "default" ? error("no sound device can be opened")
                             : error(
                                   "the sound device \"{}\" cannot be opened; expected default, null, the "
                                   "name of a file that ends in .wav, or off",
                                   name);
  auto opened = std::make_unique<OpenAlDevice>(device, streams, loudspeakers);
  if (!opened->is_there()) return error("the sound device offers no context");
  return std::unique_ptr<Device>(std::move(opened));
}

Result<std::unique_ptr<Device>> open(const std::string& name, std::size_t streams) {
  return open_with(name, streams, 0);
}

Result<std::unique_ptr<Device>> open_loudspeakers(const std::string& name, std::size_t loudspeakers) {
  return open_with(name, 0, loudspeakers);
}

Result<std::unique_ptr<Loopback>> open_loopback(std::size_t sources, std::span<const float> loop) {
  ::setenv("ALSOFT_LOGLEVEL", "0", 0);
  const auto open_device =
      reinterpret_cast<LPALCLOOPBACKOPENDEVICESOFT>(alcGetProcAddress(nullptr, "alcLoopbackOpenDeviceSOFT"));
  ALCdevice* const device = open_device ? open_device(nullptr) : nullptr;
  if (!device) return error("OpenAL Soft offers no loopback");
  auto opened = std::make_unique<OpenAlLoopback>(device, sources, loop);
  if (!opened->is_there()) return error("OpenAL Soft's loopback offers no context");
  return std::unique_ptr<Loopback>(std::move(opened));
}

}  // namespace
}  // namespace parvis::sound

PARVIS_MODULE(parvis::sound::OpenAlFunctions){parvis::sound::open, parvis::sound::open_loudspeakers,
                                              parvis::sound::open_loopback};
