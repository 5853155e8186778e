// Pictures that lie on a place by its coordinates, as aerial ones on terrain: CityGML's GeoreferencedTexture.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace parvis::scene {

/// Maps a point of the plan, in the file's own coordinates, to a place in a picture: 0..1, v down from the
/// top.
struct PlanToPicture {
  glm::dmat2 uv_from_plan{0.0};  ///< about `origin`
  glm::dvec2 origin{0.0}, uv_at_origin{0.0};

  glm::vec2 operator()(const glm::dvec3& in_file) const {
    return glm::vec2(uv_from_plan * (glm::dvec2(in_file) - origin) + uv_at_origin);
  }
};

/// One such picture as the file describes it.
struct GeoreferencedTexture {
  std::string picture;                  ///< its file
  std::vector<std::string> targets;     ///< identifiers (gml:id) of the polygons and surfaces that it covers
  std::optional<PlanToPicture> placed;  ///< by the elements referencePoint and orientation
  /// The same elements where they hold the six numbers of a world file in its order, as some exporters write
  /// them: their matrix mirrors, for rows of pixels run southward.
  std::vector<double> as_world_file;
};

/// Those of a file in CityGML.
std::vector<GeoreferencedTexture> georeferenced_textures(std::string_view xml);

/// Finds out where each lies: by its own elements, which always take precedence (by CityGML's schema), or
/// by a world file beside its picture (aerial.jgw for aerial.jpg: ESRI's six numbers). Those of which neither
/// is there, or whose picture cannot be read, and all where the file's coordinates are no metres or feet,
/// east first (`are_plane`), are left out with one warning at `file`.
std::vector<GeoreferencedTexture> placed_textures(std::vector<GeoreferencedTexture> textures, bool are_plane,
                                                  const std::filesystem::path& file, Errors& warnings);

/// Polygons that lie wholly beside the picture that covers them by its coordinates, for what says where it
/// lies is then probably meant in another way: they show nothing but an edge of the picture.
class BesidePictures {
 public:
  /// Counts a polygon by the places of its corners in the picture; empty: it is not drawn.
  void note(const GeoreferencedTexture& texture, std::span<const glm::vec2> corners_uv);
  /// One warning at `file`, where there are any.
  void report(const std::filesystem::path& file, Errors& warnings) const;

 private:
  std::size_t covered_ = 0, beside_ = 0;
  std::vector<std::string> pictures_;  ///< the first few that have polygons beside them
};

}  // namespace parvis::scene
