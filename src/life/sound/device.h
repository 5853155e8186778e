// Where a mix is heard: devices as plug-ins.
#pragma once

#include <memory>
#include <string>

#include "base/result.h"
#include "life/sound/ears.h"

namespace parvis::sound {

/// Samples of a moment that a device takes: a fiftieth of a second.
inline constexpr std::size_t device_moment = sample_rate / 50;

/// Takes moments one after the other.
class Device {
 public:
  virtual ~Device() = default;

  /// Takes streams of `device_moment` samples and two channels of beds as long, which go round the streams'
  /// ears. Waits until there is room for them, a second at most. An error says that the device is gone.
  virtual Status play(std::span<const Stream> streams, const std::array<std::span<const float>, 2>& beds) = 0;
};

/// Opens a device for at most so many streams: "null" takes moments as time passes and plays nothing;
/// NAME.wav writes up to an hour; "default" and all other names are devices of OpenAL Soft, whose module is
/// loaded now. They play for headphones; with @ and a name of `output_names`, as in "default@5.1", for these
/// loudspeakers, which the device must have. Errors say what cannot be opened.
Result<std::unique_ptr<Device>> open_device(const std::string& name, std::size_t streams);

}  // namespace parvis::sound
