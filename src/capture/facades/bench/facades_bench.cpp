#include "capture/facades/bench/facades_bench.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/test_data.h"
#include "bench/benches.h"
#include "capture/facades/coarse_model.h"
#include "capture/facades/facade_drawable.h"
#include "capture/facades/measure_place.h"
#include "capture/facades/place_folder.h"
#include "capture/facades/placed_facade.h"
#include "capture/photographs/alignment.h"
#include "capture/photographs/camera_files.h"
#include "formats/meshes/assimp_reader.h"
#include "graphics/gl/context.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/render/renderer.h"

namespace parvis::bench {
namespace {
namespace fs = std::filesystem;

/// Photographs with a model, and those that judge.
struct Place {
  std::vector<photographs::Photograph> photographs;
  std::vector<facades::NamedMesh> meshes;
  std::vector<std::string> held_out;
};

Result<Place> sceaux_with(const fs::path& folder, const char* mesh) {
  const Result<photographs::LoadedSet> set =
      photographs::read_cameras(folder / "cameras.json", folder / "images");
  if (!set) return set.errors();
  Errors warnings;
  const Result<scene::Model> model = scene::read_with_assimp(folder / mesh, formats::UpAxis::z, warnings);
  if (!model) return model.errors();
  return Place{set->set.photographs, facades::named_meshes(*model), {"00003.jpg", "00007.jpg"}};
}
Result<Place> sceaux(const fs::path& folder) { return sceaux_with(folder, "mesh_refined_175k.ply"); }
/// Of 15,000 triangles, larger than pixels: for timing what pixels cost.
Result<Place> sceaux_of_few_triangles(const fs::path& folder) {
  return sceaux_with(folder, "mesh_coarse_15k.ply");
}

/// The courtyard with a model proposed from its points alone.
Result<Place> courtyard(const fs::path& folder) {
  Result<photographs::LoadedSet> set = photographs::read_cameras(folder / "colmap", folder / "images");
  if (!set) return set.errors();
  photographs::make_z_up(set->set, true);
  const Result<facades::CoarseModel> model = facades::propose_coarse_model(set->set);
  if (!model) return model.errors();
  return Place{
      set->set.photographs, facades::meshes_of(*model), {"0004.jpg", "0011.jpg", "0019.jpg", "0027.jpg"}};
}

void tell(const facades::PlaceFigures& figures, const std::string& place, Report& report) {
  for (const facades::MethodFigures& method : figures.methods) {
    const std::string suffix = method.method == "layers" ? "" : "_" + method.method;
    report.add(place + "_psnr_cc_db" + suffix, method.psnr_cc_db);
    report.add(place + "_rephoto" + suffix, method.rephoto);
    report.add(place + "_covered_percent" + suffix, method.covered_percent);
  }
}

/// Figures that no key of a place belongs to: of the place with photographs of 1416 x 1064.
void tell_costs(const facades::PlaceFigures& figures, Report& report) {
  report.add("filled_percent", figures.filled_percent);
  report.add("filled_percent_by_photographs", figures.from_photographs_percent);
  report.add("layers_s_per_photo", figures.layers_s_per_photo);
  report.add("texture_share_percent", figures.texture_share_percent);
  report.add("texture_over_extracted", figures.texture_over_extracted);
  report.add("psd_roundtrip_differing_px", double(figures.psd_roundtrip_differing_px));
  report.add("own_viewpoint_psnr_db", figures.own_viewpoint_psnr_db);
}

Status measure_place(const std::string& name, const std::string& data, Result<Place> (*load)(const fs::path&),
                     bool is_quick, Report& report) {
  const auto folder = shared_data(data, fs::current_path());
  if (!folder) {
    report.skip(name + "_psnr_cc_db", "the shared photographs are absent");
    return Done{};
  }
  const Result<Place> place = load(*folder);
  if (!place) return place.errors();
  const facades::MeasureOptions options{is_quick ? 40 : 200, true};
  const Result<facades::PlaceFigures> figures =
      facades::measured_place(place->photographs, place->meshes, place->held_out, options);
  if (!figures) return figures.errors();
  tell(*figures, name, report);
  if (name == "sceaux") tell_costs(*figures, report);
  return Done{};
}

/// Time of a main view of `scene`, milliseconds.
class TimedScene {
 public:
  static Result<TimedScene> create(scene::Scene scene, const render::Drawables& drawables) {
    auto held = std::make_unique<scene::Scene>(std::move(scene));
    Result<std::unique_ptr<render::Renderer>> renderer =
        render::Renderer::create(*held, drawables, light::sun_and_sky);
    if (!renderer) return renderer.errors();
    return TimedScene(std::move(held), *std::move(renderer));
  }
  double draw(const Camera& camera) {
    constexpr int width = 640, height = 480;
    renderer_->begin_frame(*scene_, camera);
    renderer_->prepare_main_view(camera, width, height);
    glFinish();
    return milliseconds([&] {
      renderer_->draw_main_view();
      glFinish();
    });
  }

