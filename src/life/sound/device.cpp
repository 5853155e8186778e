#include "life/sound/device.h"

#include <chrono>
#include <fstream>
#include <optional>
#include <thread>

#include "base/partial_file.h"
#include "life/sound/openal_module.h"
#include "life/sound/wave_file.h"

namespace parvis::sound {
namespace {

/// Lets a moment's time pass.
class Pace {
 public:
  void wait() {
    const auto now = std::chrono::steady_clock::now();
    next_ += std::chrono::microseconds(1'000'000 * device_moment / sample_rate);
    if (next_ < now) next_ = now;  // what was missed is not caught up with
    std::this_thread::sleep_until(next_);
  }

 private:
  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now();
};

class NullDevice final : public Device {
 public:
  Status play(std::span<const Stream>, const std::array<std::span<const float>, 2>&) override {
    pace_.wait();
    return Ok{};
  }

 private:
  Pace pace_;
};

/// Streams in the channels of an output.
class Channels {
 public:
  Channels(Output output, std::size_t streams) : output_(output), ears_(output, streams) {}

  void mix(std::span<const Stream> streams) {
    samples_.assign(channels_of(output_).size(), std::vector<float>(device_moment, 0.0f));
    ears_.add(streams, std::vector<std::span<float>>(samples_.begin(), samples_.end()));
  }
  Output output() const { return output_; }
  std::vector<std::vector<float>>& samples() { return samples_; }

 private:
  Output output_;
  Spatialiser ears_;
  std::vector<std::vector<float>> samples_;
};

/// Loudspeakers of another device, which takes the signal of each as a stream.
class Loudspeakers final : public Device {
 public:
  Loudspeakers(std::unique_ptr<Device> below, Output output, std::size_t streams)
      : below_(std::move(below)), channels_(output, streams) {}

  Status play(std::span<const Stream> streams, const std::array<std::span<const float>, 2>& beds) override {
    channels_.mix(streams);
    std::vector<Stream> signals;
    for (const std::vector<float>& signal : channels_.samples())
      signals.push_back({.signal = signal, .is_used = true});
    return below_->play(signals, beds);
  }

 private:
  std::unique_ptr<Device> below_;
  Channels channels_;
};

class FileDevice final : public Device {
 public:
  FileDevice(PartialFile file, Output output, std::size_t streams)
      : file_(std::move(file)), stream_(file_.path(), std::ios::binary), channels_(output, streams) {
    stream_ << wave_header(output, 0);
  }
  ~FileDevice() override {
    stream_.seekp(0);
    stream_ << wave_header(channels_.output(), frames_);
    stream_.close();
    if (stream_) static_cast<void>(file_.keep());
  }

  Status play(std::span<const Stream> streams, const std::array<std::span<const float>, 2>& beds) override {
    pace_.wait();
    constexpr std::uint32_t max_frames = 3600u * sample_rate;
    if (frames_ >= max_frames) return Ok{};
    channels_.mix(streams);
    std::vector<std::vector<float>>& samples = channels_.samples();
    for (std::size_t channel = 0; channel < beds.size(); ++channel)
      for (std::size_t i = 0; i < device_moment; ++i) samples[channel][i] += beds[channel][i];
    std::string bytes;
    append_samples(bytes, std::vector<std::span<const float>>(samples.begin(), samples.end()));
    stream_ << bytes;
    frames_ += std::uint32_t(device_moment);
    return stream_ ? Status(Ok{}) : error("the sound file cannot be written to any more");
  }

 private:
  PartialFile file_;
  std::ofstream stream_;
  Channels channels_;
  Pace pace_;
  std::uint32_t frames_ = 0;
};

}  // namespace

Result<std::unique_ptr<Device>> open_device(const std::string& full_name, std::size_t streams) {
  const std::size_t at = full_name.rfind('@');
  const auto named = at == std::string::npos ? output_names.end()
                                             : std::ranges::find(output_names, full_name.substr(at + 1));
  const bool is_given = named != output_names.end();
  const auto output = is_given ? Output(named - output_names.begin()) : Output::headphones;
  const std::string name = is_given ? full_name.substr(0, at) : full_name;
  if (name == "null") return std::unique_ptr<Device>(std::make_unique<NullDevice>());
  if (name.ends_with(".wav")) {
    Result<PartialFile> file = PartialFile::create(name);
    if (!file) return file.errors();
    return std::unique_ptr<Device>(std::make_unique<FileDevice>(*std::move(file), output, streams));
  }
  if (output == Output::headphones) return openal.call(&OpenAlFunctions::open, name, streams);
  Result<std::unique_ptr<Device>> below =
      openal.call(&OpenAlFunctions::open_loudspeakers, name, channels_of(output).size());
  if (!below) return below.errors();
  return std::unique_ptr<Device>(std::make_unique<Loudspeakers>(*std::move(below), output, streams));
}

}  // namespace parvis::sound
