#include "capture/facades/measure_place.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include "base/colour.h"
#include "base/image_io.h"
#include "base/random.h"
#include "capture/facades/baselines.h"
#include "capture/facades/facade_lookup.h"
#include "capture/facades/packed_facade.h"
#include "capture/facades/rephotography.h"
#include "capture/facades/scan_trim.h"

namespace parvis::facades {
namespace {

using photographs::Photograph;

/// A view of a facade, which is sRGB already, as bytes.
Image8 bytes_of(const ImageF& srgb) {
  Image8 bytes(srgb.width, srgb.height, 4);
  for (std::size_t i = 0; i < bytes.pixels.size(); ++i)
    bytes.pixels[i] = std::uint8_t(std::lround(255.0f * std::clamp(srgb.pixels[i], 0.0f, 1.0f)));
  return bytes;
}

/// White where a view sees the model.
Image8 model_mask(const LayerModel& model, const View& view) {
  const ItemBuffer seen = item_buffer(model, view);
  Image8 mask(view.width, view.height, 1);
  for (std::size_t i = 0; i < mask.pixels.size(); ++i)
    mask.pixels[i] = seen.triangles[i] == no_triangle_seen ? 0 : 255;
  return mask;
}

void add(MethodFigures& figures, const Rephotography& judged, double share) {
  figures.psnr_cc_db += share * judged.psnr_cc_db, figures.rephoto += share * judged.error;
  figures.covered_percent += share * judged.covered_percent;
}

/// `given`: the model before it was trimmed, so that what was cut off lacks in what is covered.
Status judge_held_out(const std::vector<const Photograph*>& held_out, const LayerModel& given,
                      const PlaceLayers& place, const PackedFacade& facade,
                      const std::vector<PreparedPhoto>& prepared, bool with_baselines,
                      PlaceFigures& figures) {
  const FacadeTexels texels(facade);
  std::vector<Image8> truths;
  for (const Photograph* photo : held_out) {
    Result<Image8> truth = read_image8(photo->file);
    if (!truth) return truth.errors();
    truths.push_back(*std::move(truth));
  }
  figures.methods.push_back({"layers"});
  if (with_baselines)
    for (const BaselineMethod method : baseline_methods) figures.methods.push_back({name_of(method)});
  const double share = 1.0 / double(held_out.size());
  if (held_out.size() > 1) figures.exchanged.method = "control_exchanged";
  for (std::size_t i = 0; i < held_out.size(); ++i) {
    const Image8 &truth = truths[i], &another = truths[(i + 1) % truths.size()];
    const Result<View> view = view_of(*held_out[i]);
    if (!view) return view.errors();
    const Image8 mask = model_mask(given, *view);
    const Image8 shown = bytes_of(view_of_facade(facade, texels, *view));
    add(figures.methods[0], rephotography(shown, truth, mask), share);
    if (held_out.size() > 1 && another.width == shown.width && another.height == shown.height)
      add(figures.exchanged, rephotography(shown, another, mask), share);
    for (std::size_t m = 1; m < figures.methods.size(); ++m) {
      const ImageF picture = baseline_view(baseline_methods[m - 1], place.model, *view, prepared);
      add(figures.methods[m], rephotography(srgb8_from_linear(picture), truth, mask), share);
    }
  }
  return Done{};
}

Status judge_own_viewpoints(const std::vector<Photograph>& photos, const PlaceLayers& place,
                            const PackedFacade& facade, PlaceFigures& figures) {
  const FacadeTexels texels(facade);
  const double share = 1.0 / double(place.names.size());
  for (std::size_t i = 0; i < place.names.size(); ++i) {
    const auto photo = std::ranges::find(photos, place.names[i], &Photograph::name);
    const Result<Image8> truth = read_image8(photo->file);
    if (!truth) return truth.errors();
    const Image8 mask = model_mask(place.model, place.views[i]);
    const Rephotography judged =
        rephotography(bytes_of(view_of_facade(facade, texels, place.views[i])), *truth, mask);
    figures.own_viewpoint_psnr_db += share * judged.psnr_db;
    figures.own_viewpoint_covered_percent += share * judged.covered_percent;
    View aside = place.views[i];  // the control: where the photograph does not count as its own viewpoint
    aside.centre = glm::mix(aside.centre, place.views[(i + 1) % place.views.size()].centre, 0.05);
    figures.aside_viewpoint_psnr_db +=
        share * rephotography(bytes_of(view_of_facade(facade, texels, aside)), *truth, mask).psnr_db;
  }
  return Done{};
}

/// Small views from between the cameras, a little aside, toward what one of them looks at.
View random_view(const PlaceLayers& place, Random& random) {
  constexpr int width = 96, height = 64;
  const auto any = [&] { return std::size_t(random.next() % place.views.size()); };
  const View &a = place.views[any()], &b = place.views[any()], &ahead = place.views[any()];
  View view = ahead;
  view.centre = glm::mix(a.centre, b.centre, double(random.uniform()));
  view.width = width, view.height = height;
  view.fx = view.fy = 0.8 * width, view.cx = 0.5 * width, view.cy = 0.5 * height;
  return view;
}

void judge_random_views(const PlaceLayers& place, const PackedFacade& facade, int count,
                        PlaceFigures& figures) {
  const FacadeTexels texels(facade);
  const LayerModel model = model_of(facade);
  PackedFacade without = facade;  // without candidates only the fallback is left
  Random random(1);
  std::size_t of_model = 0, filled = 0, differing = 0;
  for (glm::uvec2& list : without.lists) list.y = 0;
  for (int i = 0; i < count; ++i) {
    const View view = random_view(place, random);
    const ItemBuffer seen = item_buffer(model, view);
    const ImageF picture = view_of_facade(facade, texels, view, seen),
                 fallback = view_of_facade(without, texels, view, seen);
    for (std::size_t p = 0; p < seen.triangles.size(); ++p) {
      if (seen.triangles[p] == no_triangle_seen) continue;
      ++of_model, filled += picture.pixels[4 * p + 3] > 0.0f;
      differing += !std::equal(picture.pixels.begin() + std::ptrdiff_t(4 * p),
                               picture.pixels.begin() + std::ptrdiff_t(4 * p + 3),
                               fallback.pixels.begin() + std::ptrdiff_t(4 * p));
    }
  }
  if (of_model == 0) return;
  figures.coloured_percent = 100.0 * double(filled) / double(of_model);
  figures.filled_percent = 100.0 * double(differing) / double(of_model);
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

/// Pixels of layers that differ once they were written as a layered picture and read again; `is_changed`: one
/// pixel was changed before, as a control.
Result<std::size_t> roundtrip_differences(const PlaceLayers& place, bool is_changed) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() /
      fmt::format("parvis_layers_{}.psd", std::chrono::steady_clock::now().time_since_epoch().count());
  Image8 picture(place.views[0].width, place.views[0].height, 4, 255);
  const LayerPixels pixels = chosen_pixels(place.filled[0], place.originals[0]);
  LayerPixels written_pixels = pixels;
  if (is_changed) change_pixel(written_pixels);
  const PsdPicture psd = layered_picture(picture, place.layered[0], written_pixels,
                                         item_buffer(place.model, place.views[0]).depths);
  const Status written = write_psd(file, psd);
  if (!written) return written.errors();
  const Result<PsdPicture> back = read_psd(file);
  std::error_code code;
  std::filesystem::remove(file, code);
  if (!back) return back.errors();
  LayerPixels blank;
  for (const Image8& layer : pixels) blank.emplace_back(layer.width, layer.height, 4);
  const Result<ReadLayers> read =
      read_layers(*back, place.layered[0], blank, place.views[0].width, place.views[0].height, file.string());
  if (!read) return read.errors();
  std::size_t differing = 0;
  for (std::size_t l = 0; l < pixels.size(); ++l)
    for (std::size_t p = 0; p < pixels[l].pixels.size(); p += 4)
      differing += !std::equal(pixels[l].pixels.begin() + std::ptrdiff_t(p),
                               pixels[l].pixels.begin() + std::ptrdiff_t(p + 4),
                               read->pixels[l].pixels.begin() + std::ptrdiff_t(p));
  return differing;
}

}  // namespace

Result<PlaceFigures> measured_place(const std::vector<Photograph>& photos,
                                    const std::vector<NamedMesh>& meshes,
                                    const std::vector<std::string>& held_out, const MeasureOptions& options) {
  std::vector<Photograph> used;
  std::vector<const Photograph*> judges;
  for (const Photograph& photo : photos)
    if (std::ranges::count(held_out, photo.name) > 0)
      judges.push_back(&photo);
    else
      used.push_back(photo);
  if (judges.size() != held_out.size() || judges.empty())
    return error("of {} photographs to hold out only {} are there", held_out.size(), judges.size());

  PlaceFigures figures;
  const Result<LayerModelResult> given = layer_model(meshes);
  if (!given) return given.errors();
  std::vector<NamedMesh> of_place = meshes;
  if (options.trims_scans) {
    Result<TrimmedScans> trimmed = trimmed_scans(meshes, used);
    if (!trimmed) return trimmed.errors();
    of_place = std::move(trimmed->meshes);
  }
  const auto begin = std::chrono::steady_clock::now();
  const Result<PlaceLayers> place = place_layers(used, of_place);
  if (!place) return place.errors();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  figures.layers_s_per_photo = took.count() / double(place->names.size());
  figures.warnings = place->warnings;
  figures.facade = std::make_shared<const PackedFacade>(packed_facade(*place));
  const PackedFacade& facade = *figures.facade;
  figures.texture_share_percent = 100.0 * double(facade.texture_bytes()) / double(facade.photograph_bytes());

  std::vector<PreparedPhoto> prepared;
  for (const Photograph& photo : used)
    if (Result<PreparedPhoto> one = prepared_photo(photo, place->model); one)
      prepared.push_back(*std::move(one));
  const double extracted = double(std::max<std::size_t>(extracted_texture_bytes(place->model, prepared), 1));
  figures.texture_over_extracted = double(facade.texture_bytes()) / extracted;
  figures.extracted_share_percent = 100.0 * extracted / double(facade.photograph_bytes());
  if (Status status =
          judge_held_out(judges, given->model, *place, facade, prepared, options.with_baselines, figures);
      !status)
    return status.errors();
  if (Status status = judge_own_viewpoints(used, *place, facade, figures); !status) return status.errors();
  judge_random_views(*place, facade, options.random_views, figures);
  const Result<std::size_t> differing = roundtrip_differences(*place, false),
                            changed = roundtrip_differences(*place, true);
  if (!differing) return differing.errors();
  if (!changed) return changed.errors();
  figures.psd_roundtrip_differing_px = *differing, figures.psd_changed_px = *changed;
  return figures;
}

}  // namespace parvis::facades
