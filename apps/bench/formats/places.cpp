// From bare files to streets: minutes to the first picture, what it shows, gaps in the ground, triangles,
// streets over hills, and faults of places that must be reported.
#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <map>
#include <nlohmann/json.hpp>
#include <osmium/io/pbf_output.hpp>
#include <osmium/io/reader.hpp>
#include <osmium/io/writer.hpp>
#include <osmium/io/xml_input.hpp>

#include "base/files.h"
#include "base/random.h"
#include "base/reduction.h"
#include "base/test_data.h"
#include "bench/formats/planted_faults.h"
#include "bench/parts.h"
#include "formats/city_models/osm_file.h"
#include "formats/readers/readers.h"
#include "graphics/reference/camera_ray.h"
#include "graphics/reference/ray_scene.h"
#include "graphics/shading/tone_curve.h"
#include "land/heights/place_heights.h"
#include "land/roads/paving.h"
#include "land/roads/road_builder.h"
#include "life/vegetation/scene_plant.h"
#include "places/dressing/bare_file.h"
#include "scene/data/surroundings.h"
#include "scene/data/triangle_kinds.h"

namespace parvis::bench {
namespace {
namespace fs = std::filesystem;

constexpr int ground_views = 50;  // of each place

/// Streets for a town of `side` times `side` houses, of which the map holds the first `houses`.
std::string town_xml(int side, int houses) {
  std::string text = "<osm version=\"0.6\">\n", ways;
  int id = 0;
  const auto node = [&](double x, double y) {
    text += fmt::format("<node id=\"{}\" version=\"1\" lat=\"{:.7f}\" lon=\"{:.7f}\"/>\n", ++id,
                        48.0 + y / 111200.0, 11.0 + x / 74600.0);
    return id;
  };
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side && row * side + column < houses; ++column) {
      const double x = 24.0 * column, y = 40.0 * row;
      const int a = node(x, y), b = node(x + 14, y), c = node(x + 14, y + 11), d = node(x, y + 11);
      ways += fmt::format(
          "<way id=\"{}\" version=\"1\"><nd ref=\"{}\"/><nd ref=\"{}\"/><nd ref=\"{}\"/><nd ref=\"{}\"/><nd "
          "ref=\"{}\"/>"
          "<tag k=\"building\" v=\"house\"/><tag k=\"building:levels\" v=\"{}\"/>"
          "<tag k=\"roof:shape\" v=\"gabled\"/></way>\n",
          ++id, a, b, c, d, a, 1 + (row + column) % 3);
    }
  for (int row = 0; row <= side; row += 2) {
    const int from = node(-20.0, 40.0 * row - 9.0), to = node(24.0 * side, 40.0 * row - 9.0);
    ways += fmt::format(
        "<way id=\"{}\" version=\"1\"><nd ref=\"{}\"/><nd ref=\"{}\"/>"
        "<tag k=\"highway\" v=\"residential\"/></way>\n",
        ++id, from, to);
  }
  return text + ways + "</osm>\n";
}

void write_pbf(const fs::path& xml, const fs::path& pbf) {
  try {
    osmium::io::Reader reader(osmium::io::File(xml.string()));
    osmium::io::Writer writer(osmium::io::File(pbf.string()), reader.header(), osmium::io::overwrite::allow);
    while (osmium::memory::Buffer buffer = reader.read()) writer(std::move(buffer));
    writer.close();
  } catch (const std::exception& problem) {
    fail("{}: {}", pbf.string(), problem.what());
  }
}

/// Where somebody stands: on a lane of the place, or, where it has none, anywhere outside of its houses.
glm::vec3 eye_in(const scene::Scene& scene, const scene::PlaceHeights& place, Random& random) {
  constexpr float eye_m = 1.7f;
  const std::vector<scene::Lane>& lanes = scene.roads.lanes;
  if (!lanes.empty()) {
    const scene::Lane& lane = lanes[std::size_t(random.index(int(lanes.size())))];
    const auto at = std::size_t(random.index(int(lane.points.size())));
    return lane.points[at] + glm::vec3(0.0f, 0.0f, eye_m);
  }
  constexpr int max_tries = 1000;
  const scene::GroundGrid& plan = place.heights();
  glm::ivec2 cell(0);
  for (int i = 0; i < max_tries; ++i) {
    cell = {random.index(plan.width), random.index(plan.height)};
    if (!place.built().at(cell.x, cell.y)) break;
  }
  const glm::vec2 spot = plan.centre_of(cell);
  return {spot, place.at(spot) + eye_m};
}

/// False for terrain and for the land around a place.
bool is_of_place(const scene::Scene& scene, const scene::Object& object) {
  return object.name != "terrain" && !scene::surrounds_place(scene, object);
}

/// One channel, 255 where a picture of this size shows the place: neither sky nor the land around it.
Image8 pixels_of_place(const scene::Scene& scene, const Camera& camera, int width, int height) {
  const reference::RayScene rays(scene);
  Image8 shown(width, height, 1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto hit = rays.nearest_hit(reference::camera_ray(camera, width, height, glm::vec2(x, y) + 0.5f));
      if (!hit) continue;
      const auto object = std::size_t(hit->place->object);
      if (object >= scene.objects.size() || is_of_place(scene, scene.objects[object])) *shown.at(x, y) = 255;
    }
  return shown;
}

/// FLIP of a drawn picture, and of a black one, against the ray tracer's, over the pixels that show the
/// place, at an eighth of its size.
std::pair<double, double> flip_to_traced(stage::Stage& stage, const Camera& camera, const Image8& picture) {
  constexpr int coarser = 8, samples_per_pixel = 8;
  const Image8 drawn = reduced(picture, coarser);
  const Image8 place = pixels_of_place(stage.scene(), camera, drawn.width, drawn.height);
  const reference::TracedPicture traced = stage.trace(camera, drawn.width, drawn.height, samples_per_pixel);
  const Image8 expected = shading::tone_mapped_picture(traced.radiance, stage.scene().exposure);
  return {flip_between(drawn, expected, place),
          flip_between(Image8(drawn.width, drawn.height, 3), expected, place)};
}

/// Pixels of the lower halves of street views that show no ground within a camera's far plane, per cent.
double gap_percent(const scene::Scene& scene, const Camera& street) {
  constexpr int width = 64, height = 36;
  const reference::RayScene rays(scene);
  const scene::PlaceHeights place(scene, {}, 20.0f);
  Random random(15);
  std::size_t open = 0, all = 0;
  for (int view = 0; view < ground_views; ++view) {
    const glm::vec3 eye = view == 0 ? street.position_in_world() : eye_in(scene, place, random);
    const float heading = 2.0f * 3.14159265f * float(view) / float(ground_views);
    Camera camera = street;
    camera.world_from_camera = look_at(eye, eye + glm::vec3(std::sin(heading), std::cos(heading), 0.0f));
    for (int y = height / 2; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        reference::Ray ray = reference::camera_ray(camera, width, height, glm::vec2(x, y) + 0.5f);
        ray.max_m = camera.far_m;
        ++all, open += !rays.nearest_hit(ray);
      }
  }
  return 100.0 * double(open) / double(all);
}

/// Pixels of a picture that show the place, per cent.
double shown_percent(const scene::Scene& scene, const Camera& camera) {
  const Image8 shown = pixels_of_place(scene, camera, 64, 36);
  return 100.0 * double(std::ranges::count(shown.pixels, 255)) / double(shown.pixels.size());
}

/// The same camera beside the place, turned away from it.
Camera turned_away(const scene::Scene& scene, Camera camera) {
  constexpr float beside_m = 100.0f;
  Bounds bounds;
  for (const scene::Object& object : scene.objects)
    if (is_of_place(scene, object))
      bounds.add(transformed(object.world_from_model, scene::bounds(*object.model)));
  const glm::vec3 eye(glm::vec2(bounds.max) + beside_m, camera.position_in_world().z);
  camera.world_from_camera = look_at(eye, eye + glm::vec3(1.0f, 1.0f, 0.0f));
  return camera;
}

scene::Scene without_plane(scene::Scene scene) {
  std::erase_if(scene.objects, [&](const scene::Object& object) { return !is_of_place(scene, object); });
  return scene;
}

/// Counts of a place's triangles by their kind.
struct TriangleCount {
  double buildings = 0.0;  ///< dressed walls and roofs
  double own = 0.0;        ///< the map, its paving and the terrain around it
  double stored = 0.0;     ///< the same, and each model that is repeated along kerbs once
  double placed = 0.0;     ///< the same, and those once per place
  double plants = 0.0;     ///< full leaves and wood of grown plants, once; they are drawn at levels of detail
};

/// The land around the place is left out: it is the same for all maps.
TriangleCount count_triangles(const scene::Scene& scene, Report& report) {
  TriangleCount count;
  for (const scene::TriangleKind& kind : scene::triangle_kinds(scene)) {
    if (kind.name == "land around") continue;
    count.stored += double(kind.stored), count.placed += double(kind.placed);
    if (kind.objects == 1) count.own += double(kind.stored);
    report.note(fmt::format("  {}: {} triangles, {} in {} places", kind.name, kind.stored, kind.placed,
                            kind.objects));
  }
  count.plants = double(vegetation::plant_triangles(scene).stored);
  for (const scene::Object& object : scene.objects)
    for (const scene::Part& part : object.model->parts)
      if (part.object == "facade" || part.object.starts_with("WallSurface") || part.object == "RoofSurface")
        count.buildings += double(part.mesh.triangle_count());
  return count;
}

/// The worst of all places.
struct Totals {
  std::map<std::string, double> minutes_of;  ///< by kind of file
  double minutes = 0.0, gap = 0.0, gap_without = 100.0, shown = 100.0, shown_away = 0.0;
  double picture_flip = 0.0, black_flip = 1.0;  ///< the greatest, and the lowest of black pictures
  double osm_own = 0.0, osm_stored = 0.0, osm_stored_large = 0.0, osm_placed = 0.0, osm_plants = 0.0;

