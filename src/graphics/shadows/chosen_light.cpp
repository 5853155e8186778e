#include "graphics/shadows/chosen_light.h"

#include "graphics/shadows/near_map_fit.h"

namespace parvis::shadows {
namespace {

using light::ShadowTechnique;

constexpr float min_sun_height =
    0.02f;  // sine; below it shadows are longer than any place, and maps degenerate

/// Limit of boxes about moved things, above which a view starts over: to ask each pixel about them takes
/// longer.
constexpr std::size_t max_moved = 1024;

/// The method of shadow_fit.h, for those that fit maps.
light::ShadowMethod fitted_by(ShadowTechnique technique) {
  switch (technique) {
    case ShadowTechnique::perspective:
      return light::ShadowMethod::perspective;
    case ShadowTechnique::light_space_perspective:
      return light::ShadowMethod::light_space_perspective;
    default:
      return light::ShadowMethod::cascades;
  }
}

bool fits_maps(ShadowTechnique technique) {
  return technique != ShadowTechnique::cached_cascades && technique != ShadowTechnique::rays &&
         technique != ShadowTechnique::none;
}

}  // namespace

ChosenShadows::ChosenShadows(const scene::Scene& scene, const Bounds& fixed)
    : settings_(scene.data<light::ShadowSettings>()), sun_(scene::sun_light(scene)), fixed_(fixed) {
  make_maps();
}

void ChosenShadows::make_maps() {
  light::FitNearMap fit;
  if (fits_maps(settings_.technique))
    fit = [this](const Camera& camera, const scene::SunLight& sun, const Bounds& fixed) {
      glm::vec3 to_sun = glm::normalize(sun.direction_to_sun);
      to_sun = glm::normalize(glm::vec3(to_sun.x, to_sun.y, std::max(to_sun.z, min_sun_height)));
      const light::SeenSurfaces seen = seen_surfaces(*followed_, camera, settings_.updates_near);
      return fit_near_map(fitted_by(settings_.technique), camera, to_sun, seen, fixed);
    };
  maps_ = std::make_unique<light::SunShadowMaps>(sun_, fixed_, std::move(fit));
}

bool ChosenShadows::choose(const scene::Scene& scene) {
  const light::ShadowSettings& wanted = scene.data<light::ShadowSettings>();
  const bool is_other = wanted.technique != settings_.technique;
  settings_ = wanted;
  sun_ = scene::sun_light(scene);
  if (is_other) followed_.reset();  // its precision may be another
  follow(scene);
  if (is_other) make_maps();
  return is_other;
}

/// The rays see the scene as it is in this frame.
void ChosenShadows::follow(const scene::Scene& scene) {
  if (settings_.technique == ShadowTechnique::cached_cascades || !casts()) return followed_.reset();
  if (!followed_ || has_new_fixed_) {
    followed_ = std::make_unique<reference::RayScene>(
        scene, is_exact() ? reference::Precision::fine : reference::Precision::coarse);
    ++scene_version_;
  } else {
    followed_->update(scene);
    if (is_exact()) moved_.insert(moved_.end(), followed_->moved().begin(), followed_->moved().end());
    if (moved_.size() > max_moved) {
      ++scene_version_;
      moved_.clear();
    }
  }
  has_new_fixed_ = false;
}

void ChosenShadows::renew(const render::FixedChange& change, const Bounds& fixed) {
  fixed_.add(fixed);
  has_new_fixed_ = true;
  maps_->renew(change, fixed);
}

void ChosenShadows::update(const Camera& camera, const scene::SunLight& sun, std::span<const Bounds> moving,
                           const render::DrawView& draw) {
  if (casts()) return maps_->update(camera, sun, moving, draw);
  maps_->update(camera, sun, moving, [&](const render::View& view) {
    static const std::vector<std::uint8_t> nothing;
    render::View empty = view;
    empty.shown_objects = &nothing;
    draw(empty);
  });
}

render::TracedSun ChosenShadows::trace_view(const Camera& camera, int width, int height) {
  if (!is_exact()) return 0;
  traced_.trace(*followed_, scene_version_, moved_, sun_, camera, width, height, settings_.sun_samples);
  moved_.clear();
  return traced_.upload();
}

Result<std::unique_ptr<render::LightSource>> ChosenLight::create(const scene::Scene& scene,
                                                                 const Bounds& fixed) {
  auto shadows = std::make_unique<ChosenShadows>(scene, fixed);
  ChosenShadows* const chosen = shadows.get();
  Result<std::unique_ptr<render::LightSource>> light =
      light::SunAndSky::create(scene, fixed, std::move(shadows));
  if (!light) return light.errors();
  return std::unique_ptr<render::LightSource>(new ChosenLight(*std::move(light), chosen));
}

}  // namespace parvis::shadows
