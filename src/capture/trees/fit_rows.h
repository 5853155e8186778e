// The photographs as a volume is fitted to them: of each one a process holds only the rows whose rays it
// casts, for in linear light they take four times the memory of the pictures.
#pragma once

#include "base/image.h"
#include "capture/trees/tree_view.h"
#include "machines/processes.h"

namespace parvis::trees {

/// One process's rows of a photograph that is reduced by a factor: dealt out to the processes in turn, from
/// the top.
struct FitRows {
  Pinhole camera;            ///< of the whole photograph, reduced
  ImageF rgba;               ///< the rows: premultiplied linear light
  int first = 0, apart = 1;  ///< the rows' places in the photograph

  /// The rows of a view.
  static FitRows of(const TreeView& view, int factor, const machines::Processes& processes);
  /// Where the i-th of them lies in the photograph.
  int row(int i) const { return first + i * apart; }
};

}  // namespace parvis::trees