  /// A map of few houses holds the same stock of cars as a large one: the ratio of large maps stands beside
  /// that of all.
  void add(const TriangleCount& count) {
    constexpr double large_map = 4000.0;  // triangles of buildings
    const auto over = [&](double triangles) { return triangles / std::max(count.buildings, 1.0); };
    osm_stored = std::max(osm_stored, over(count.stored)), osm_own = std::max(osm_own, over(count.own));
    if (count.buildings >= large_map) osm_stored_large = std::max(osm_stored_large, over(count.stored));
    osm_placed = std::max(osm_placed, over(count.placed)),
    osm_plants = std::max(osm_plants, over(count.plants));
  }
};

/// Kind of a model file: "cityjson", "citygml", "osm", "ifc".
std::string kind_of(const fs::path& file) {
  if (file.extension() == ".json") return "cityjson";
  if (file.extension() == ".gml") return "citygml";
  return file.extension().string().substr(1);
}

dressing::WrittenScene scene_of(const fs::path& file, const BenchSetup& setup) {
  return must(
      dressing::write_bare_scene(file, rooms::all_registries().get<formats::Readers>(), setup.folder));
}

void measure_street(const BenchSetup& setup, const fs::path& file, Totals& totals, Report& report) {
  dressing::WrittenScene written;
  std::unique_ptr<stage::Stage> stage;
  Image8 picture;
  const std::clock_t before = std::clock();
  const double minutes = milliseconds([&] {
                           written = scene_of(file, setup);
                           stage = stage_of(setup.simulation(written.script, {&written.data_folder, 1}));
                           stage->draw(must(stage->camera("street")), 1280, 720);
                           picture = stage->picture();
                         }) /
                         60'000.0;
  const double processor_s = double(std::clock() - before) / CLOCKS_PER_SEC;
  totals.minutes = std::max(totals.minutes, minutes);
  double& of_kind = totals.minutes_of[kind_of(file)];
  of_kind = std::max(of_kind, minutes);
  const scene::Scene scene = setup.scene(written.script, {&written.data_folder, 1});
  const Camera street = scene.find_camera("street")->camera;
  const double shown = shown_percent(scene, street), gap = gap_percent(scene, street);
  totals.shown = std::min(totals.shown, shown);
  totals.shown_away = std::max(totals.shown_away, shown_percent(scene, turned_away(scene, street)));
  const auto [flip, black] = flip_to_traced(*stage, street, picture);
  totals.picture_flip = std::max(totals.picture_flip, flip),
  totals.black_flip = std::min(totals.black_flip, black);
  totals.gap = std::max(totals.gap, gap);
  totals.gap_without = std::min(totals.gap_without, gap_percent(without_plane(scene), street));
  report.note(
      fmt::format("{}: {:.2f} min to the picture ({:.2f} s of processor time), {:.0f} % of which show the "
                  "place, there FLIP {:.3f} from the traced one; gaps of {:.3f} %",
                  file.filename().string(), minutes, processor_s, shown, flip, gap));
  if (file.extension() == ".osm") totals.add(count_triangles(scene, report));
}

/// A part of the maps; those that are not there are skipped.
std::vector<fs::path> street_files(const BenchSetup& setup, Report& report) {
  const fs::path town = setup.folder / "town.osm", packed_town = setup.folder / "packed.osm.pbf";
  must(write_file(town, town_xml(setup.is_quick ? 8 : 16, 256)));
  write_pbf(town, packed_town);
  std::vector<fs::path> files{town, packed_town};
  const auto add = [&](const char* name, const std::optional<fs::path>& file) {
    if (file && fs::exists(*file))
      files.push_back(*file);
    else
      report.skip(name, "the file is not there");
  };
  for (const char* name : {"scenes/crossroads.osm", "scenes/canal.osm", "scenes/pavilion.ifc"})
    add(name, fs::current_path() / name);
  for (const char* name :
       {"cities/delft_context.city.json", "cities/DenHaag_01.city.json",
        "cities/zurich_subset_lod2.city.json", "cities/rotterdam_two_buildings_textured/twobuildings_t.json",
        "cities/citygml/lod3_building_v2.gml"})
    add(name, shared_data(name, fs::current_path()));
  return files;
}

/// Height of the hill without any street.
float hill_m(float x, float y) { return 0.03f * x + 1.5f * std::sin(0.02f * x) + 0.02f * y; }

/// A street over a hill with things on it that are no ground, and with a slab on it that would be, were it
/// not hidden, as what stands in another scenario is.
scene::Scene street_with_things(bool shows_slab) {
  scene::Scene scene;
  const auto add = [&](const Mesh& mesh, const scene::Material& material, const char* name) {
    auto model = std::make_shared<scene::Model>();
    model->materials.push_back(material);
    model->parts.emplace_back();
    model->parts.back().mesh = mesh, model->parts.back().object = name;
    scene.objects.emplace_back().model = model;
  };
  const auto sheet = [&](glm::vec2 low, glm::vec2 high, float step_m, float lift_m) {
    Mesh mesh;
    const glm::ivec2 cells(glm::max(glm::round((high - low) / step_m), glm::vec2(1.0f)));
    for (int y = 0; y <= cells.y; ++y)
      for (int x = 0; x <= cells.x; ++x) {
        const glm::vec2 p = low + (high - low) * glm::vec2(x, y) / glm::vec2(cells);
        mesh.positions.emplace_back(p, hill_m(p.x, p.y) + lift_m);
      }
    const std::uint32_t row = std::uint32_t(cells.x) + 1;
    for (std::uint32_t y = 0; y < std::uint32_t(cells.y); ++y)
      for (std::uint32_t x = 0; x + 1 < row; ++x) {
        const std::uint32_t a = y * row + x;
        mesh.indices.insert(mesh.indices.end(), {a, a + 1, a + row, a + 1, a + row + 1, a + row});
      }
    return mesh;
  };
  add(sheet({-30, -60}, {230, 60}, 5.0f, 0.0f), {}, "hill");
  scene::Material leaves;
  leaves.alpha_mode = scene::Alpha::cutout;
  const auto along = [](int first_m, int step_m, const auto& place) {
    for (int x_m = first_m; x_m <= 200; x_m += step_m) place(float(x_m));
  };
  along(0, 17, [&](float x) { add(sheet({x, 3}, {x + 8, 11}, 2.0f, 2.2f), leaves, "crown"); });
  along(5, 23, [&](float x) { add(sheet({x, 1.5f}, {x + 4.5f, 3.3f}, 1.0f, 1.45f), {}, "van"); });
  along(9, 31, [&](float x) { add(sheet({x, -5}, {x + 1.8f, -4.4f}, 0.6f, 0.45f), {}, "bench"); });
  add(sheet({40, -30}, {140, 30}, 5.0f, 1.0f), {}, "slab");
  scene.objects.back().is_visible = shows_slab;
  scene::Road road;
  along(0, 20, [&](float x) { road.path.emplace_back(x, 0.0f, hill_m(x, 0.0f)); });
  scene.roads = *scene::build_road_graph(std::vector{road});
  scene::pave(scene);
  return scene;
}

/// 99th percentile of how far what is paved lies below the bare hill, or above it by more than the layers of
/// asphalt and paint are thick. Where a carriageway has a gap, this is a metre.
double paving_error_m(const scene::Scene& scene) {
  constexpr float thickness_m = 0.07f, half_carriageway_m = 2.5f;
  scene::Scene paving;
  paving.objects.push_back(scene.objects.back());
  const reference::RayScene rays(paving);
  std::vector<double> errors;
  for (int i = 2; i < 398; ++i)
    for (int j = -12; j <= 12; ++j) {
      const float x = 0.5f * float(i), y = 0.5f * float(j);
      const auto hit = rays.nearest_hit({{x, y, 100.0f}, {0.0f, 0.0f, -1.0f}});
      const float above_m = hit ? 100.0f - hit->distance_m - hill_m(x, y) : 1.0f;
      if (hit || std::abs(y) < half_carriageway_m)
        errors.push_back(std::max({-above_m, above_m - thickness_m, 0.0f}));
    }
  return percentile(errors, 0.99);
}

}  // namespace

