#include "bench/facades/facades_bench.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/test_data.h"
#include "bench/benches.h"
#include "bench/facades/bench_places.h"
#include "bench/facades/drawing_bench.h"
#include "bench/facades/filling_bench.h"
#include "capture/facades/test_measure_place.h"

namespace parvis::bench {
namespace {
namespace fs = std::filesystem;

/// What the issue asks of a place's layers.
struct PlaceTargets {
  Target psnr_cc_db, rephoto;
};
constexpr Target covered_target{90.0, true};

/// Fixed figures of the castle.
PlaceTargets sceaux_targets(const facades::PlaceFigures&) { return {{26.0, true}, up_to(0.20)}; }
/// The best of all baselines.
PlaceTargets courtyard_targets(const facades::PlaceFigures& figures) {
  PlaceTargets best{{0.0, true}, up_to(1.0)};
  for (std::size_t m = 1; m < figures.methods.size(); ++m) {
    best.psnr_cc_db.limit = std::max(best.psnr_cc_db.limit, figures.methods[m].psnr_cc_db);
    best.rephoto.limit = std::min(best.rephoto.limit, figures.methods[m].rephoto);
  }
  return best;
}

/// Baselines that show nothing are beaten by anything.
Status check_baselines(const facades::PlaceFigures& figures) {
  constexpr double min_covered_percent = 50.0;
  for (std::size_t m = 1; m < figures.methods.size(); ++m) {
    const auto& [method, psnr_cc_db, rephoto, covered_percent] = figures.methods[m];
    if (!(covered_percent >= min_covered_percent && std::isfinite(psnr_cc_db + rephoto)))
      return error(
          "{} covers {:.1f} % of the photographs that were held out, with {} dB: nothing is compared", method,
          covered_percent, psnr_cc_db);
  }
  return Done{};
}

void tell(const facades::PlaceFigures& figures, const std::string& place, const PlaceTargets& targets,
          Report& report) {
  const facades::MethodFigures& layers = figures.methods.front();
  report.add(place + "_psnr_cc_db", layers.psnr_cc_db, targets.psnr_cc_db);
  report.add(place + "_rephoto", layers.rephoto, targets.rephoto);
  report.add(place + "_covered_percent", layers.covered_percent, covered_target);
  for (std::size_t m = 1; m < figures.methods.size(); ++m) {
    const facades::MethodFigures& method = figures.methods[m];
    report.add(place + "_psnr_cc_db_" + method.method, method.psnr_cc_db);
    report.add(place + "_rephoto_" + method.method, method.rephoto);
    report.add(place + "_covered_percent_" + method.method, method.covered_percent);
  }
  report.add_control(place + "_covered_percent_control_without_photographs", figures.uncovered_percent,
                     covered_target);
  if (figures.exchanged.method.empty()) return;  // one photograph alone was held out
  report.add_control(place + "_psnr_cc_db_control_exchanged", figures.exchanged.psnr_cc_db,
                     targets.psnr_cc_db);
  report.add_control(place + "_rephoto_control_exchanged", figures.exchanged.rephoto, targets.rephoto);
}

/// What random views show: no pixel of the model is without a colour.
void tell_filled(const facades::PlaceFigures& figures, const std::string& key, Report& report) {
  const Target all{100.0, true};
  report.add(key, figures.filled.filled_percent, all);
  report.add_control(key + "_control_refused", figures.unfilled.filled_percent, all);
  report.add(key + "_by_layers", figures.filled.layered_percent);
}

/// Figures that no key of a place belongs to: of the place with photographs of 1416 x 1064.
void tell_costs(const facades::PlaceFigures& figures, Report& report) {
  const Target layers_s = up_to(10.0), share = up_to(25.0), over_extracted = up_to(0.5), none = up_to(0.0),
               own{45.0, true};
  report.add("layers_s_per_photo", figures.layers_s_per_photo, layers_s);
  report.add_control("layers_s_per_photo_control_all_photographs", figures.layers_s, layers_s);
  report.add("texture_share_percent", figures.texture_share_percent, share);
  report.add_control("texture_share_percent_control_uncompressed", figures.uncompressed_share_percent, share);
  report.add("texture_over_extracted", figures.texture_over_extracted, over_extracted);
  report.add_control("texture_over_extracted_control_uncompressed", figures.uncompressed_over_extracted,
                     over_extracted);
  report.add("texture_share_percent_extracted", figures.extracted_share_percent);
  report.add("psd_roundtrip_differing_px", double(figures.psd_roundtrip_differing_px), none);
  report.add_control("psd_roundtrip_differing_px_control_changed", double(figures.psd_changed_px), none);
  report.add("own_viewpoint_psnr_db", figures.own_viewpoint_psnr_db, own);
  report.add("own_viewpoint_covered_percent", figures.own_viewpoint_covered_percent);
  report.add_control("own_viewpoint_psnr_db_control_aside", figures.aside_viewpoint_psnr_db, own);
}

/// Drawing is timed where the layers are judged: at the first photograph that was held out.
Status measure_drawing_of(std::shared_ptr<const facades::PackedFacade> facade, const BenchPlace& place,
                          bool is_quick, Report& report) {
  const photographs::Photograph& judge =
      *std::ranges::find(place.photographs, place.held_out.front(), &photographs::Photograph::name);
  return measure_drawing(std::move(facade), photographs::camera_of(judge), is_quick, report);
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
  for (const Error& warning : figures->warnings) report.note(warning.message);
  const bool is_sceaux = name == "sceaux";
  tell(*figures, name, is_sceaux ? sceaux_targets(*figures) : courtyard_targets(*figures), report);
  tell_filled(*figures, is_sceaux ? "filled_percent" : name + "_filled_percent", report);
  if (Status status = check_baselines(*figures); !status || !is_sceaux) return status;
  tell_costs(*figures, report);
  return measure_drawing_of(figures->facade, *place, is_quick, report);
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
  // The very layers that `facades_sceaux` judges.
  const Result<facades::JudgedPlace> judged =
      facades::judged_place(place->photographs, place->meshes, place->held_out, place->is_scan);
  if (!judged) return judged.errors();
  const Result<facades::PlaceLayers> layers = facades::place_layers(judged->used, judged->meshes);
  if (!layers) return layers.errors();
  return measure_drawing_of(std::make_shared<const facades::PackedFacade>(facades::packed_facade(*layers)),
                            *place, setup.is_quick, report);
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

void add_facades(Benches& benches) {
  benches.add({"facades", "captured places against photographs that were held out, beside their baselines",
               measure_all});
  benches.add({"facades_sceaux", "of `facades`: the castle alone, with times of drawing", measure_sceaux});
  benches.add({"facades_courtyard", "of `facades`: the courtyard alone", measure_courtyard});
  benches.add({"facades_filling", "of `facades`: filling of a texture that is known", measure_fillings});
  benches.add({"facades_drawing", "of `facades`: times of drawing alone", measure_drawings});
}

}  // namespace parvis::bench
