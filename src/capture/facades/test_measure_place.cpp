#include "capture/facades/test_measure_place.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include "base/colour.h"
#include "base/image_io.h"
#include "capture/facades/baselines.h"
#include "capture/facades/held_out.h"
#include "capture/facades/packed_facade.h"
#include "capture/facades/rephotography.h"
#include "capture/facades/scan_trim.h"
#include "capture/facades/shown_colours.h"

namespace parvis::facades {
namespace {

using photographs::Photograph;

void add(MethodFigures& figures, const Rephotography& judged, double share) {
  figures.psnr_cc_db += share * judged.psnr_cc_db, figures.rephoto += share * judged.error;
  figures.covered_percent += share * judged.covered_percent;
}

/// The facade without any photograph: colours proposed for unseen parts are left.
PackedFacade without_photographs(PackedFacade facade) {
  for (glm::uvec2& list : facade.lists) list.y = 0;
  return facade;
}

/// `given`: the model before it was trimmed, so that what was cut off lacks in what is covered.
Status judge_held_out(const std::vector<Photograph>& held_out, const LayerModel& given,
                      const PlaceLayers& place, DrawnFacade& facade,
                      const std::vector<PreparedPhoto>& prepared, bool with_baselines,
                      PlaceFigures& figures) {
  std::vector<Image8> truths;
  for (const Photograph& photo : held_out) {
    Result<Image8> truth = read_image8(photo.file);
    if (!truth) return truth.errors();
    truths.push_back(*std::move(truth));
  }
  figures.methods.push_back({"layers"});
  if (with_baselines)
    for (const BaselineMethod method : baseline_methods) figures.methods.push_back({name_of(method)});
  const double share = 1.0 / double(held_out.size());
  ShownColours colours(*figures.facade), bare(without_photographs(*figures.facade));
  if (held_out.size() > 1) figures.exchanged.method = "control_exchanged";
  for (std::size_t i = 0; i < held_out.size(); ++i) {
    const Image8 &truth = truths[i], &another = truths[(i + 1) % truths.size()];
    const Result<View> view = view_of(held_out[i]);
    if (!view) return view.errors();
    const Image8 mask = model_mask(given, *view);
    const Image8 shown = coloured_by_layers(rgba8_of(facade.view(*view)), colours.sources(*view));
    add(figures.methods[0], rephotography(shown, truth, mask), share);
    figures.uncovered_percent +=
        share * rephotography(coloured_by_layers(shown, bare.sources(*view)), truth, mask).covered_percent;
    if (held_out.size() > 1 && another.width == shown.width && another.height == shown.height)
      add(figures.exchanged, rephotography(shown, another, mask), share);
    for (std::size_t m = 1; m < figures.methods.size(); ++m) {
      const ImageF picture = baseline_view(baseline_methods[m - 1], place.model, *view, prepared);
      add(figures.methods[m], rephotography(srgb8_from_linear(picture), truth, mask), share);
    }
  }
  return Ok{};
}

Status judge_own_viewpoints(const std::vector<Photograph>& photos, const PlaceLayers& place,
                            DrawnFacade& facade, PlaceFigures& figures) {
  const double share = 1.0 / double(place.names.size());
  for (std::size_t i = 0; i < place.names.size(); ++i) {
    const auto photo = std::ranges::find(photos, place.names[i], &Photograph::name);
    const Result<Image8> truth = read_image8(photo->file);
    if (!truth) return truth.errors();
    const Image8 mask = model_mask(place.model, place.views[i]);
    const Rephotography judged = rephotography(rgba8_of(facade.view(place.views[i])), *truth, mask);
    figures.own_viewpoint_psnr_db += share * judged.psnr_db;
    figures.own_viewpoint_covered_percent += share * judged.covered_percent;
    View aside = place.views[i];  // the control: where the photograph does not count as its own viewpoint
    aside.centre = glm::mix(aside.centre, place.views[(i + 1) % place.views.size()].centre, 0.05);
    figures.aside_viewpoint_psnr_db +=
        share * rephotography(rgba8_of(facade.view(aside)), *truth, mask).psnr_db;
  }
  return Ok{};
}

/// The place with all that was proposed refused, as a control: filling is switched off.
PackedFacade unfilled_facade(PlaceLayers place) {
  for (Filled& filled : place.filled)
    for (Filling& state : filled.states)
      if (state != Filling::none) state = Filling::refused;
  std::ranges::fill(place.surfaces, Filling::refused);
  return packed_facade(place);
}

/// `place` is used up.
void judge_random_views(PlaceLayers place, const PackedFacade& facade, int count, PlaceFigures& figures) {
  const std::vector<View> views = random_views(place.views, count);
  figures.filled = shown_shares(facade, views);
  figures.unfilled = shown_shares(unfilled_facade(std::move(place)), views);
}

/// Bytes of its textures and tables without compression, at 4 bytes per texel.
double uncompressed_bytes(const PackedFacade& facade) {
  constexpr double texel_bytes_of_block = 4.0 * 16.0;
  return double(facade.texture_bytes()) +
         double(facade.blocks.size()) * (texel_bytes_of_block - double(bc7_block_bytes));
}

/// One value of one pixel that has some alpha, changed.
void change_pixel(LayerPixels& pixels) {
  for (Image8& layer : pixels)
    for (std::size_t p = 0; p < layer.pixels.size(); p += 4)
      if (layer.pixels[p + 3] > 0) {
        layer.pixels[p] ^= 1;
        return;
      }
}

/// Pixels of a photograph's layers that differ once they were written as a layered picture and read again;
/// `is_changed`: one pixel was changed before, as a control.
Result<std::size_t> roundtrip_differences(const PlaceLayers& place, std::size_t photo, bool is_changed) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() /
      fmt::format("parvis_layers_{}.psd", std::chrono::steady_clock::now().time_since_epoch().count());
  Image8 picture(place.views[photo].width, place.views[photo].height, 4, 255);
  const LayerPixels pixels = chosen_pixels(place.filled[photo], place.originals[photo]);
  LayerPixels written_pixels = pixels;
  if (is_changed) change_pixel(written_pixels);
  const PsdPicture psd = layered_picture(picture, place.layered[photo], written_pixels,
                                         item_buffer(place.model, place.views[photo]).depths);
  const Status written = write_psd(file, psd);
  if (!written) return written.errors();
  const Result<PsdPicture> back = read_psd(file);
  std::error_code code;
  std::filesystem::remove(file, code);
  if (!back) return back.errors();
  LayerPixels blank;
  for (const Image8& layer : pixels) blank.emplace_back(layer.width, layer.height, 4);
  const Result<ReadLayers> read = read_layers(*back, place.layered[photo], blank, place.views[photo].width,
                                              place.views[photo].height, file.string());
  if (!read) return read.errors();
  std::size_t differing = 0;
  for (std::size_t l = 0; l < pixels.size(); ++l)
    for (std::size_t p = 0; p < pixels[l].pixels.size(); p += 4)
      differing += !std::equal(pixels[l].pixels.begin() + std::ptrdiff_t(p),
                               pixels[l].pixels.begin() + std::ptrdiff_t(p + 4),
                               read->pixels[l].pixels.begin() + std::ptrdiff_t(p));
  return differing;
}

Status judge_roundtrips(const PlaceLayers& place, PlaceFigures& figures) {
  for (std::size_t i = 0; i < place.names.size(); ++i) {
    const Result<std::size_t> differing = roundtrip_differences(place, i, false);
    if (!differing) return differing.errors();
    figures.psd_roundtrip_differing_px += *differing;
  }
  const Result<std::size_t> changed = roundtrip_differences(place, 0, true);
  if (!changed) return changed.errors();
  figures.psd_changed_px = *changed;
  return Ok{};
}

}  // namespace

