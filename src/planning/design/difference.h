// What differs between two designs: for a table, and for colours in the place.
#pragma once

#include <string>
#include <vector>

#include "planning/design/placed_object.h"

namespace parvis::design {

/// How an object of one design differs from its counterpart in another.
enum class Differs : unsigned char { added, removed, moved, changed };

/// One object that differs. Of an added one `before` is empty, of a removed one `after`.
struct Difference {
  Differs how = Differs::added;
  PlacedObject before, after;
  double moved_m = 0.0;  ///< between the two feet

  /// The one that there is: the later of the two.
  const PlacedObject& shown() const {
    return how == Differs::removed ? before : after;
  }  ///< the one there is
};

/// The differences that turn `before` into `after`. Objects of one kind are the same where they have the same
/// name, or stand within 5 cm of each other; then they are moved (their foot or heading differs), changed
/// (size, colour or material) or not listed. All others are removed or added. Removed ones come first, then
/// in the order of `after`.
std::vector<Difference> differences(const std::vector<PlacedObject>& before,
                                    const std::vector<PlacedObject>& after);

/// A word for people: "added", "removed", "moved", "changed".
const char* name_of(Differs how);

/// A line of the table: "moved    bench_stone  bench_3  by 0.40 m to 12.400,3.050".
std::string line_of(const Difference& difference);

}  // namespace parvis::design
