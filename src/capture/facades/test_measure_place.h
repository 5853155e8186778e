// How well a captured place shows photographs that were held out, beside its baselines, and what it costs.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "capture/facades/packed_facade.h"
#include "capture/facades/shown_colours.h"
#include "capture/photographs/photograph.h"

namespace parvis::facades {

/// Means over the photographs that were held out.
struct MethodFigures {
  std::string method;  ///< "layers", or a baseline's name
  double psnr_cc_db = 0.0, rephoto = 0.0;
  /// The pixels with a colour of photographs, which alone are judged, among those that show the model as it
  /// was given: of the layers proposed colours (surface_colours.h) do not count.
  double covered_percent = 0.0;
};

/// Figures of one place for the bench `facades`.
struct PlaceFigures {
  std::vector<MethodFigures> methods;  ///< the layers first
  MethodFigures exchanged;  ///< a control: the layers judged by another photograph that was held out (no
                            ///< name: there is one alone)
  double uncovered_percent = 0.0;           ///< a control: what layers cover when no photograph is looked up
  ShownShares filled;                       ///< of the model in random views
  ShownShares unfilled;                     ///< a control: the same with all proposals refused
  double layers_s_per_photo = 0.0;          ///< wall clock, all stages but packing
  double layers_s = 0.0;                    ///< a control: of all photographs together
  double texture_share_percent = 0.0;       ///< of the photographs' RGBA
  double uncompressed_share_percent = 0.0;  ///< a control: of the same without compression
  double texture_over_extracted = 0.0, uncompressed_over_extracted = 0.0;  ///< the latter a control
  double extracted_share_percent = 0.0;  ///< of the extracted texture over the photographs' RGBA
  double own_viewpoint_psnr_db = 0.0;    ///< mean over the photographs, pixels that show the model
  double own_viewpoint_covered_percent = 0.0;
  double aside_viewpoint_psnr_db = 0.0;  ///< a control: the same from 5 % of the way to the next photograph
  std::size_t psd_roundtrip_differing_px = 0;  ///< of the layers of all photographs
  std::size_t psd_changed_px = 0;  ///< a control: one pixel of the first was changed before it was written
  std::shared_ptr<const PackedFacade> facade;  ///< what was judged
  Errors warnings;
};

/// Extent of the measurement.
struct MeasureOptions {
  int random_views = 200;
  bool with_baselines = true;
  bool trims_scans = false;  ///< before layers are made, by the photographs that are not held out
};

/// A place as it is measured: the photographs that it is made of, those that judge it, and its model.
struct JudgedPlace {
  std::vector<photographs::Photograph> used, judges;
  std::vector<NamedMesh> meshes;  ///< trimmed where that was asked for
};
/// Divides the photographs. Fails where one of `held_out` is not there, or a scan cannot be trimmed.
Result<JudgedPlace> judged_place(const std::vector<photographs::Photograph>& photos,
                                 const std::vector<NamedMesh>& meshes,
                                 const std::vector<std::string>& held_out, bool trims_scans);

/// Makes the place without the photographs named in `held_out`, and judges it by them, as it is drawn: with
/// the photographs that are chosen for each view. Fails as judged_place and place_layers do.
Result<PlaceFigures> measured_place(const std::vector<photographs::Photograph>& photos,
                                    const std::vector<NamedMesh>& meshes,
                                    const std::vector<std::string>& held_out,
                                    const MeasureOptions& options = {});

}  // namespace parvis::facades
