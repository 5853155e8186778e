// Displays: off-axis pictures against the ray tracer, seams between walls, blending, the cost of five walls,
// walls of five processes, the way of a wand's place into a picture.
#include <chrono>
#include <fstream>
#include <map>
#include <thread>

#include "base/files.h"
#include "base/random.h"
#include "bench/own_program.h"
#include "bench/parts.h"
#include "bench/reflections/judged_method.h"
#include "planning/devices/devices.h"
#include "scene/data/test_scene.h"
#include "stage/walls.h"

namespace parvis::bench {
namespace {

using display::Display, display::Eye, display::Wall, display::WallPicture;

/// A room of five walls, three metres wide: left, front, right, floor and ceiling.
Display room_of_five(int pixels) {
  Display room;
  room.stereo = display::Stereo::side_by_side;
  const auto add = [&](const char* name, glm::dvec3 lower_left, glm::dvec3 lower_right,
                       glm::dvec3 upper_left) {
    Wall wall;
    wall.name = name, wall.pixels = glm::ivec2(2 * pixels, pixels);  // each eye has a half
    wall.lower_left = lower_left, wall.lower_right = lower_right, wall.upper_left = upper_left;
    room.walls.push_back(wall);
  };
  add("left", {-1.5, -1.5, 0}, {-1.5, 1.5, 0}, {-1.5, -1.5, 3});
  add("front", {-1.5, 1.5, 0}, {1.5, 1.5, 0}, {-1.5, 1.5, 3});
  add("right", {1.5, 1.5, 0}, {1.5, -1.5, 0}, {1.5, 1.5, 3});
  add("floor", {-1.5, -1.5, 0}, {1.5, -1.5, 0}, {-1.5, 1.5, 0});
  add("ceiling", {-1.5, 1.5, 3}, {1.5, 1.5, 3}, {-1.5, -1.5, 3});
  return must(display::checked(room, "room"));
}

/// A view in the middle of nothing, whose room is the world but for a place and a turn.
Camera view_of_the_room() {
  Camera view;
  view.world_from_camera = look_at({12.0f, -7.0f, 1.7f}, {20.0f, 9.0f, 1.7f});
  return view;
}

/// Heads that lean about.
std::vector<display::Head> heads(int count) {
  Random random(8);
  std::vector<display::Head> result;
  for (int i = 0; i < count; ++i) {
    const auto aside = [&] { return double(random.uniform(-0.5f, 0.5f)); };
    const double turn = 2.0 * aside();
    result.push_back({{aside(), aside(), 1.6 + 0.5 * aside()}, {std::cos(turn), std::sin(turn), 0.0}});
  }
  return result;
}

/// The middle of what is bright in a picture, within some pixels of `near`; nothing: it is not bright, or
/// reaches the border of that window.
std::optional<glm::dvec2> middle_of_light(const ImageF& picture, glm::dvec2 near, int within) {
  glm::dvec2 sum(0.0);
  double weight = 0.0;
  const int x0 = int(near.x) - within, y0 = int(near.y) - within;
  for (int y = y0; y <= y0 + 2 * within; ++y)
    for (int x = x0; x <= x0 + 2 * within; ++x) {
      if (x < 0 || y < 0 || x >= picture.width || y >= picture.height) return std::nullopt;
      const double light = std::min(double(picture.at(x, y)[0]), 1.0);
      sum += light * glm::dvec2(x + 0.5, y + 0.5), weight += light;
    }
  if (weight < 4.0) return std::nullopt;
  return sum / weight;
}

/// Where a room's point appears in a picture, pixels from its upper left.
glm::dvec2 pixel_of(const WallPicture& picture, glm::dvec3 point) {
  const glm::dvec4 clip = glm::dmat4(picture.clip_from_room) * glm::dvec4(point, 1.0);
  return (glm::dvec2(clip) / clip.w * glm::dvec2(0.5, -0.5) + 0.5) * glm::dvec2(picture.size);
}

/// The ends of the edge that two walls share; nothing where they share none.
std::optional<std::array<glm::dvec3, 2>> shared_edge(const Wall& first, const Wall& second) {
  const auto corners = [](const Wall& wall) {
    return std::array{wall.lower_left, wall.lower_right, wall.lower_right + wall.upper_left - wall.lower_left,
                      wall.upper_left};
  };
  std::vector<glm::dvec3> shared;
  for (const glm::dvec3& corner : corners(first))
    for (const glm::dvec3& other : corners(second))
      if (glm::distance(corner, other) < 1e-6) shared.push_back(corner);
  if (shared.size() != 2) return std::nullopt;
  return std::array{shared[0], shared[1]};
}

/// The middle of the light at a picture's border about a point of an edge, in pixels along the edge from that
/// point; nothing where it is dark there. The light on the border itself follows from the two rows of pixels
/// within.
std::optional<double> light_on_border(const ImageF& drawn, const WallPicture& picture,
                                      const std::array<glm::dvec3, 2>& edge, glm::dvec3 point, int within) {
  const glm::dvec2 at = pixel_of(picture, point),
                   along = pixel_of(picture, edge[1]) - pixel_of(picture, edge[0]);
  const int axis = std::abs(along.x) > std::abs(along.y) ? 0 : 1, across = 1 - axis;
  const bool is_at_end = at[across] > 0.5 * picture.size[across];
  const auto light_at = [&](int place, int row) {
    glm::ivec2 pixel;
    pixel[axis] = place, pixel[across] = is_at_end ? picture.size[across] - 1 - row : row;
    return std::min(double(drawn.at(pixel.x, pixel.y)[0]), 1.0);
  };
  double sum = 0.0, weight = 0.0;
  for (int place = int(at[axis]) - within; place <= int(at[axis]) + within; ++place) {
    if (place < 0 || place >= picture.size[axis]) return std::nullopt;
    const double light = std::max(1.5 * light_at(place, 0) - 0.5 * light_at(place, 1), 0.0);
    sum += light * (place + 0.5 - at[axis]), weight += light;
  }
  if (weight < 2.0) return std::nullopt;
  return sum / weight * (along[axis] < 0.0 ? -1.0 : 1.0);
}

/// Balls that shine across the edges of walls, drawn: how far the middle of their light on an edge is in one
/// wall's picture from where it is in the other's, pixels, the farthest. A ball that one picture shows there
/// alone is as far as light is sought.
struct Seams {
  double of_one_eye = 0.0, of_mixed_eyes = 0.0;  ///< mixed: the left eye's picture beside the right one's
  int balls = 0, compared = 0;                   ///< of one eye: all, and those that both pictures show
};
Seams seams_px(const Display& room, const display::Head& head) {
  constexpr int within = 22;
  const Camera view = view_of_the_room();
  const std::vector<WallPicture> pictures = display::pictures_of(room, head, view);
  const glm::dmat4 from_room = display::world_from_room(room, view);
  const auto points_on = [](const std::array<glm::dvec3, 2>& edge) {
    std::vector<glm::dvec3> points;
    for (const double part : {0.2, 0.4, 0.6, 0.8}) points.push_back(glm::mix(edge[0], edge[1], part));
    return points;
  };
  scene::Scene scene;
  scene::Material shining;
  shining.emission = glm::vec3(1.0f), shining.base_colour = glm::vec3(0.0f);
  for (std::size_t a = 0; a < room.walls.size(); ++a)
    for (std::size_t b = a + 1; b < room.walls.size(); ++b)
      if (const auto edge = shared_edge(room.walls[a], room.walls[b]))
        for (const glm::dvec3& point : points_on(*edge)) {
          constexpr double times_as_far = 20.0;
          const glm::dvec3 place = head.position + times_as_far * (point - head.position);
          const glm::vec3 in_world(glm::dvec3(from_room * glm::dvec4(place, 1.0)));
          scene::add(scene, scene::model_of(scene::sphere(in_world, 0.8f), shining));
        }
  scene.exposure = 1.0f;
  const std::unique_ptr<stage::Stage> stage = stage_of(scene);
  std::vector<render::EyeView> eyes;
  for (const WallPicture& picture : pictures)
    eyes.push_back({picture.camera, picture.size.x, picture.size.y});
  must(stage->draw(eyes));
  std::vector<ImageF> drawn;
  for (std::size_t i = 0; i < eyes.size(); ++i) {
    stage->renderer().select_eye(i);
    drawn.push_back(stage->renderer().read_radiance());
  }
  stage->renderer().select_eye(0);
  Seams seams;
  for (std::size_t a = 0; a < pictures.size(); ++a)
    for (std::size_t b = 0; b < pictures.size(); ++b) {
      if (pictures[a].wall >= pictures[b].wall) continue;
      const auto edge = shared_edge(room.walls[pictures[a].wall], room.walls[pictures[b].wall]);
      if (!edge) continue;
      const bool is_one_eye = pictures[a].eye == pictures[b].eye;
      double& worst = is_one_eye ? seams.of_one_eye : seams.of_mixed_eyes;
      for (const glm::dvec3& point : points_on(*edge)) {
        const auto first = light_on_border(drawn[a], pictures[a], *edge, point, within),
                   second = light_on_border(drawn[b], pictures[b], *edge, point, within);
        seams.balls += is_one_eye, seams.compared += is_one_eye && first && second;
        if (first && second)
          worst = std::max(worst, std::abs(*first - *second));
        else if (first || second)
          worst = std::max(worst, double(within));
      }
    }
  return seams;
}

/// How far the sum of the light of two projectors leaves an even picture, percent. `gamma`: of the
/// projectors; `blended_for`: what the file says of it.
double unevenness_percent(double gamma, double blended_for) {
  double worst = 0.0;
  for (const int level : {255, 180, 110, 60}) {
    Display room;
    for (const double from : {-2.0, -0.6}) {
      Wall wall;
      wall.name.assign(1, from < -1.0 ? 'a' : 'b'), wall.pixels = {1300, 8};
      wall.lower_left = {from, 2.0, 0.0}, wall.lower_right = {from + 2.6, 2.0, 0.0},
      wall.upper_left = {from, 2.0, 1.0};
      room.walls.push_back(wall);
    }
    room.gamma = blended_for;
    room = must(display::checked(room, "room"));
    const std::vector<WallPicture> pictures = display::pictures_of(room, {room.eye}, Camera());
    display::Screens screens = must(display::Screens::create(room, pictures));
    for (std::size_t i = 0; i < 2; ++i) screens.put(i, Image8(1300, 8, 3, std::uint8_t(level)));
    screens.compose(room, pictures);
    const Image8 a = screens.read(0), b = screens.read(1);
    const auto light = [&](int value) { return std::pow(value / 255.0, gamma); };
    constexpr int overlap = 600, smoothed = 8;  // pixels; an eye does not see single ones
    for (int x = 0; x + smoothed <= overlap; ++x) {
      double sum = 0.0;
      for (int i = x; i < x + smoothed; ++i)
        sum += (light(*a.at(700 + i, 4)) + light(*b.at(i, 4))) / smoothed;
      worst = std::max(worst, 100.0 * std::abs(sum / light(level) - 1.0));
    }
  }
  return worst;
}

/// When a process has shown its frames: seconds of the machine's clock.
std::vector<double> shown_at(const std::filesystem::path& file) {
  std::ifstream lines(file);
  std::vector<double> times;
  int frame = 0;
  long long at = 0;
  for (std::string line; std::getline(lines, line);)
    if (std::sscanf(line.c_str(), "%d,%lld", &frame, &at) == 2) times.push_back(1e-9 * double(at));
  if (times.size() < 10) fail("{}: no frames were logged", file.string());
  return times;
}

/// The most frames that one of them is ahead of another at any moment while all run.
double frames_apart(const std::vector<std::vector<double>>& all) {
  double most = 0.0, end = 1e300;
  for (const std::vector<double>& times : all) end = std::min(end, times.back());
  for (const std::vector<double>& times : all)
    for (const double at : times) {
      if (at >= end) continue;
      std::ptrdiff_t least = 1'000'000, greatest = 0;
      for (const std::vector<double>& other : all) {
        const auto shown = std::upper_bound(other.begin(), other.end(), at) - other.begin();
        least = std::min(least, shown), greatest = std::max(greatest, shown);
      }
      most = std::max(most, double(greatest - least));
    }
  return most;
}

constexpr const char* room_scene = "scenes/three_corners_plane.xp";

}  // namespace

void measure_off_axis(const BenchSetup& setup, Report& report) {
  constexpr int pixels = 240, samples = 64;
  const Display room = room_of_five(pixels);
  const Camera view = view_of_the_room();
  const glm::dmat4 from_room = display::world_from_room(room, view);
  double farthest = 0.0, farthest_centred = 0.0;
  int compared = 0;
  const auto leaning = heads(setup.is_quick ? 1 : 4);
  // Balls beyond the walls that shine by themselves, in the dark.
  scene::Scene scene;
  scene::Material shining;
  shining.emission = glm::vec3(1.0f), shining.base_colour = glm::vec3(0.0f);
  std::vector<glm::dvec3> balls;
  Random random(11);
  while (balls.size() < 60) {
    const glm::dvec3 away(random.uniform(-1.0f, 1.0f), random.uniform(-1.0f, 1.0f),
                          random.uniform(-1.0f, 1.0f));
    if (glm::length(away) > 0.3) balls.push_back(glm::dvec3(0, 0, 1.6) + 9.0 * glm::normalize(away));
  }
  for (const glm::dvec3& ball : balls)
    scene::add(scene,
               scene::model_of(scene::sphere(glm::vec3(glm::dvec3(from_room * glm::dvec4(ball, 1.0))), 0.12f),
                               shining));
  scene.exposure = 1.0f;
  const std::unique_ptr<stage::Stage> stage = stage_of(scene);
  for (const display::Head& head : leaning) {
    const std::vector<WallPicture> pictures = display::pictures_of(room, head, view);
    std::vector<render::EyeView> eyes, centred;
    for (const WallPicture& picture : pictures) {
      eyes.push_back({picture.camera, picture.size.x, picture.size.y});
      centred.push_back(eyes.back());
      // The control: as wide, but about the axis.
      const FrustumTangents edges = *picture.camera.off_axis;
      const float right = 0.5f * (edges.right - edges.left), top = 0.5f * (edges.top - edges.bottom);
      centred.back().camera.off_axis = FrustumTangents{-right, right, -top, top};
    }
    const auto drawn_by = [&](const std::vector<render::EyeView>& views) {
      must(stage->draw(views));
      std::vector<ImageF> drawn;
      for (std::size_t i = 0; i < views.size(); ++i) {
        stage->renderer().select_eye(i);
        drawn.push_back(stage->renderer().read_radiance());
      }
      stage->renderer().select_eye(0);
      return drawn;
    };
    const std::vector<ImageF> drawn = drawn_by(eyes), drawn_centred = drawn_by(centred);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      const ImageF traced =
          stage->trace(pictures[i].camera, pictures[i].size.x, pictures[i].size.y, samples).radiance;
      for (const glm::dvec3& ball : balls) {
        constexpr int within = 9;
        const glm::dvec2 near = pixel_of(pictures[i], ball);
        if (glm::dot(ball - head.position, glm::cross(room.walls[pictures[i].wall].lower_right -
                                                          room.walls[pictures[i].wall].lower_left,
                                                      room.walls[pictures[i].wall].upper_left -
                                                          room.walls[pictures[i].wall].lower_left)) >= 0.0)
          continue;
        const auto in_drawn = middle_of_light(drawn[i], near, within),
                   in_traced = middle_of_light(traced, near, within);
        if (!in_drawn || !in_traced) continue;
        ++compared;
        farthest = std::max(farthest, glm::distance(*in_drawn, *in_traced));
        const auto in_centred = middle_of_light(drawn_centred[i], near, within);
        farthest_centred =
            std::max(farthest_centred, in_centred ? glm::distance(*in_centred, *in_traced) : double(within));
      }
    }
  }
  if (compared < 20) fail("only {} balls were compared", compared);
  report.note(fmt::format("{} balls compared", compared));
  report.add("offaxis_error_px", farthest);
  report.add("offaxis_error_px_of_centred_frusta", farthest_centred);

