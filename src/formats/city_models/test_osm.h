// Maps of OpenStreetMap in metres, for tests.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/bounds.h"
#include "base/test_folder.h"
#include "formats/city_models/osm_reader.h"

namespace parvis::scene {

/// Tags of a way.
using TestTags = std::vector<std::pair<std::string, std::string>>;

/// A map of ways about Leiden's latitude, on a meridian where the map's north is the earth's.
class TestMap {
 public:
  /// An area: its corners, without a repeated last one. Ways are numbered 1, 2, 3, ...
  void add_area(const std::vector<glm::dvec2>& corners, const TestTags& tags) { add(corners, tags, true); }
  /// A line.
  void add_line(const std::vector<glm::dvec2>& points, const TestTags& tags) { add(points, tags, false); }
  /// A multipolygon of areas without tags of their own: its outline, then holes.
  void add_area_with_holes(const std::vector<std::vector<glm::dvec2>>& rings, const TestTags& tags) {
    std::string members;
    for (std::size_t i = 0; i < rings.size(); ++i) {
      add_area(rings[i], {});
      members += fmt::format(R"(<member type="way" ref="{}" role="{}"/>)", ways_, i == 0 ? "outer" : "inner");
    }
    relation_texts_ += fmt::format(R"(<relation id="{}">{}<tag k="type" v="multipolygon"/>{}</relation>)",
                                   ways_, members, text_of(tags));
  }
  /// A relation of ways, each with its role.
  void add_relation(const std::vector<std::pair<int, std::string>>& ways, const TestTags& tags) {
    constexpr int first_id = 1000;  // beyond those of areas with holes
    std::string members;
    for (const auto& [way, role] : ways)
      members += fmt::format(R"(<member type="way" ref="{}" role="{}"/>)", way, role);
    relation_texts_ +=
        fmt::format(R"(<relation id="{}">{}{}</relation>)", first_id + ++relations_, members, text_of(tags));
  }
  /// The file of it.
  std::string text() const {
    return R"(<osm version="0.6">)" + node_texts_ + way_texts_ + relation_texts_ + "</osm>";
  }

 private:
  static std::string text_of(const TestTags& tags) {
    std::string text;
    for (const auto& [key, value] : tags) text += fmt::format(R"(<tag k="{}" v="{}"/>)", key, value);
    return text;
  }

  void add(const std::vector<glm::dvec2>& points, const TestTags& tags, bool is_closed) {
    constexpr double north_deg = 52.16, east_deg = 3.0, degree_north_m = 111'268.0, degree_east_m = 68'430.0;
    const int first = nodes_ + 1;
    way_texts_ += fmt::format(R"(<way id="{}">)", ++ways_);
    for (const glm::dvec2& point : points) {
      node_texts_ += fmt::format(R"(<node id="{}" lat="{:.9f}" lon="{:.9f}"/>)", ++nodes_,
                                 north_deg + point.y / degree_north_m, east_deg + point.x / degree_east_m);
      way_texts_ += fmt::format(R"(<nd ref="{}"/>)", nodes_);
    }
    if (is_closed) way_texts_ += fmt::format(R"(<nd ref="{}"/>)", first);
    way_texts_ += text_of(tags) + "</way>";
  }

  std::string node_texts_, way_texts_, relation_texts_;
  int nodes_ = 0, ways_ = 0, relations_ = 0;
};

/// A model and the warnings of its file, one per line.
struct TestTown {
  Result<Model> model;
  std::string warnings;
};

/// The model of a map.
inline TestTown read(const TestMap& map, const GroundOnMap& ground = {}) {
  const TestFolder folder;
  Errors warnings;
  Result<Model> model = read_osm(folder.write("town.osm", map.text()), warnings, ground);
  return {std::move(model), to_string(warnings)};
}

/// Bounds of the parts of one name.
inline Bounds bounds_of(const Model& model, const std::string& object) {
  Bounds all;
  for (const Part& part : model.parts)
    if (part.object == object) all.add(part.mesh.bounds());
  return all;
}

/// Sum of the triangles' areas as vectors along their normals: none for a closed surface.
inline glm::dvec3 directed_area_m2(const Model& model, const std::string& object) {
  glm::dvec3 area(0.0);
  for (const Part& part : model.parts)
    for (std::size_t i = 0; part.object == object && i + 2 < part.mesh.indices.size(); i += 3) {
      const auto at = [&](std::size_t k) { return part.mesh.positions[part.mesh.indices[i + k]]; };
      area += 0.5 * glm::dvec3(glm::cross(at(1) - at(0), at(2) - at(0)));
    }
  return area;
}

}  // namespace parvis::scene
