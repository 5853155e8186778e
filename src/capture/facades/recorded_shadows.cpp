#include "capture/facades/recorded_shadows.h"

#include <optional>

#include "base/parallel.h"
#include "capture/facades/facade_lookup.h"
#include "capture/facades/surface_points.h"
#include "capture/photographs/shadow_strength.h"

namespace parvis::facades {
namespace {

constexpr std::size_t points_per_surface = 1500;
constexpr std::size_t max_decoded_bytes = std::size_t(1) << 30;  // of texels, while a scene is read

std::optional<photographs::LitAndShaded> shadows_of(const PackedFacade& facade, FacadeLookup& lookup,
                                                    const TriangleRun& run, glm::vec3 eye) {
  SurfacePoints points(facade, run);
  std::vector<glm::vec3> radiances;
  for (std::size_t i = 0; i < points_per_surface; ++i)
    if (const std::optional<glm::vec3> radiance = recorded_radiance(lookup, points.next(), eye))
      radiances.push_back(*radiance);
  return photographs::lit_and_shaded(radiances);
}

}  // namespace

void find_shadows(PackedFacade& facade) {
  facade.lit_of_surface.clear();
  facade.kept_in_shadows = photographs::kept_in_usual_shadow;
  if (facade.blocks.size() * 16 * 4 > max_decoded_bytes) return;  // 16 texels of 4 bytes per block
  const std::vector<TriangleRun> runs = runs_of_surfaces(facade);
  const glm::vec3 middle = middle_of_photographs(facade);
  const FacadeTexels texels(facade);
  std::vector<std::optional<photographs::LitAndShaded>> found(runs.size());
  parallel_for(runs.size(), [&](std::size_t i) {
    FacadeLookup lookup(facade, &texels);
    found[i] = shadows_of(facade, lookup, runs[i], middle);
  });
  facade.kept_in_shadows = photographs::kept_in_shadows(found);
  facade.lit_of_surface.assign(facade.surfaces.size(), 0);
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (found[i])
      facade.lit_of_surface[facade.surface_of_triangle[runs[i].first]] =
          photographs::encoded_luminance(found[i]->lit);
}

}  // namespace parvis::facades