void measure_streets(const BenchSetup& setup, Report& report) {
  Totals totals;
  for (const fs::path& file : street_files(setup, report)) measure_street(setup, file, totals, report);
  report.add("minutes_to_first_street", totals.minutes);
  for (const auto& [kind, minutes] : totals.minutes_of)
    report.add("minutes_to_first_street_" + kind, minutes);
  report.add("first_street_shown_percent", totals.shown);
  report.add("first_street_shown_percent_turned_away", totals.shown_away);
  report.add("first_street_flip_to_traced", totals.picture_flip);
  report.add("first_street_flip_to_traced_of_black_pictures", totals.black_flip);
  report.add("osm_stored_triangles_over_buildings", totals.osm_stored);
  report.add("osm_stored_triangles_over_buildings_of_large_maps", totals.osm_stored_large);
  report.add("osm_triangles_over_buildings_without_stock", totals.osm_own);
  report.add("osm_triangles_over_buildings", totals.osm_placed);
  report.add("osm_plant_triangles_over_buildings", totals.osm_plants);
  const fs::path lone_file = setup.folder / "lone.osm";
  must(write_file(lone_file, town_xml(16, 1)));
  const TriangleCount lone = count_triangles(setup.scene(scene_of(lone_file, setup).script), report);
  report.add("osm_stored_triangles_over_buildings_of_a_lone_house",
             lone.stored / std::max(lone.buildings, 1.0));
  report.add("osm_triangles_over_buildings_without_stock_of_a_lone_house",
             lone.own / std::max(lone.buildings, 1.0));
  report.add("ground_gap_percent", totals.gap);
  report.add("ground_gap_percent_without_plane", totals.gap_without);
}

