// How the shadows of a scene are found, and what stands in the sun's place: what the node shadowMap says
// (thesis, appendix A.3).
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "base/content_hash.h"
#include "scene/data/room_data.h"
#include "scene/data/scene.h"
#include "scene/data/sun_shadows.h"

namespace parvis::light {

/// How a running program finds the sun of each pixel.
enum class ShadowTechnique : unsigned char {
  cached_cascades,          ///< two maps about the viewer, of which the static part is kept (render)
  cascades,                 ///< four maps fitted to the depths that the view has
  perspective,              ///< Stamminger and Drettakis 2002
  light_space_perspective,  ///< Wimmer, Scherzer and Purgathofer 2004
  rays,                     ///< exact; the sun's disc where nothing moves
  none                      ///< the sun shines through everything
};
/// Those that show shadows.
inline constexpr std::array shadow_technique_names{"cached_cascades", "cascades", "perspective",
                                                   "light_space_perspective", "rays"};
inline constexpr int max_sun_samples = 256;

/// Settings of a scene's shadows; the default is that of a scene without a node shadowMap.
struct ShadowSettings {
  static constexpr std::string_view name = "light.shadows";
  /// Its effect on the sun is hashed with the sun.
  static constexpr scene::DataRole role = scene::DataRole::settings;

  ShadowTechnique technique = ShadowTechnique::cached_cascades;
  bool updates_near = true;  ///< maps begin at the nearest surface that the view shows, not at its near plane
  int sun_samples = 16;      ///< directions to the sun's disc for each pixel that stands still
  std::optional<glm::vec3> to_light;  ///< in place of the sun's direction; unit
  std::optional<scene::Sun> own_sun;  ///< as the nodes sun or dayLight say it; none: the scene's default

  /// Adds every setting.
  void hash(ContentHash& hash) const;
};

/// Gives a scene its sun as a node of light says it, with what shadowMap puts in its place.
void set_sun(scene::Scene& scene, const scene::Sun& sun);
/// The same where shadowMap has changed.
void replace_sun(scene::Scene& scene);

}  // namespace parvis::light
