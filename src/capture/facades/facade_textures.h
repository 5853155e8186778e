// A packed facade in graphics memory.
#pragma once

#include <memory>

#include "base/result.h"
#include "capture/facades/packed_facade.h"
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
  /// Takes a choice over.
  void set(const ViewChoice& choice);

 private:
  friend class FacadeTextures;
  gl::Buffer lists_;  ///< per corner
  gl::VertexArray vertices_;
  gl::Texture candidates_;
  std::size_t own_candidates_ = 0, first_chosen_ = 0;  ///< in the texture the chosen ones begin a new row
};

/// Geometry, tables and textures of one facade. Needs a current OpenGL 4.5 context as long as it lives.
class FacadeTextures {
 public:
  /// Fails where the facade has more textures or longer tables than the graphics hardware holds.
  static Result<FacadeTextures> create(const PackedFacade& facade,
                                       HeldTexels held = HeldTexels::for_renderer);
  /// Whether graphics memory holds tiles as blocks, as OpenGL says.
  bool holds_blocks() const;

  /// Room for the choice of one viewpoint.
  ChosenLists chosen_lists() const;
  /// Binds all to the units of drawables, and sets the samplers of `program`.
  void bind(const gl::Program& program, const ChosenLists& lists) const;
  /// Draws a run of triangles with what is bound.
  void draw(std::size_t first_triangle, std::size_t triangles) const;

 private:
  gl::Buffer corners_;
  gl::Texture photos_, layers_, tiles_, depths_, atlas_;
  std::vector<std::uint32_t> candidates_;
  std::size_t triangles_ = 0;
};

}  // namespace parvis::facades
