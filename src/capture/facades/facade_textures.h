// A packed facade in graphics memory.
#pragma once

#include <memory>

#include "base/result.h"
#include "capture/facades/packed_facade.h"
#include "capture/facades/photo_residency.h"
#include "capture/facades/placed_facade.h"
#include "capture/facades/view_choice.h"
#include "graphics/gl/objects.h"
#include "graphics/gl/program.h"

namespace parvis::facades {

/// How tiles are held in graphics memory.
enum class HeldTexels : std::uint8_t {
  for_renderer,  ///< as suits the renderer: decoded where it draws in software, else as blocks
  blocks,        ///< as they are packed, BC7
  decoded  ///< four bytes per texel: a renderer in software decodes a block for each texel that it reads
};

/// The lists of candidates of one viewpoint, with the vertex array that reads them. Belongs to the
/// FacadeTextures that it was made of.
class ChosenLists {
 public:
  /// Takes a choice over. `tiles`: where each tile of the facade is, as FacadeTextures has it.
  void set(const ViewChoice& choice, std::span<const std::uint32_t> tiles);
  /// Whether any triangle's photographs were chosen once for all its pixels.
  bool has_chosen() const { return !chosen_.triangles.empty(); }
  /// Draws, of a run of triangles, those that were chosen for once (`are_chosen`), or the others, with what
  /// is bound.
  void draw(std::size_t first_triangle, std::size_t triangles, bool are_chosen) const;

 private:
  friend class FacadeTextures;
  void set_triangles(const ViewChoice& choice, std::span<const std::uint32_t> tiles);
  /// Triangles in their order, and where their corners begin in `elements_`.
  struct Part {
    std::vector<std::uint32_t> triangles;
    std::size_t first_element = 0;
  };
  const Part& part(bool are_chosen) const { return are_chosen ? chosen_ : compared_; }
  gl::Buffer corners_, elements_;  ///< ChosenCorner per corner; corners of the chosen triangles, the others'
  Part chosen_, compared_;
  gl::Buffer lists_;  ///< per corner
  gl::VertexArray vertices_;
  gl::Texture candidates_;
  std::size_t own_candidates_ = 0, first_chosen_ = 0;  ///< in the texture the chosen ones begin a new row
};

/// Geometry, tables and textures of one facade. Tiles are in graphics memory as far as a budget has room:
/// those of the photographs nearest to the eye. Needs a current OpenGL 4.5 context as long as it lives; the
/// facade must outlive it.
class FacadeTextures {
 public:
  /// `max_texture_bytes` bounds what the tiles take of graphics memory, rounded up to a page of 1024 x 1024
  /// texels, and to what the largest photograph needs. Fails where the facade has more textures or longer
  /// tables than the graphics hardware holds. No photograph is resident yet.
  static Result<FacadeTextures> create(const PackedFacade& facade, HeldTexels held = HeldTexels::for_renderer,
                                       std::uint64_t max_texture_bytes = PlacedFacade().max_texture_bytes);
  /// Makes the photographs nearest to `eyes` (in the facade's frame) resident. True where that changed any.
  bool follow(std::span<const glm::vec3> eyes);
  /// PackedFacade::tiles with the slots that hold them now; 0 where none does.
  std::span<const std::uint32_t> resident_tiles() const { return resident_tiles_; }
  /// A flag per photograph: 1 where its tiles are in graphics memory.
  const std::vector<char>& resident() const { return residency_.resident(); }
  /// Memory of the tiles as OpenGL has allocated it, bytes.
  std::uint64_t texture_bytes() const;
  /// Whether graphics memory holds tiles as blocks, as OpenGL says.
  bool holds_blocks() const;

  /// Room for the choice of one viewpoint.
  ChosenLists chosen_lists() const;
  /// Binds all to the units of drawables, and sets the samplers of `program`.
  void bind(const gl::Program& program, const ChosenLists& lists) const;
  /// Draws a run of triangles with what is bound.
  void draw(std::size_t first_triangle, std::size_t triangles) const;

 private:
  FacadeTextures(const PackedFacade& facade, bool decodes, PhotoResidency residency)
      : facade_(&facade), decodes_(decodes), residency_(std::move(residency)) {}
  void take_in(std::uint32_t photo);
  void give_up(std::uint32_t photo);
  void upload_tiles(std::uint32_t photo);

  const PackedFacade* facade_;
  bool decodes_;
  PhotoResidency residency_;  ///< in strips
  gl::Buffer corners_;
  gl::Texture photos_, layers_, tiles_, depths_, atlas_;
  std::vector<std::uint32_t> candidates_;
  std::size_t triangles_ = 0;
  std::vector<std::vector<std::uint32_t>> slots_of_photo_;   ///< of the facade, ascending
  std::vector<std::vector<std::uint32_t>> strips_of_photo_;  ///< that hold them; none: not resident
  std::vector<std::uint32_t> free_strips_;
  std::vector<std::uint32_t> resident_tiles_;
};

}  // namespace parvis::facades