  Seams worst;
  for (const display::Head& head : leaning) {
    const Seams seams = seams_px(room, head);
    worst.of_one_eye = std::max(worst.of_one_eye, seams.of_one_eye);
    worst.of_mixed_eyes = std::max(worst.of_mixed_eyes, seams.of_mixed_eyes);
    worst.balls += seams.balls, worst.compared += seams.compared;
  }
  if (worst.balls == 0 || 10 * worst.compared < 9 * worst.balls)
    fail("only {} of {} balls on edges were compared", worst.compared, worst.balls);
  report.note(fmt::format("{} of {} balls on edges compared", worst.compared, worst.balls));
  report.add("seam_px", worst.of_one_eye);
  report.add("seam_px_of_mixed_eyes", worst.of_mixed_eyes);
}

void measure_blending(const BenchSetup&, Report& report) {
  report.add("blend_flatness_percent", unevenness_percent(2.2, 2.2));
  report.add("blend_flatness_percent_of_another_gamma", unevenness_percent(2.2, 1.8));
}

void measure_walls_cost(const BenchSetup& setup, Report& report) {
  const int pixels = setup.is_quick ? 256 : 512, repeats = setup.is_quick ? 3 : 9;
  Display room = room_of_five(pixels);
  room.stereo = display::Stereo::none;
  for (Wall& wall : room.walls) wall.pixels = glm::ivec2(pixels);
  const std::unique_ptr<stage::Stage> stage = stage_of(setup.simulation(setup.city() / "paper.xp"));
  const Camera view = must(stage->camera("street"));
  const std::vector<WallPicture> pictures = display::pictures_of(room, {room.eye}, view);
  std::vector<render::EyeView> eyes;
  for (const WallPicture& picture : pictures) eyes.push_back({picture.camera, pixels, pixels});
  // One view of as many pixels, through each of the walls in turn.
  const int side = int(std::lround(pixels * std::sqrt(double(eyes.size()))));
  std::vector<double> of_walls, of_views, of_frames;
  for (int i = -1; i < repeats; ++i) {
    const double walls = finished_ms([&] { must(stage->draw(eyes)); });
    double views = 0.0;
    for (const render::EyeView& eye : eyes)
      views += finished_ms([&] { stage->draw(eye.camera, side, side); }) / double(eyes.size());
    const double frames = finished_ms([&] {
      for (const render::EyeView& eye : eyes) stage->draw(eye.camera, side, side);  // the control
    });
    if (i >= 0) of_walls.push_back(walls), of_views.push_back(views), of_frames.push_back(frames);
  }
  report.add("wall_cost_over_view", median(of_walls).value / median(of_views).value);
  report.add("wall_cost_over_view_of_whole_views", median(of_frames).value / median(of_views).value);
  report.note(fmt::format("five walls {:.0f} ms, one view {:.0f} ms", median(of_walls).value,
                          median(of_views).value));
}

