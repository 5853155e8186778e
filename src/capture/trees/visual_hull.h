// The box and the cells that may hold the tree (003_d5b01da2d2f805f6, section 4.5.1): a cell whose projection
// shows no alpha in one photograph is empty, whatever the others show.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "base/result.h"
#include "capture/trees/cell_grid.h"

namespace parvis::trees {

/// The alpha of any rectangle of a view, from a summed-area table (Crow 1984). Pictures up to 16 megapixels.
class Silhouette {
 public:
  /// The silhouette of a view's alpha.
  explicit Silhouette(const TreeView& view);

  /// Could the box show alpha in this view? Beyond the picture's edge there is no tree, unless the matte is
  /// cut off by that edge: of what such a view does not show it knows nothing. True, too, where the box
  /// reaches behind the camera.
  bool may_show(const Bounds& box) const;
  /// Mean alpha over the rectangle that the box projects to, 0..1; 1 where the view cannot say.
  float mean_alpha(const Bounds& box) const;
  /// No alpha at all?
  bool is_empty() const { return sums_.back() == 0; }
  const Pinhole& camera() const { return camera_; }  ///< of the view

 private:
  struct Rectangle {
    glm::ivec2 low, high;  // pixels, high excluded
    bool is_known;         // else the view cannot say
  };
  Rectangle rectangle(const Bounds& box) const;
  std::uint32_t sum(glm::ivec2 low, glm::ivec2 high) const;  // of alpha, 0..255 per pixel

  Pinhole camera_;
  bool is_cut_off_ = false;          // the tree reaches the picture's edge
  std::vector<std::uint32_t> sums_;  // (width + 1) x (height + 1)
};

/// How finely the hull is divided.
struct GridOptions {
  int branching = 3;  ///< 3: the thesis's 3x3x3; 2: an octree
  int level = 4;      ///< the side is branching^level
};

/// The silhouette of each view.
std::vector<Silhouette> silhouettes(std::span<const TreeView> views);

/// The smallest box around the visual hull, to 1 % of its size. Errors: fewer than three views; a view
/// without tree; no point that all views show (cameras that do not belong together).
Result<Bounds> hull_box(std::span<const TreeView> views, std::span<const Silhouette> silhouettes);

/// The recursive grid of the hull: cells that no view shows as empty, down to the options' level. Errors:
/// cameras inside of the box; a side above max_grid_side.
Result<CellGrid> hull_grid(std::span<const TreeView> views, std::span<const Silhouette> silhouettes,
                           const Bounds& box, const GridOptions& options);

/// Views whose silhouette contradicts the others', by index: without any one of them all others agree. Of one
/// wrong camera among twenty the list names that one; empty where all agree.
std::vector<std::size_t> inconsistent_views(std::span<const TreeView> views,
                                            std::span<const Silhouette> silhouettes);

}  // namespace parvis::trees
