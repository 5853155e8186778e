// The module `openal`: what of this room knows OpenAL Soft.
#pragma once

#include "base/module.h"
#include "life/sound/device.h"

namespace parvis::sound {

/// A listener whom OpenAL Soft renders for into memory, by its heads' measured responses (HRTF).
class Loopback {
 public:
  virtual ~Loopback() = default;
  /// Writes the sound of streams at the listener's ears over both channels.
  virtual void render(std::span<const Stream> streams, std::span<float> left, std::span<float> right) = 0;
  /// The same of as many sources as there are directions, each of which plays one loop of noise by itself:
  /// OpenAL Soft alone, a baseline for measurements.
  virtual void render_sources(std::span<const glm::vec3> directions, std::span<float> left,
                              std::span<float> right) = 0;
};

/// The functions of the module.
struct OpenAlFunctions {
  /// "default" is the device that the system or OpenAL's own settings name.
  Result<std::unique_ptr<Device>> (*open)(const std::string& name, std::size_t streams);
  /// The same for 2, 4, 6 or 8 loudspeakers: the streams are their signals in the order of `channels_of`.
  Result<std::unique_ptr<Device>> (*open_loudspeakers)(const std::string& name, std::size_t loudspeakers);
  /// A listener for at most so many streams or sources; sources play `loop`.
  Result<std::unique_ptr<Loopback>> (*open_loopback)(std::size_t sources, std::span<const float> loop);
};

/// Loaded when the first device of OpenAL is opened.
inline constexpr Module<OpenAlFunctions> openal("openal");

}  // namespace parvis::sound