void measure_walls_lock(const BenchSetup& setup, Report& report) {
  if (!has_program("mpirun") || !has_program("xvfb-run"))
    return report.skip("walls_lock_frames", "needs mpirun and xvfb-run");
  constexpr const char* screen = "xvfb-run -a -s '-screen 0 2304x1536x24' env LP_NUM_THREADS=1";
  const std::string frames = setup.is_quick ? "60" : "300";
  const auto arguments = [&](const std::string& log) {
    return std::vector<std::string>{"view",     room_scene, "--display",   "scenes/displays/cave.json",
                                    "--frames", frames,     "--frame-log", (setup.folder / log).string()};
  };
  run_own_program(fmt::format("{} mpirun --allow-run-as-root --oversubscribe --bind-to none -n 5", screen),
                  arguments("locked"));
  std::vector<std::vector<double>> locked, free;
  for (int i = 0; i < 5; ++i) locked.push_back(shown_at(setup.folder / fmt::format("locked.{}.csv", i)));
  report.add("walls_lock_frames", frames_apart(locked));
  // The control: a process for each wall, which know nothing of each other; counted from the first frame of
  // each.
  const std::filesystem::path none = setup.folder / "none.json";  // one port is for one process
  must(write_file(none, R"({"parvis_devices": 1, "osc_port": 0, "gamepads": false, "mice_3d": false})"));
  std::vector<std::jthread> processes;
  for (const char* wall : {"left", "front", "right", "floor"})
    processes.emplace_back([&, wall] {
      std::vector<std::string> words = arguments(wall);
      words.insert(words.end(), {"--wall", wall, "--devices", none.string()});
      run_own_program(screen, words);
    });
  processes.clear();
  for (const char* wall : {"left", "front", "right", "floor"}) {
    free.push_back(shown_at(setup.folder / fmt::format("{}.0.csv", wall)));
    const double began = free.back().front();
    for (double& at : free.back()) at -= began;
  }
  report.add("walls_lock_frames_of_processes_by_themselves", frames_apart(free));
}

