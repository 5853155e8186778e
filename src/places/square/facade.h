// Facades in relief: arcades or shops on the ground floor, windows with shutters, hoods and balconies above,
// string courses and a cornice.
#pragma once

#include "base/random.h"
#include "places/square/relief_mesh.h"

namespace parvis::square {

/// The kind of a ground floor.
enum class GroundFloor : std::uint8_t {
  arcade,        ///< open arches before a gallery
  blind_arcade,  ///< the same arches with shops in them
  shops          ///< a flat front
};

/// How finely a facade is modelled.
enum class FacadeDetail : std::uint8_t { whole, plain };

/// Dimensions in metres, and linear colours.
struct FacadeStyle {
  GroundFloor ground = GroundFloor::shops;
  FacadeDetail detail = FacadeDetail::whole;
  float ground_m = 4.5f, cornice_out_m = 0.5f;
  std::vector<float> floors_m{3.4f, 3.3f, 3.1f};
  glm::vec3 wall{0.5f}, trim{0.55f}, shutter{0.1f};
  float balconies = 0.3f;      ///< the probability of one on a bay of the first floor
  bool has_pediments = false;  ///< over the windows of the first floor
  int shop_strip = 0;

  float eaves_m() const;  ///< the top of the cornice
};

inline constexpr float cornice_m = 0.95f;  ///< height of the cornice
inline constexpr float gallery_m = 4.2f;   ///< from an arcade's front to the shops behind it

/// Builds a facade from x = 0 to `width_m` of the mesh's frame, in `bays` bays. Gallery ends are open where
/// `open_left` and `open_right` say so.
void add_facade(ReliefMesh& mesh, const FacadeStyle& style, float width_m, int bays, bool open_left,
                bool open_right, Random& random);

/// The facade on the side of such a house: its ground floor, blind arches or shops, from `from_m` to `to_m`
/// alone; the gallery's end stands in the rest.
void add_side_facade(ReliefMesh& mesh, const FacadeStyle& style, float width_m, int bays, float from_m,
                     float to_m, Random& random);

}  // namespace parvis::square
