// A plan drawing as plain data: what a DXF file draws in model space, in metres.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace parvis::formats {

/// A layer as the drawing's table of layers has it.
struct DrawingLayer {
  std::string name;
  bool is_on = true;  ///< off: its colour is negative
  bool is_frozen = false;
  int colour_index = 7;  ///< of AutoCAD's 255 colours

  /// Whether the drawing shows it.
  bool is_shown() const { return is_on && !is_frozen; }
};

/// A polyline; arcs and curves are chords that lie within `max_chord_gap_m` of them.
struct DrawingLine {
  int layer = 0;                   ///< index into Drawing::layers
  glm::u8vec3 colour{0};           ///< sRGB; the layer's where the entity has none of its own
  double width_m = 0.0;            ///< of polylines that are drawn as strips; 0: a line
  std::vector<glm::dvec3> points;  ///< two or more; the first again at the end of a closed one
};

/// A filled area: its outline, then its holes (even-odd rule), without a repeated first point.
struct DrawingArea {
  int layer = 0;
  glm::u8vec3 colour{0};
  bool is_solid = true;  ///< else a pattern of lines
  std::vector<std::vector<glm::dvec3>> rings;
};

/// A text at its place.
struct DrawingText {
  int layer = 0;
  glm::u8vec3 colour{0};
  std::string text;  ///< UTF-8, lines separated by \n, without codes of formats
  glm::dvec3 position{0.0};
  double height_m = 0.0;
  double angle_deg = 0.0;  ///< counter-clockwise from east
  glm::dvec2 anchor{0.0};  ///< which place of the text its position is: (0, 0) lower left, (1, 1) upper right
};

/// A survey point.
struct DrawingPoint {
  int layer = 0;
  glm::dvec3 position{0.0};
};

/// A block that the drawing places (INSERT), each of an array by itself. Its lines are among Drawing::lines,
/// too.
struct PlacedBlock {
  int layer = 0;
  std::string block;  ///< its name
  glm::dvec3 position{0.0};
  double heading_deg = 0.0;  ///< compass direction of the block's y axis
  glm::dvec3 scale{1.0};     ///< of the block's units
  bool is_mirrored = false;  ///< as seen from above
  std::map<std::string, std::string> attributes;
  /// The middle of its drawing and the size along the block's own x and y axes. Nothing: it draws nothing.
  std::optional<glm::dvec2> centre, size_m;
};

/// How far a chord lies from its arc at most.
inline constexpr double max_chord_gap_m = 0.001;

/// Coordinates are the file's own in metres (Lambert-93 stays Lambert-93), in double precision.
struct Drawing {
  std::string version;           ///< "AC1024"
  double metres_per_unit = 1.0;  ///< of the file's coordinates
  std::vector<DrawingLayer> layers;
  std::vector<DrawingLine> lines;
  std::vector<DrawingArea> areas;
  std::vector<DrawingText> texts;
  std::vector<DrawingPoint> points;
  std::vector<PlacedBlock> blocks;
  glm::dvec3 min{0.0}, max{0.0};  ///< of all that is drawn, layers that are off included
  /// Entities of model space by layer and type ("ARBRES", "INSERT"), attributes of blocks included, contents
  /// of blocks not.
  std::map<std::string, std::map<std::string, int>> entity_counts;
  std::map<std::string, int> left_out;  ///< entities that are not drawn, by type
  int paper_entities = 0;               ///< of layouts, which are left out, too
  int far_away = 0;                     ///< lines, texts and points that lie beyond the earth

  /// A point near the drawing in whole metres at z = 0, about which floats are exact enough; zero where the
  /// drawing lies near zero itself.
  glm::dvec3 local_origin() const;
};

}  // namespace parvis::formats
