// The late field of squares, streets, courts and arcades: what facades reflect more often than the paths of
// propagation count, from everywhere at once.
#pragma once

#include <glm/glm.hpp>

#include "life/propagation/site.h"
#include "life/sound/band_noise.h"

namespace parvis::sound {

/// How a place reflects, found by rays that facades mirror until they rise above a roof.
struct Enclosure {
  /// Energy of the late field at the listener for a source of unit power within the place, by octave.
  Octaves energy{};
  Octaves decay_s{};     ///< in which it falls to 1/e
  double reach_m = 0.0;  ///< sources farther away are not in the place
};

/// The enclosure about a place; a field without facades has none. Reflections of `first_order` or less are
/// those of the paths. Rays go from the listener: the mean of what they still travel after those, over the
/// volume of the place, is what a source gives (Kuttruff 2009, 4.1, of a room whose ceiling absorbs all).
Enclosure enclosure_about(const propagation::Site& site, const glm::dvec3& place, int first_order,
                          const Octaves& air_db_per_m);
/// The same of what lies below the ceiling over a place, as an arcade: rays that leave through its openings
/// are lost. Nothing where there is no ceiling.
Enclosure covered_about(const propagation::Site& site, const glm::dvec3& place, int first_order,
                        const Octaves& air_db_per_m);

/// The late field of a moving listener: energies that follow their sources as the place decays.
class LateField {
 public:
  /// Advances by `step_s`: `power` is the sum of the sources' powers within the place, by octave, in the unit
  /// of the result.
  const Octaves& advance(const Enclosure& enclosure, const Octaves& power, double step_s);

 private:
  Octaves energy_{};
};

}  // namespace parvis::sound
