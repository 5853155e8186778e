// A packed facade as it is drawn, on the CPU: for measurements.
#pragma once

#include "capture/facades/facade_lookup.h"
#include "capture/facades/item_buffer.h"
#include "capture/facades/packed_facade.h"
#include "capture/facades/view_choice.h"

namespace parvis::facades {

/// A view compares the photographs alone that are chosen for its eye. The facade must outlive it.
class DrawnFacade {
 public:
  explicit DrawnFacade(const PackedFacade& facade);
  /// sRGB and alpha; alpha 0 where there is no model.
  ImageF view(const View& view) { return this->view(view, item_buffer(model_, view)); }
  /// The same; `seen` is what the view sees of `model()`.
  ImageF view(const View& view, const ItemBuffer& seen);
  const LayerModel& model() const { return model_; }

 private:
  const PackedFacade& facade_;
  LayerModel model_;
  FacadeTexels texels_;
  ViewChooser chooser_;
  PackedFacade drawn_;
};

}  // namespace parvis::facades
