// What a city model says about a building beside its shape, in classes, and the words for it in the names of
// parts.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <string>
#include <string_view>

namespace parvis::scene {

/// When a building was built: times whose walls and windows look alike.
enum class BuildingEpoch : std::uint8_t {
  unknown,
  before_1870,
  to_1918,
  to_1945,
  to_1974,
  to_1999,
  since_2000
};

enum class BuildingUse : std::uint8_t { unknown, dwelling, shop, office, industry, shed, church };

enum class WallFinish : std::uint8_t { unknown, brick, plaster, stone, concrete, metal, wood };

enum class WallTint : std::uint8_t { unknown, white, grey, dark, yellow, red, brown, green, blue };

/// The class of a building; all of it unknown: the file says nothing.
struct BuildingKind {
  BuildingUse use = BuildingUse::unknown;
  BuildingEpoch epoch = BuildingEpoch::unknown;
  WallFinish finish = WallFinish::unknown;
  WallTint tint = WallTint::unknown;
  std::uint8_t storeys = 0;  ///< above ground; 0: unknown

  auto operator<=>(const BuildingKind&) const = default;
};

/// The epoch of a year of construction.
BuildingEpoch epoch_of(int year);

/// "office since-2000 plaster white 4-storeys"; empty where all is unknown.
std::string words_of(const BuildingKind& kind);
/// The kind that the name of a part ("WallSurface office 4-storeys") has words for, in any order; other words
/// count for nothing.
BuildingKind kind_of_words(std::string_view name);

/// Completes the kind of a building's part: members that `own` does not know are those of `whole`.
BuildingKind completed(BuildingKind own, const BuildingKind& whole);

}  // namespace parvis::scene
