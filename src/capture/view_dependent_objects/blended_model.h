// Models of one thing, each textured from another viewpoint, as triangles that know their textures by
// viewpoint: what the thesis's pfVDObject holds (appendix A.1.1).
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "base/bounds.h"
#include "base/content_hash.h"
#include "base/result.h"
#include "scene/data/model.h"

namespace parvis::view_dependent_objects {

/// Viewpoints that one object may have, ten times what the thesis names and more.
inline constexpr std::size_t max_views = 64;
/// Entries of the table: 2 for each triangle and viewpoint.
inline constexpr std::size_t max_entries = 16'000'000;

/// A model and the place, in its own frame, from which its textures were taken.
struct ViewedModel {
  std::shared_ptr<const scene::Model> model;
  glm::vec3 viewpoint{0.0f};
};

/// Triangles of one name, over all models that have it: one pfVDObject of the thesis.
struct Piece {
  std::string name;
  std::size_t first_triangle = 0, triangle_count = 0;
  int views = 0;  ///< models that have it
  int first_entry =
      0;          ///< of BlendedModel::table: a viewpoint per view, then two entries per triangle and view
  Bounds bounds;  ///< in the models' frame
};

/// Triangles that several models have are one; those that are a single model's are seen where that model has
/// half of the weight.
struct BlendedModel {
  std::vector<glm::vec3> corners, normals;  ///< three per triangle, in the models' frame
  std::vector<Piece> pieces;
  /// The table as view_lookup.glsl reads it.
  std::vector<glm::vec4> table;
  std::vector<scene::Texture> pictures;  ///< all of one size
  bool has_holes = false;                ///< alpha cuts out
  /// The fraction of light that shadows leave, as the textures show it, and the luminance in the sun; 0: they
  /// show no shadows (photographs::lit_and_shaded).
  float kept_in_shadows = 1.0f, lit_luminance = 0.0f;

  /// Number of triangles of all pieces.
  std::size_t triangle_count() const { return corners.size() / 3; }
  /// Bounds of all pieces.
  Bounds bounds() const;
  /// Everything that is seen of it.
  void hash(ContentHash& hash) const;
};

/// Sets `kept_in_shadows` and `lit_luminance` from the textures of a model, as each viewpoint has them.
void find_shadows(BlendedModel& model);

/// How models are merged; the names are the thesis's.
struct Merging {
  bool cleans = true;  ///< cleanModels: parts without a texture are left out
  bool merges = true;  ///< mergeModels: parts of one name are one piece; else all of each model is
};

/// The pieces of several models, `table` and pictures. Errors: more than `max_views` models, nothing with a
/// texture, more triangles than the table holds, pictures for which there is no memory.
Result<BlendedModel> blended_model(const std::vector<ViewedModel>& models, const Merging& merging);

}  // namespace parvis::view_dependent_objects