void measure_wand(const BenchSetup& setup, Report& report) {
  devices::DeviceSettings settings;
  settings.has_gamepads = settings.has_3d_mice = false;
  std::optional<devices::Devices> devices;
  for (settings.osc_port = 23'000; !devices; ++settings.osc_port)
    if (Result<devices::Devices> opened = devices::Devices::open(settings))
      devices.emplace(*std::move(opened));
  sound::Datagrams sender = must(sound::Datagrams::connect(fmt::format("127.0.0.1:{}", devices->osc_port())));
  const Display room = room_of_five(1080);
  const Camera view = view_of_the_room();
  const auto began = std::chrono::steady_clock::now();
  const auto now_s = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  };
  // From the packet to the frusta of its frame; `waits_s`: the frame has begun before it.
  const auto slowest_ms = [&](double waits_s, int packets) {
    double slowest = 0.0;
    for (int i = 0; i < packets; ++i) {
      const double x = 0.2 + 1e-3 * i, sent_s = now_s();
      sender.send(must(
          sound::liblo.call(&sound::LibloFunctions::encode,
                            sound::OscMessage{"/parvis/tracker", {0, x, 0, 1.7}, {"head", "", "", ""}})));
      if (waits_s > 0.0) std::this_thread::sleep_for(std::chrono::duration<double>(waits_s));
      std::vector<WallPicture> pictures;
      for (;;) {
        devices->poll(now_s());
        const auto pose = devices->state().pose("head", now_s());
        if (!pose || std::abs(pose->position.x - double(float(x))) > 1e-6) continue;
        pictures = display::pictures_of(room, {pose->position}, view);
        break;
      }
      if (pictures.size() != 10) fail("no pictures");
      slowest = std::max(slowest, 1e3 * (now_s() - sent_s));
    }
    return slowest;
  };
  slowest_ms(0.0, 3);  // the module is loaded
  report.add("wand_to_picture_ms", slowest_ms(0.0, setup.is_quick ? 100 : 1000));
  report.add("wand_to_picture_ms_a_frame_later", slowest_ms(1.0 / 60.0, 10));
}

}  // namespace parvis::bench
