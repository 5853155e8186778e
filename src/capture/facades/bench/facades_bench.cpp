#include "capture/facades/bench/facades_bench.h"

#include <filesystem>

#include "base/test_data.h"
#include "bench/benches.h"
#include "capture/facades/bench/bench_places.h"
#include "capture/facades/bench/drawing_bench.h"
#include "capture/facades/bench/filling_bench.h"
#include "capture/facades/measure_place.h"

namespace parvis::bench {
namespace {
namespace fs = std::filesystem;

void tell(const facades::PlaceFigures& figures, const std::string& place, Report& report) {
  for (const facades::MethodFigures& method : figures.methods) {
    const std::string suffix = method.method == "layers" ? "" : "_" + method.method;
    report.add(place + "_psnr_cc_db" + suffix, method.psnr_cc_db);
    report.add(place + "_rephoto" + suffix, method.rephoto);
    report.add(place + "_covered_percent" + suffix, method.covered_percent);
  }
  if (figures.exchanged.method.empty()) return;  // one photograph alone was held out
  const facades::MethodFigures& layers = figures.methods.front();
  report.add(place + "_psnr_cc_db_control_exchanged", figures.exchanged.psnr_cc_db, up_to(layers.psnr_cc_db));
  report.add(place + "_rephoto_control_exchanged", figures.exchanged.rephoto, {layers.rephoto, true});
}

/// Figures that no key of a place belongs to: of the place with photographs of 1416 x 1064.
void tell_costs(const facades::PlaceFigures& figures, Report& report) {
  report.add("filled_percent", figures.filled_percent);
  report.add("filled_percent_with_fallback_colours", figures.coloured_percent);
  report.add("layers_s_per_photo", figures.layers_s_per_photo);
  report.add("texture_share_percent", figures.texture_share_percent);
  report.add("texture_over_extracted", figures.texture_over_extracted);
  report.add("texture_share_percent_extracted", figures.extracted_share_percent);
  report.add("psd_roundtrip_differing_px", double(figures.psd_roundtrip_differing_px));
  report.add("psd_roundtrip_differing_px_control_changed", double(figures.psd_changed_px));
  report.add("own_viewpoint_psnr_db", figures.own_viewpoint_psnr_db);
  report.add("own_viewpoint_covered_percent", figures.own_viewpoint_covered_percent);
  report.add("own_viewpoint_psnr_db_control_aside", figures.aside_viewpoint_psnr_db);
}

Status measure_place(const std::string& name, const std::string& data,
                     Result<BenchPlace> (*load)(const fs::path&, bool), bool is_quick, Report& report) {
  const auto folder = shared_data(data, fs::current_path());
  if (!folder) {
    report.skip(name + "_psnr_cc_db", "the shared photographs are absent");
    return Done{};
  }
  const Result<BenchPlace> place = load(*folder, is_quick);
  if (!place) return place.errors();
  constexpr int random_views = 200;  // they take seconds
  const facades::MeasureOptions options{random_views, true, place->is_scan};
  const Result<facades::PlaceFigures> figures =
      facades::measured_place(place->photographs, place->meshes, place->held_out, options);
  if (!figures) return figures.errors();
  tell(*figures, name, report);
  if (name != "sceaux") return Done{};
  tell_costs(*figures, report);
  const photographs::Photograph& middle = place->photographs[place->photographs.size() / 2];
  return measure_drawing(figures->facade, photographs::camera_of(middle), is_quick, report);
}

Status measure_sceaux(const BenchSetup& setup, Report& report) {
  return measure_place("sceaux", "photos_sceaux", sceaux, setup.is_quick, report);
}
Status measure_courtyard(const BenchSetup& setup, Report& report) {
  return measure_place("courtyard", "photos_castle_p30", courtyard, setup.is_quick, report);
}
Status measure_drawings(const BenchSetup& setup, Report& report) {
  const auto folder = shared_data("photos_sceaux", fs::current_path());
  if (!folder) {
    report.skip("draw_over_plain_texture_time", "the shared photographs are absent");
    return Done{};
  }
  const Result<BenchPlace> place = sceaux(*folder, setup.is_quick);
  if (!place) return place.errors();
  const Result<facades::PlaceLayers> layers = facades::place_layers(place->photographs, place->meshes);
  if (!layers) return layers.errors();
  const photographs::Photograph& middle = place->photographs[place->photographs.size() / 2];
  return measure_drawing(std::make_shared<const facades::PackedFacade>(facades::packed_facade(*layers)),
                         photographs::camera_of(middle), setup.is_quick, report);
}

Status measure_fillings(const BenchSetup& setup, Report& report) {
  return measure_filling(setup.is_quick, report);
}

Status measure_all(const BenchSetup& setup, Report& report) {
  for (const auto part : {measure_sceaux, measure_courtyard, measure_fillings})
    if (Status status = part(setup, report); !status) return status.errors();
  return Done{};
}

}  // namespace

void furnish_facades(House& house) {
  Benches& benches = house.get<Benches>();
  benches.add({"facades", "captured places against photographs that were held out, beside their baselines",
               measure_all});
  benches.add({"facades_sceaux", "of `facades`: the castle alone, with times of drawing", measure_sceaux});
  benches.add({"facades_courtyard", "of `facades`: the courtyard alone", measure_courtyard});
  benches.add({"facades_filling", "of `facades`: filling of a texture that is known", measure_fillings});
  benches.add({"facades_drawing", "of `facades`: times of drawing alone", measure_drawings});
}

}  // namespace parvis::bench
