// Rasteriser of the layer algorithms: all surfaces behind every pixel centre of a view, by depth.
//
// 3.4.1 renders into an item buffer with inverted depth tests and stencil counts. Every one of those passes
// looks at one pixel's stack of items alone, so the stacks are rasterised once, here on the CPU, and the
// passes run over the distinct stacks (visibility_layers.cpp): the same sets, without the depth buffer's
// quantisation and without a read-back per pass.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "capture/facades/layer_model.h"
#include "capture/facades/view.h"

namespace parvis::facades {

/// One surface behind a pixel centre.
struct Fragment {
  double depth = 0.0;          ///< z in the view's frame, world units
  std::uint32_t triangle = 0;  ///< of the model
  bool is_back_face = false;   ///< of a closed object: seen only from inside the body
};

/// Depths that differ by less than this part of the depth are a tie: what positions in 32 bits lose. A tie is
/// decided between the two triangles, the same way at all pixels: first the one whose centroid is on the
/// viewer's side of the other's plane; for coplanar ones the one that comes first in the model.
inline constexpr double depth_tie = 1e-6;

/// Calls `visit(x, y, fragments)` for every pixel with a fragment, nearest first; rows run in parallel, the
/// pixels of one row in order on one thread. Back faces of closed objects are left out unless
/// `with_back_faces`. Triangles are clipped at the view's plane z = 1e-6 of the model's size. A pixel centre
/// on an edge that two triangles share belongs to one of them. `triangles`: those that are drawn; empty: all.
void visit_stacks(const LayerModel& model, const View& view, bool with_back_faces,
                  std::span<const std::uint32_t> triangles,
                  const std::function<void(int x, int y, std::span<const Fragment>)>& visit);

/// May a layer hold the fragment of a pixel's stack? Not a hidden part of the backdrop, nor what a dense
/// object hides of itself.
bool has_layer_pixel(const LayerModel& model, const Fragment& fragment, std::span<const Fragment> stack);

inline constexpr std::uint32_t no_triangle_seen = ~0u;

/// The nearest surface in each pixel of a view.
struct ItemBuffer {
  int width = 0, height = 0;
  std::vector<std::uint32_t> triangles;  ///< per pixel; no_triangle_seen: nothing
  std::vector<float> depths;             ///< per pixel; infinite where nothing is seen

  /// Index of a pixel, from the top left, in both vectors.
  std::size_t index(int x, int y) const { return std::size_t(y) * std::size_t(width) + std::size_t(x); }
};
/// The nearest triangle and its depth in each pixel of a view, without back faces of closed objects.
ItemBuffer item_buffer(const LayerModel& model, const View& view);

/// Name of the closed object that the view's centre lies in, where more than half of the pixels that see
/// anything look at back faces of closed objects first (an index into objects); -1: none.
int object_around(const LayerModel& model, const View& view);

}  // namespace parvis::facades
