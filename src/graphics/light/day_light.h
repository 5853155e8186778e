// Daylight of a scene: a place on the earth, a day and an hour give its sun, its sky and how bright the
// picture is exposed.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "base/content_hash.h"
#include "base/image.h"
#include "base/result.h"
#include "graphics/light/day_light_time.h"
#include "graphics/light/sky_model.h"
#include "scene/data/room_data.h"
#include "scene/data/scene.h"

namespace parvis::light {

/// Settings of a scene by the nodes dayLight and skyDome.
struct DayLight {
  static constexpr std::string_view name = "light.day_light";
  /// Its results, sun and sky, are hashed where they are kept.
  static constexpr scene::DataRole role = scene::DataRole::settings;

  bool is_given = false;                  ///< the scene has a node dayLight
  std::optional<FileLocation> dome_node;  ///< the node skyDome
  PlaceAndTime when;
  Air air;
  SkyKind kind = SkyKind::atmosphere;
  std::shared_ptr<const ImageF> dome;  ///< a photograph of a whole sky (see Sky::picture), or null
  std::filesystem::path dome_file;
  float dome_heading = 0.0f;     ///< radians, turns it clockwise from above
  float chosen_exposure = 1.0f;  ///< by the node exposure: multiplies what the light asks for
  float adaptation = 1.0f;       ///< exposure that the light asks for, as `light_scene` found it
  float illuminance = 0.0f;      ///< of level ground by sky and sun, Y

  void hash(ContentHash& hash) const;
};

/// Gives the scene the sun, sky and exposure of its DayLight; nothing where it has none. The sky's picture is
/// without the sun's disc, as Sky expects. Errors say which
/// value is out of range.
Status light_scene(scene::Scene& scene);

/// Exposes a scene with daylight for what lights it: sky and sun, and at dusk its lamps, if it has any.
void adapt(scene::Scene& scene);

/// The whole sky as Sky::picture wants it, `width_px` by half as many: linear Rec. 709, W/m2/sr weighted by
/// the eye, what is outside of that gamut clamped to zero. Below the horizon the ground of the model, or that
/// of the dome under today's light.
ImageF sky_picture(const SkyModel& sky, const DayLight& day, int width_px);

/// Multiplies radiance so that a scene under `illuminance_xyz_y` (sky and sun on level ground, Y) is as
/// bright as one expects: as eyes do, it adapts to the light nearly but not fully, so that dusk is darker
/// than noon, and not to night.
float exposure_for(float illuminance_xyz_y);

}  // namespace parvis::light