void measure_place_files(const BenchSetup& setup, Report& report) {
  report.add("paving_height_error_m", paving_error_m(street_with_things(false)));
  report.add("paving_height_error_m_on_a_slab", paving_error_m(street_with_things(true)));
  measure_planted_faults(setup, report);
  const int repeats = setup.is_quick ? 3 : 9, side = setup.is_quick ? 120 : 250;
  const auto samples_of = [&](const std::function<void()>& read) {
    std::vector<double> ms(std::size_t(repeats), 0.0);
    for (double& sample : ms) sample = milliseconds(read);
    return ms;
  };
  const fs::path xml = setup.folder / "big.osm", pbf = setup.folder / "big.osm.pbf";
  must(write_file(xml, town_xml(side, side * side)));
  write_pbf(xml, pbf);
  Errors warnings;
  std::vector<double> mb_s = samples_of([&] {
    const auto osm = must(scene::read_osm_file(pbf, warnings));
    if (osm.ways.size() < std::size_t(side * side)) fail("{}: houses are missing", pbf.string());
  });
  for (double& sample : mb_s) sample = 1e-3 * double(fs::file_size(pbf)) / sample;
  report.add("pbf_mb_s", median(mb_s));
  const fs::path pavilion = fs::current_path() / "scenes/pavilion.ifc";  // read in a child process as always
  if (!fs::exists(pavilion))
    return report.skip("ifc_load_ms", "scenes/pavilion.ifc is not in the working folder");
  report.add("ifc_load_ms", median(samples_of([&] {
               must(rooms::all_registries().get<formats::Readers>().read(pavilion, {}, warnings));
             })));
}

}  // namespace parvis::bench
