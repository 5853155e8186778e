// The paper's city with a crown of 10,000 vertices that is lit at them: an object that a running scene moves.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "base/bounds.h"
#include "bench/benches.h"
#include "bench/scratch_folder.h"
#include "graphics/light/vertex_light.h"
#include "house/stage/stage.h"

namespace parvis::bench {

/// The city's files and the running scene that was read from them.
class CrownCity {
 public:
  /// Writes the city and the crown's model into `folder`, for any number of `open`.
  static Status write(const ScratchFolder& folder);
  /// `how_lit` is what stands between the parentheses of litVirtualObject: nothing, as it ships.
  static Result<CrownCity> open(const BenchSetup& setup, const ScratchFolder& folder, const char* how_lit);

  /// Moves the crown to a place east and north of the main crossing; `advance` shows it.
  void move(glm::vec2 from_crossing_m);
  /// A message to the scene's dayLight. Fails as SceneClock::send.
  Status send_to_sky(const std::string& message) { return play_.clock.send("%dayLight", message); }
  void advance();
  /// Advances, and finishes what is spread over frames to come.
  void settle();

  /// The crown's index in the scene.
  int object() const { return int(crown_); }
  const scene::Scene& scene() const { return play_.scene; }
  /// Irradiance of the crown's vertices, as renderers have it now.
  std::vector<glm::vec3> light() const;
  /// The same vertices where they stand now, in the same order.
  std::vector<light::LitVertex> vertices() const;
  /// Their box.
  Bounds bounds() const;
  /// Fails where no wall stands within 8 m east or west of the middle of the crown: on a lawn all places have
  /// one light.
  Status stands_beside_facade() const;
  /// Fails where anything else stands among the leaves, or where more than a few of them lie in the shade of
  /// other things: inside a street tree rays would end within a metre.
  Status stands_free_in_sun(glm::vec3 to_sun) const;
  /// What casts light and shade on the crown: all that stands still, with the crown itself or without it.
  scene::Scene casters(bool with_crown) const;

 private:
  CrownCity(house::Play play, std::size_t crown) : play_(std::move(play)), crown_(crown) {}

  house::Play play_;
  std::size_t crown_;  ///< index of the object
};

/// East and north of the main crossing: its middle, and in the street to the north of it. At
/// the city's hour, 15:30 on a day in June, one side of that street lies in the sun, as the crossing does,
/// and the other in the shade. In the sun it is the crown of an orange tree between two street trees, 11 and
/// 18 m from their trunks.
inline constexpr glm::vec2 crown_on_crossing_m{0.0f}, crown_in_sun_m{5.0f, 52.0f},
    crown_in_shade_m{-5.0f, 20.0f};

/// Root of the mean square of what is off, over all channels, as a share of the truth's mean.
double light_rmse_percent(const std::vector<glm::vec3>& light, const std::vector<glm::vec3>& truth);

}  // namespace parvis::bench
