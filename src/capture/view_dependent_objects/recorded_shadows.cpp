#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "base/random.h"
#include "capture/photographs/shadow_strength.h"
#include "capture/view_dependent_objects/blended_model.h"
#include "capture/view_dependent_objects/view_lookup.h"
#include "graphics/shading/recorded_light.h"

namespace parvis::view_dependent_objects {
namespace {

constexpr std::size_t points_per_view = 600;

/// Colours of a piece as one of its viewpoints has them.
void add_colours(const ViewLookup& lookup, const BlendedModel& model, const Piece& piece, int view,
                 std::vector<glm::vec3>& radiances) {
  const glm::vec3 viewpoint(model.table[std::size_t(piece.first_entry + view)]);
  Random random(11);
  for (std::size_t i = 0; i < points_per_view; ++i) {
    const std::size_t triangle =
        piece.first_triangle +
        std::min(std::size_t(random.uniform() * float(piece.triangle_count)), piece.triangle_count - 1);
    const float across = std::sqrt(random.uniform()), along = random.uniform();
    const glm::vec2 weights(across * (1.0f - along), across * along);
    const glm::vec3* c = model.corners.data() + 3 * triangle;
    const glm::vec3 away = viewpoint - (c[0] + weights.x * (c[1] - c[0]) + weights.y * (c[2] - c[0]));
    if (!(glm::length(away) > 0.0f)) continue;
    const glm::vec4 colour = lookup.colour(piece, {triangle, weights, glm::normalize(away), 0.0f}, 1);
    if (colour.w >= 0.5f)
      radiances.push_back(
          shading::tone_unmapped(glm::clamp(glm::vec3(colour), glm::vec3(0.0f), glm::vec3(1.0f))));
  }
}

}  // namespace

void find_shadows(BlendedModel& model) {
  std::vector<glm::vec3> radiances;
  {
    // Without ownership: the lookup lives only here.
    const ViewLookup lookup(std::shared_ptr<const BlendedModel>(&model, [](const BlendedModel*) {}));
    for (const Piece& piece : model.pieces)
      for (int view = 0; view < piece.views && piece.triangle_count > 0; ++view)
        add_colours(lookup, model, piece, view, radiances);
  }
  const std::optional<photographs::LitAndShaded> found = photographs::lit_and_shaded(radiances);
  model.kept_in_shadows = photographs::kept_in_shadows({&found, 1});
  model.lit_luminance = found ? found->lit : 0.0f;
}

}  // namespace parvis::view_dependent_objects
