// From directions to ears and loudspeakers: each stream's signal with delays and gains by channel.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "life/sound/band_noise.h"

namespace parvis::sound {

/// Which ears or loudspeakers.
enum class Output {
  headphones,  ///< a spherical head of 8.75 cm (Woodworth's delay; shadow of Brown and Duda 1998)
  stereo,      ///< two loudspeakers, 30 degrees to the left and right, by equal power
  surround_4,  ///< 4.0: four corners
  surround_5,  ///< 5.1 as ITU-R BS.775 places them
  surround_7,  ///< 7.1
  microphone   ///< both channels alike, without directions: levels are those of a sound level meter
};

/// Names of outputs in commands, in the order of Output.
inline constexpr std::array output_names{"headphones", "stereo", "4.0", "5.1", "7.1", "microphone"};

/// A channel of an output.
struct Channel {
  std::string_view name;             ///< as "front left"
  std::uint32_t mask = 0;            ///< its bit in the channel mask of WAVE
  std::optional<float> azimuth_deg;  ///< clockwise from ahead; nothing: no direction is heard from it
};

/// Channels of an output in the order of WAVE.
std::span<const Channel> channels_of(Output output);

/// The buffers of all channels, equally long, in the order of `channels_of`.
using Buffers = std::span<const std::span<float>>;

/// A premixed signal that is heard from one direction, which goes evenly from `from` to `to`.
struct Stream {
  glm::vec3 from{0, 1, 0}, to{0, 1, 0};  ///< unit: x right, y ahead, z up
  std::span<const float> signal;
  bool is_used = false;
};

/// Puts streams into channels, moment after moment. A stream is known by its index: what its filters hold
/// goes on to the next moment.
class Spatialiser {
 public:
  /// A spatialiser of at most so many streams.
  Spatialiser(Output output, std::size_t streams);

  /// Adds what is heard to the buffers.
  void add(std::span<const Stream> streams, Buffers buffers);

 private:
  struct Head {
    std::array<float, 2> shadow_in{}, shadow_out{};  ///< the last sample of each ear's filter
    std::vector<float> past;                         ///< samples before this moment, for delays
  };

  void add_to_head(Head& head, const Stream& stream, Buffers buffers) const;

  Output output_;
  std::vector<Head> heads_;
};

}  // namespace parvis::sound
