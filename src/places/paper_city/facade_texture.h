// Textures of upper floors: for each of eight styles a sheet of four bays by three floors, repeated over a
// facade.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "synthesis/wall_texture.h"
#include "synthesis/window_texture.h"

namespace parvis::city {

/// Wall, windows and ornament of a facade.
struct FacadeStyle {
  std::string name;
  synthesis::Wall wall = synthesis::Wall::plaster;
  glm::vec3 wall_colour{0.5f};  ///< linear
  synthesis::WindowStyle window;
  bool has_string_course = true;
  bool has_quoined_piers = false;  ///< strips of stone between every two bays
};

inline constexpr int facade_style_count = 8;
inline constexpr int facade_bays = 4, facade_floors = 3;  // on one sheet
inline constexpr float facade_bay_m = 3.2f,
                       facade_floor_m = 3.4f;  // as painted; buildings stretch them a little

/// The styles, in the palette of a southern city.
const std::array<FacadeStyle, facade_style_count>& facade_styles();

/// The painted sheet of a style.
synthesis::SurfaceCanvas facade_canvas(const FacadeStyle& style, std::uint32_t seed);
/// Its textures.
synthesis::SurfacePictures facade_pictures(const FacadeStyle& style, std::uint32_t seed);

}  // namespace parvis::city
