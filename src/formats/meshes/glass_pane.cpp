#include "formats/meshes/glass_pane.h"

#include <algorithm>

#include "base/colour.h"
#include "scene/data/glass_pieces.h"

namespace parvis::scene {
namespace {

constexpr float min_alpha = 0.25f;  // as the preset clear_glass has it
constexpr float mirrored = 0.08f;   // of the light, seen straight on: by both faces
constexpr float tint_light =
    0.5f;  // of the light that a tint keeps, how much more of that colour is mirrored

/// Panes by the numbers of the materials of glass.
using Panes = std::map<int, int>;

int pane_for(Model& model, int glass, Panes& panes) {
  const auto [entry, is_new] = panes.try_emplace(glass, int(model.materials.size()));
  if (is_new) model.materials.push_back(pane_of(model.materials[std::size_t(glass)]));
  return entry->second;
}

}  // namespace

Material pane_of(const Material& glass) {
  const glm::vec3 clear =
      glm::clamp(glass.base_colour * glm::exp(-glass.thickness_m * glass.absorption_per_m), 0.0f, 1.0f);
  Material pane = glass;
  pane.ior = 1.0f, pane.absorption_per_m = glm::vec3(0.0f);
  pane.alpha = std::max(1.0f - luminance(clear), min_alpha);
  // What blends mirrors by as much less. As a metal it mirrors as much more.
  pane.metallic = 1.0f;
  pane.base_colour = mirrored / pane.alpha + tint_light * (clear - std::min({clear.x, clear.y, clear.z}));
  pane.base_colour_texture = pane.surface_texture = no_index;
  pane.alpha_mode = Alpha::blend;
  pane.is_double_sided = true;
  return pane;
}

std::set<std::string> settle_glass(Model& model) {
  divide_glass(model);
  std::set<std::string> names;
  Panes panes;
  for (const GlassPiece& piece : glass_pieces(model)) {
    if (piece.is_closed) continue;
    for (const auto& [index, triangles] : piece.triangles) {
      Part& part = model.parts[index];
      names.insert(part.object.empty() ? model.materials[std::size_t(part.material)].name : part.object);
      part.material = pane_for(model, part.material, panes);
    }
  }
  return names;
}

}  // namespace parvis::scene
