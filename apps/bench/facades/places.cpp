// Captured places against photographs that were held out, beside their baselines.
#include "bench/facades/places.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/bounds.h"
#include "base/colour.h"
#include "base/image.h"
#include "base/image_io.h"
#include "base/test_data.h"
#include "bench/parts.h"
#include "capture/facades/facade_drawable.h"
#include "capture/facades/layer_model.h"
#include "capture/facades/packed_facade.h"
#include "capture/facades/place_folder.h"
#include "capture/facades/place_model.h"
#include "capture/facades/placed_facade.h"
#include "capture/facades/test_measure_place.h"
#include "capture/photographs/calibrate.h"
#include "capture/photographs/camera_files.h"
#include "capture/photographs/photograph.h"
#include "capture/photographs/picture.h"
#include "formats/meshes/assimp_reader.h"
#include "graphics/gl/context.h"
#include "graphics/gl/objects.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/render/bindings.h"
#include "graphics/render/drawables.h"
#include "graphics/render/renderer.h"
#include "graphics/render/view_programs.h"

namespace parvis::bench {
namespace {
namespace fs = std::filesystem;

/// A captured place as it is measured.
struct BenchPlace {
  std::vector<photographs::Photograph> photographs;
  std::vector<facades::NamedMesh> meshes;
  std::vector<std::string> held_out;
  bool is_scan = false;  ///< its model is trimmed (facades/scan_trim.h)
};

/// The picture, each side `divisor` times as short: means of blocks, encoded.
void write_reduced(const fs::path& from, const fs::path& to, int divisor) {
  const Image8 picture = must(read_image8(from));
  Image8 reduced(picture.width / divisor, picture.height / divisor, 3);
  for (int y = 0; y < reduced.height; ++y)
    for (int x = 0; x < reduced.width; ++x)
      for (int c = 0; c < 3; ++c) {
        int sum = 0;
        for (int k = 0; k < divisor * divisor; ++k)
          sum += picture.at(x * divisor + k % divisor, y * divisor + k / divisor)[c];
        reduced.at(x, y)[c] = std::uint8_t((sum + divisor * divisor / 2) / (divisor * divisor));
      }
  must(write_image(to, reduced));
}

/// Copies of a folder's pictures, without some of them.
void copy_pictures(const fs::path& from, const fs::path& to, const std::vector<std::string>& without,
                   int divisor) {
  std::error_code code;
  fs::create_directories(to, code);
  for (const std::string& name : photographs::picture_names(from)) {
    if (std::ranges::count(without, name) > 0) continue;
    if (divisor > 1) {
      write_reduced(from / name, to / name, divisor);
    } else if (fs::copy_file(from / name, to / name, code); code) {
      fail("{}: cannot be copied ({})", (from / name).string(), code.message());
    }
  }
}

/// The castle with its mesh of 175,000 triangles.
BenchPlace sceaux(const fs::path& folder) {
  const photographs::LoadedSet set =
      must(photographs::read_cameras(folder / "cameras.json", folder / "images"));
  Errors warnings;
  const scene::Model model =
      must(scene::read_with_assimp(folder / "mesh_refined_175k.ply", formats::UpAxis::z, warnings));
  return BenchPlace{set.set.photographs, facades::named_meshes(model), {"00003.jpg", "00007.jpg"}, true};
}

/// The courtyard with the model that `parvis facade model` proposes for the photographs that do not judge;
/// quickly with pictures of half the width and height.
BenchPlace courtyard(const fs::path& folder, const BenchSetup& setup) {
  const std::vector<std::string> held_out{"0004.jpg", "0011.jpg", "0019.jpg", "0027.jpg"};
  const fs::path all = setup.folder / "all";
  photographs::CalibrationJob job;
  job.pictures = setup.folder / "pictures", job.folder = setup.folder / "place";
  job.cameras = fs::absolute(folder / "colmap");
  copy_pictures(folder / "images", all, {}, setup.is_quick ? 2 : 1);
  copy_pictures(all, job.pictures, held_out, 1);
  const photographs::LoadedSet given = must(photographs::read_cameras(folder / "colmap", all));
  const photographs::LoadedSet calibrated = must(photographs::calibrate(job));
  const facades::PlaceModel model = must(facades::propose_place_model(job.folder));
  // Calibration has turned z up; the cameras that judge are turned alike.
  BenchPlace place{given.set.photographs, model.meshes, held_out};
  const photographs::Photograph& turned = calibrated.set.photographs.front();
  const photographs::Photograph* before = photographs::find(given.set, turned.name);
  const glm::dmat4 turn = turned.world_from_camera * glm::inverse(before->world_from_camera);
  for (photographs::Photograph& photograph : place.photographs)
    photograph.world_from_camera = turn * photograph.world_from_camera;
  return place;
}

/// Baselines that show nothing are beaten by anything.
void check_baselines(const facades::PlaceFigures& figures) {
  constexpr double min_covered_percent = 50.0;
  for (std::size_t m = 1; m < figures.methods.size(); ++m) {
    const auto& [method, psnr_cc_db, rephoto, covered_percent] = figures.methods[m];
    if (!(covered_percent >= min_covered_percent && std::isfinite(psnr_cc_db + rephoto)))
      fail("{} covers {:.1f} % of the photographs that were held out, with {} dB: nothing is compared",
           method, covered_percent, psnr_cc_db);
  }
}

/// The targets are fixed for the castle; elsewhere they are the best of all baselines.
void report_place(const facades::PlaceFigures& figures, const std::string& place, Report& report) {
  const bool is_sceaux = place == "sceaux";
  Target psnr = minimum(is_sceaux ? 26.0 : 0.0), rephoto = maximum(is_sceaux ? 0.20 : 1.0);
  for (std::size_t m = 1; m < figures.methods.size(); ++m) {
    const facades::MethodFigures& method = figures.methods[m];
    if (!is_sceaux) {
      psnr.limit = std::max(psnr.limit, method.psnr_cc_db);
      rephoto.limit = std::min(rephoto.limit, method.rephoto);
    }
    report.add(place + "_psnr_cc_db_" + method.method, method.psnr_cc_db);
    report.add(place + "_rephoto_" + method.method, method.rephoto);
    report.add(place + "_covered_percent_" + method.method, method.covered_percent);
  }
  const facades::MethodFigures &layers = figures.methods.front(), &exchanged = figures.exchanged;
  std::vector<std::pair<std::string, double>> psnr_controls, rephoto_controls;
  if (!exchanged.method.empty()) {  // else one photograph alone was held out
    psnr_controls = {{place + "_psnr_cc_db_control_exchanged", exchanged.psnr_cc_db}};
    rephoto_controls = {{place + "_rephoto_control_exchanged", exchanged.rephoto}};
  }
  report.add(place + "_psnr_cc_db", layers.psnr_cc_db, psnr, psnr_controls);
  report.add(place + "_rephoto", layers.rephoto, rephoto, rephoto_controls);
  report.add(place + "_covered_percent", layers.covered_percent, minimum(90.0),
             {{place + "_covered_percent_control_without_photographs", figures.uncovered_percent}});
  // Random views show no pixel of the model without a colour.
  const std::string filled = is_sceaux ? "filled_percent" : place + "_filled_percent";
  report.add(filled, figures.filled.filled_percent, minimum(100.0),
             {{filled + "_control_refused", figures.unfilled.filled_percent}});
  report.add(filled + "_by_layers", figures.filled.layered_percent);
}

/// Reports costs of the place with photographs of 1416 x 1064.
void report_costs(const facades::PlaceFigures& figures, Report& report) {
  for (const auto& [key, value] :
       {std::pair<const char*, double>{"layers_s_per_photo", figures.layers_s_per_photo},
        {"layers_s_per_photo_control_all_photographs", figures.layers_s},
        {"texture_share_percent", figures.texture_share_percent},
        {"texture_share_percent_control_uncompressed", figures.uncompressed_share_percent},
        {"texture_over_extracted", figures.texture_over_extracted},
        {"texture_over_extracted_control_uncompressed", figures.uncompressed_over_extracted},
        {"texture_share_percent_extracted", figures.extracted_share_percent},
        {"psd_roundtrip_differing_px", double(figures.psd_roundtrip_differing_px)},
        {"psd_roundtrip_differing_px_control_changed", double(figures.psd_changed_px)},
        {"own_viewpoint_psnr_db", figures.own_viewpoint_psnr_db},
        {"own_viewpoint_covered_percent", figures.own_viewpoint_covered_percent},
        {"own_viewpoint_psnr_db_control_aside", figures.aside_viewpoint_psnr_db}})
    report.add(key, value);
}

/// The place at the first photograph that was held out.
Camera judging_camera(const BenchPlace& place) {
  return photographs::camera_of(
      *std::ranges::find(place.photographs, place.held_out.front(), &photographs::Photograph::name));
}

std::optional<fs::path> photographs_of(const char* data, const std::string& key, Report& report) {
  auto folder = shared_data(data, fs::current_path());
  if (!folder) report.skip(key, "the shared photographs are absent");
  return folder;
}

facades::PlaceFigures measure_place(const BenchPlace& place, const std::string& name, Report& report) {
  constexpr int random_views = 200;  // they take seconds
  facades::PlaceFigures figures = must(facades::measured_place(
      place.photographs, place.meshes, place.held_out, {random_views, true, place.is_scan}));
  for (const Error& warning : figures.warnings) report.note(warning.message);
  report_place(figures, name, report);
  check_baselines(figures);
  return figures;
}

}  // namespace

void measure_sceaux(const BenchSetup& setup, Report& report) {
  const auto folder = photographs_of("photos_sceaux", "sceaux_psnr_cc_db", report);
  if (!folder) return;
  const BenchPlace place = sceaux(*folder);
  const facades::PlaceFigures figures = measure_place(place, "sceaux", report);
  report_costs(figures, report);
  measure_drawing(figures.facade, judging_camera(place), setup.is_quick, report);
}

void measure_courtyard(const BenchSetup& setup, Report& report) {
  if (const auto folder = photographs_of("photos_castle_p30", "courtyard_psnr_cc_db", report))
    measure_place(courtyard(*folder, setup), "courtyard", report);
}

/// The very layers that `sceaux` judges.
void measure_drawings(const BenchSetup& setup, Report& report) {
  const auto folder = photographs_of("photos_sceaux", "draw_over_plain_texture_time", report);
  if (!folder) return;
  const BenchPlace place = sceaux(*folder);
  const auto judged =
      must(facades::judged_place(place.photographs, place.meshes, place.held_out, place.is_scan));
  const auto layers = must(facades::place_layers(judged.used, judged.meshes));
  measure_drawing(std::make_shared<const facades::PackedFacade>(facades::packed_facade(layers)),
                  judging_camera(place), setup.is_quick, report);
}

}  // namespace parvis::bench
