// tram, tramStop: a line with its track, stops and trams.
#include <algorithm>

#include "base/registries.h"
#include "life/tram/track.h"
#include "life/tram/tram_process.h"
#include "room_list.h"
#include "scene/script/attribute.h"
#include "scene/script/node_registry.h"
#include "scene/script/placement.h"
#include "scene/script/scene_builder.h"

namespace parvis::tram {
namespace {

using namespace scene::attribute;

using scene::Node, scene::SceneBuilder;

std::string called(const Node& node) { return node.gives("name") ? node.text("name") : "tram"; }

std::vector<std::string> tram_names(const Node& node) {
  std::vector<std::string> names;
  for (int i = 0; i < max_trams; ++i) names.push_back(section_name(called(node), i, 0));
  return names;
}

scene::NodeSchema tram_schema() {
  return {.type = "tram",
          .help =
              "A tram line: rails in grooved paving, wire and masts, platforms at its tramStop nodes, and "
              "articulated trams of 32 m that follow each "
              "other from the path's first point to its last, stop, open their doors and go on. They come "
              "and go at the ends of the path: let them "
              "lie out of sight. The trams are called \"tram 1\", \"tram 2\", ... (or by the line's name): "
              "cameras can follow them.",
          .attributes = {text("name", "of the line, and of its trams with their number"),
                         path("path",
                              "the middle of the track on the ground; repeated, the pieces follow each other")
                             .in("m")
                             .between(-1e6, 1e6)
                             .required()
                             .repeatable(),
                         number("radius", "of curves in place of the path's corners, where there is room")
                             .in("m")
                             .between(18, 2000)
                             .by_default("30"),
                         number("headway_s", "between trams").in("s").between(30, 7200).by_default("240"),
                         number("start_s", "how long the first tram has run when the scene begins")
                             .in("s")
                             .between(0, 7200)
                             .by_default("0"),
                         number("speed_km_h", "the highest").in("km/h").between(5, 80).by_default("40"),
                         colour("colour", "of the lacquer").by_default("#B8C4C8"),
                         flag("wire", "false: without wire and masts").by_default("1"),
                         scene::visible_attribute()},
          .example =
              "tram(path=\"-120 0, 20 0, 120 60\", radius=40, headway_s=180) {\n"
              "  tramStop(position=\"-30 -3 0\")\n"
              "}",
          .is_laid_out_once = true,
          .names_made = tram_names};
}

scene::NodeSchema stop_schema() {
  return {.type = "tramStop",
          .help =
              "A stop of the tram line around it: a platform with a shelter, on the side of the track on "
              "which the position lies; the middle of the tram "
              "stops beside it.",
          .attributes =
              {scene::attribute::vec3("position", "beside the track, at most 8 m from its middle")
                   .in("m")
                   .required(),
               number("dwell_s",
                      "how long trams stay at least; their doors take 2.5 s to open and to close, and stay "
                      "open while people of a crowd board")
                   .in("s")
                   .between(8, 600)
                   .by_default("20")},
          .stands_in = {"tram"},
          .example =
              "tram(path=\"-120 0, 120 0\") {\n"
              "  tramStop(position=\"0 -3 0\", dwell_s=25)\n"
              "}"};
}

/// The arc length of the place of a path that is nearest to a point, in plan, and its distance.
std::pair<float, float> nearest(const scene::MeasuredPath& line, glm::vec3 point) {
  std::pair<float, float> best{0.0f, 1e9f};
  float before_m = 0.0f;
  const scene::Path& points = line.points();
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const glm::vec2 a(points[i]), along = glm::vec2(points[i + 1]) - a;
    const float t = glm::clamp(
        glm::dot(glm::vec2(point) - a, along) / std::max(glm::dot(along, along), 1e-9f), 0.0f, 1.0f);
    const float away = glm::distance(glm::vec2(point), a + t * along),
                segment_m = glm::distance(points[i], points[i + 1]);
    if (away < best.second) best = {before_m + t * segment_m, away};
    before_m += segment_m;
  }
  return best;
}

/// Reads the stops of a line, in the order of the line; errors go to the builder.
std::vector<Stop> stops_of(const Node& node, const scene::MeasuredPath& line, SceneBuilder& builder,
                           std::vector<Platform>& platforms) {
  constexpr float max_beside_m = 8.0f;
  std::vector<std::pair<Stop, const Node*>> found;
  for (const Node& child : node.children) {
    const glm::vec3 position(builder.world_from_parent() * glm::vec4(child.vec3("position"), 1.0f));
    const auto [middle_m, away_m] = nearest(line, position);
    const float front_m = middle_m + 0.5f * length_m;
    if (away_m > max_beside_m) {
      builder.fail(
          error_at(child.where_of("position"),
                   "tramStop: it lies {:.1f} m from the track; place it at most {:.0f} m from its middle",
                   away_m, max_beside_m));
      continue;
    }
    if (front_m < length_m + 1.0f || front_m > line.length() - 1.0f) {
      builder.fail(error_at(child.where_of("position"),
                            "tramStop: it lies {:.1f} m from an end of the track; half a tram, {:.0f} m, "
                            "must fit: move it, or lengthen the path",
                            std::min(middle_m, line.length() - middle_m), 0.5f * length_m + 1.0f));
      continue;
    }
    const bool is_left =
        scene::cross_in_plan(line.direction_at(middle_m), position - line.at(middle_m)) > 0.0f;
    found.push_back({{front_m, float(child.number("dwell_s")), is_left}, &child});
  }
  std::ranges::sort(found, {}, [](const auto& it) { return it.first.front_m; });
  std::vector<Stop> stops;
  for (const auto& [stop, child] : found) {
    if (!stops.empty() && stop.front_m - stops.back().front_m < length_m + 4.0f)
      builder.fail(error_at(child->where_of("position"),
                            "tramStop: the platform of another stop is {:.1f} m from it; a tram's length and "
                            "4 m, {:.0f} m, must lie between them",
                            stop.front_m - stops.back().front_m, length_m + 4.0f));
    stops.push_back(stop);
    platforms.push_back({std::max(stop.front_m - length_m - 1.0f, 0.1f),
                         std::min(stop.front_m + 1.0f, line.length() - 0.1f), stop.is_on_left});
  }
  return stops;
}

void build_tram(const Node& node, SceneBuilder& builder) {
  scene::Path corners;
  for (const glm::vec3& point : node.points("path"))
    corners.emplace_back(builder.world_from_parent() * glm::vec4(point, 1.0f));
  Result<scene::MeasuredPath> ground = driveable(smooth_line(corners, float(node.number("radius"))));
  if (!ground) {
    for (const Error& reason : ground.errors())
      builder.fail(error_at(node.where_of("path"), "tram: {}", reason.message));
    return;
  }
  std::vector<Platform> platforms;
  std::vector<Stop> stops = stops_of(node, *ground, builder, platforms);
  if (!builder.errors().empty()) return;
  TramLine line;
  line.called = called(node);
  constexpr float rails_m = 0.03f;  // the paving's thickness
  scene::Path rails = ground->points();
  for (glm::vec3& point : rails) point.z += rails_m;
  line.track = scene::MeasuredPath(std::move(rails));
  line.timetable =
      std::make_shared<const Timetable>(line.track, length_m, line.track.length(), std::move(stops),
                                        float(node.number("speed_km_h")) / 3.6f, length_m);
  for (const Platform& platform : platforms) line.edges.push_back(platform_edge(*ground, platform));
  line.headway_s = node.number("headway_s"), line.start_s = node.number("start_s");
  line.colour = node.vec3("colour"), line.is_visible = builder.is_visible() && node.flag("visible");
  const double shortest = min_headway_s(*line.timetable);
  if (line.headway_s < shortest)
    return builder.fail(error_at(node.where_of("headway_s"),
                                 "tram: trams at a headway of {:.0f} s would run into each other at stops "
                                 "and in curves; this line needs {:.0f} s or more",
                                 line.headway_s, shortest));
  constexpr double longest_wait_s = 40.0;
  line.spare_s = std::min(longest_wait_s, line.headway_s - shortest);
  if (line.trams() > max_trams)
    return builder.fail(error_at(node.where_of("headway_s"),
                                 "tram: {} trams would be on the line at a time, at most {} are run; a "
                                 "longer headway_s or a shorter path has fewer",
                                 line.trams(), max_trams));
  scene::Object track;
  track.name = line.called + " track";
  track.model = track_model(*ground, node.flag("wire"), platforms);
  track.is_visible = line.is_visible;
  builder.add(std::move(track));
  builder.add(std::move(line));
}

}  // namespace

void register_room(Registries& registries) {
  scene::NodeRegistry& registry = registries.get<scene::NodeRegistry>();
  registry.add(tram_schema(), [](const Node& node, SceneBuilder& builder) { build_tram(node, builder); });
  registry.add_part(stop_schema());
  registries.get<action::Processes>().add([] { return std::make_unique<TramProcess>(); });
}

}  // namespace parvis::tram