 private:
  TimedScene(std::unique_ptr<scene::Scene> scene, std::unique_ptr<render::Renderer> renderer)
      : scene_(std::move(scene)), renderer_(std::move(renderer)) {}
  std::unique_ptr<scene::Scene> scene_;
  std::unique_ptr<render::Renderer> renderer_;
};

/// The facade's surfaces with one texture on all: an ordinary material, which is lit, too.
scene::Scene plain_scene(const facades::PackedFacade& facade) {
  auto model = std::make_shared<scene::Model>();
  scene::Texture texture{"plain", Image8(1024, 1024, 4, 128), true, true};
  for (std::size_t i = 0; i < texture.image.pixels.size(); ++i)
    texture.image.pixels[i] = std::uint8_t(i * 2654435761u >> 24);
  model->textures.push_back(std::move(texture));
  scene::Material material;
  material.base_colour = glm::vec3(0.0f), material.metallic = 1.0f, material.roughness = 1.0f;
  material.emission = glm::vec3(1.0f), material.emission_texture = 0, material.is_double_sided = true;
  model->materials.push_back(material);
  scene::Part part;
  part.mesh = facades::mesh_of(facade);
  for (std::size_t i = 0; i < part.mesh.uvs.size(); ++i)
    part.mesh.uvs[i] =
        0.2f * glm::vec2(part.mesh.positions[i].x + part.mesh.positions[i].y, part.mesh.positions[i].z);
  model->parts.push_back(std::move(part));
  scene::Scene scene;
  scene::Object object;
  object.name = "plain", object.model = model;
  scene.objects.push_back(std::move(object));
  return scene;
}

Status measure_drawing(bool is_quick, Report& report) {
  const auto folder = shared_data("photos_sceaux", fs::current_path());
  if (!folder) {
    report.skip("draw_over_lit_texture_time", "the shared photographs are absent");
    return Done{};
  }
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  report.note("machine: " + gl::driver_name());
  const Result<Place> place = sceaux_of_few_triangles(*folder);
  if (!place) return place.errors();
  const facades::PlaceSettings settings{false, false, false};
  const Result<facades::PlaceLayers> layers =
      facades::place_layers(place->photographs, place->meshes, settings);
  if (!layers) return layers.errors();
  facades::PlacedFacade placed;
  placed.facade = std::make_shared<const facades::PackedFacade>(facades::packed_facade(*layers));
  const auto timed = [&](facades::Compared compared) {
    render::Drawables drawables;
    drawables.add(facades::facades_kind(compared));
    scene::Scene captured;
    captured.data<scene::ItemsOf<facades::PlacedFacade>>().add(placed, 0);
    drawables.furnish(captured);
    return TimedScene::create(std::move(captured), drawables);
  };
  Result<TimedScene> ours = timed(facades::Compared::chosen), all = timed(facades::Compared::all),
                     plain = TimedScene::create(plain_scene(*placed.facade), {});
  for (const auto* scene : {&ours, &all, &plain})
    if (!*scene) return scene->errors();
  const Camera camera = photographs::camera_of(place->photographs[place->photographs.size() / 2]);
  std::vector<double> ratios, of_all;
  for (int i = 0; i < (is_quick ? 9 : 31); ++i) {
    const double of_plain = plain->draw(camera);
    ratios.push_back(ours->draw(camera) / of_plain);
    of_all.push_back(all->draw(camera) / of_plain);
  }
  report.add("draw_over_lit_texture_time", median(ratios));
  report.add("draw_over_lit_texture_time_all_photographs", median(of_all));
  report.skip("draw_over_plain_texture_time", "no baseline is drawn without light, as facades are");
  return Done{};
}

Status measure(const BenchSetup& setup, Report& report) {
  if (Status status = measure_place("sceaux", "photos_sceaux", sceaux, setup.is_quick, report); !status)
    return status.errors();
  if (Status status = measure_place("courtyard", "photos_castle_p30", courtyard, setup.is_quick, report);
      !status)
    return status.errors();
  return measure_drawing(setup.is_quick, report);
}

}  // namespace

void furnish_facades(House& house) {
  house.get<Benches>().add(
      {"facades", "captured places against photographs that were held out, beside their baselines", measure});
}

}  // namespace parvis::bench