Result<JudgedPlace> judged_place(const std::vector<Photograph>& photos, const std::vector<NamedMesh>& meshes,
                                 const std::vector<std::string>& held_out, bool trims_scans) {
  JudgedPlace judged;
  for (const Photograph& photo : photos)
    (std::ranges::count(held_out, photo.name) > 0 ? judged.judges : judged.used).push_back(photo);
  if (judged.judges.size() != held_out.size() || judged.judges.empty())
    return error("of {} photographs to hold out only {} are there", held_out.size(), judged.judges.size());
  judged.meshes = meshes;
  if (!trims_scans) return judged;
  Result<TrimmedScans> trimmed = trimmed_scans(meshes, judged.used);
  if (!trimmed) return trimmed.errors();
  judged.meshes = std::move(trimmed->meshes);
  return judged;
}

Result<PlaceFigures> measured_place(const std::vector<Photograph>& photos,
                                    const std::vector<NamedMesh>& meshes,
                                    const std::vector<std::string>& held_out, const MeasureOptions& options) {
  const Result<JudgedPlace> judged = judged_place(photos, meshes, held_out, options.trims_scans);
  if (!judged) return judged.errors();
  const Result<LayerModelResult> given = layer_model(meshes);
  if (!given) return given.errors();
  PlaceFigures figures;
  const auto begin = std::chrono::steady_clock::now();
  Result<PlaceLayers> place = place_layers(judged->used, judged->meshes);
  if (!place) return place.errors();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  figures.layers_s = took.count();
  figures.layers_s_per_photo = took.count() / double(place->names.size());
  figures.warnings = place->warnings;
  figures.facade = std::make_shared<const PackedFacade>(packed_facade(*place));
  const PackedFacade& facade = *figures.facade;
  const double photograph_bytes = double(facade.photograph_bytes()),
               uncompressed = uncompressed_bytes(facade);
  figures.texture_share_percent = 100.0 * double(facade.texture_bytes()) / photograph_bytes;
  figures.uncompressed_share_percent = 100.0 * uncompressed / photograph_bytes;

  const std::vector<PreparedPhoto> prepared = prepared_as_layers(judged->used, *place);
  const double extracted = double(std::max<std::size_t>(extracted_texture_bytes(place->model, prepared), 1));
  figures.texture_over_extracted = double(facade.texture_bytes()) / extracted;
  figures.uncompressed_over_extracted = uncompressed / extracted;
  figures.extracted_share_percent = 100.0 * extracted / photograph_bytes;
  DrawnFacade drawn(facade);
  if (Status status = judge_held_out(judged->judges, given->model, *place, drawn, prepared,
                                     options.with_baselines, figures);
      !status)
    return status.errors();
  if (Status status = judge_own_viewpoints(judged->used, *place, drawn, figures); !status)
    return status.errors();
  if (Status status = judge_roundtrips(*place, figures); !status) return status.errors();
  judge_random_views(*std::move(place), facade, options.random_views, figures);
  return figures;
}

}  // namespace parvis::facades
