// What a scene keeps of a facade(...) node.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "base/content_hash.h"
#include "base/mesh.h"
#include "capture/facades/packed_facade.h"
#include "scene/data/room_data.h"
#include "scene/data/traced_scene.h"

namespace parvis::facades {

struct PlacedFacade {
  static constexpr std::string_view name = "facades.facade";
  static constexpr scene::DataRole role = scene::DataRole::static_content;

  std::string called;
  std::filesystem::path file;
  std::shared_ptr<const PackedFacade> facade;
  glm::mat4 world_from_facade{1.0f};
  float brightness = 1.0f;  ///< 1: the display shows the photographs as they are, whatever the exposure
  bool is_visible = true;
  /// The fraction of its light that is left where other things of the scene cast a shadow on it; 1: they cast
  /// none.
  float kept_in_shadow = 1.0f;
  /// Limit of its tiles' graphics memory, bytes: see FacadeTextures. The picture does not depend on it as
  /// long as the nearest photographs fit.
  std::uint64_t max_texture_bytes = std::uint64_t(1) << 30;

  void hash(ContentHash& hash) const;
};

/// Holes come from an artist's alpha: else nothing can be seen through.
bool has_holes(const PackedFacade& facade);

/// Its triangles in their order, each with corners and a normal of its own.
Mesh mesh_of(const PackedFacade& facade);

/// Facades as rays see them: one thing each.
scene::TracedKind traced_facades();

}  // namespace parvis::facades
