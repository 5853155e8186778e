#include "graphics/display/display_file.h"

#include <expat.h>

#include <charconv>
#include <map>
#include <memory>

#include "base/files.h"
#include "base/json_fields.h"

namespace parvis::display {
namespace {

using Json = OrderedJson;

constexpr int json_version = 1;
constexpr double max_coordinate = 1e4;  // metres: a room is smaller
constexpr std::size_t max_surface_points = 100'000;

/// A point of the room.
std::optional<glm::dvec3> point_in(JsonFields& fields, const char* key) {
  const auto values = fields.numbers(key, 3, max_coordinate);
  if (!values) return std::nullopt;
  return glm::dvec3((*values)[0], (*values)[1], (*values)[2]);
}

/// The fourth corner and the third, of the two forms that ParaView's documents have.
void set_corners(Wall& wall, std::optional<glm::dvec3> upper_left, std::optional<glm::dvec3> upper_right) {
  wall.upper_left = upper_left ? *upper_left : wall.lower_left + (*upper_right - wall.lower_right);
}

/// A part of an upright cylinder, from the left to the right as its axis sees it.
void read_cylinder(const Json& value, const std::string& where, Wall& wall, Errors& errors) {
  JsonFields fields(value, where + ".cylinder", errors);
  const glm::dvec3 centre = point_in(fields, "centre").value_or(glm::dvec3(0.0));
  const double radius = fields.number("radius_m", 3.0, 0.1, 1e3);
  const double from = glm::radians(fields.number("from_deg", -60.0, -360.0, 360.0));
  const double to = glm::radians(fields.number("to_deg", 60.0, -360.0, 360.0));
  const double height = fields.number("height_m", 2.5, 0.01, 1e3);
  fields.finish();
  if (!(to > from)) fields.wrong("to_deg", "expected more than \"from_deg\": degrees clockwise from ahead");
  constexpr int columns = 129;  // of 120 degrees: a chord leaves the arc by 1/30,000 of the radius
  wall.is_curved = true, wall.columns = columns;
  for (int row = 0; row < 2; ++row)
    for (int i = 0; i < columns; ++i) {
      const double share = double(i) / (columns - 1), angle = from + share * (to - from);
      const glm::dvec3 at =
          centre + glm::dvec3(radius * std::sin(angle), radius * std::cos(angle), row * height);
      wall.surface.push_back({glm::vec3(at), {float(share), float(row), 1.0f}, {float(share), float(row)}});
    }
}

/// A mesh of points in rows from below, with where the projector's picture has each of them.
void read_mesh(const Json& value, const std::string& where, Wall& wall, Errors& errors) {
  JsonFields fields(value, where + ".mesh", errors);
  const int columns = int(fields.number("columns", 2, 2, 10'000));
  const std::vector<std::vector<double>> points =
                                             fields.rows("points", 3, max_coordinate, max_surface_points),
                                         pixels = fields.rows("pixels", 2, 2.0, max_surface_points);
  fields.finish();
  const int rows = int(points.size()) / columns;
  if (rows < 2 || std::size_t(rows) * std::size_t(columns) != points.size())
    return fields.wrong("points", fmt::format("{} points are no rows of {} columns, two rows at least",
                                              points.size(), columns));
  if (!pixels.empty() && pixels.size() != points.size())
    return fields.wrong("pixels", fmt::format("expected as many as points, {}", points.size()));
  wall.is_curved = true, wall.columns = columns;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::vec2 share(float(int(i) % columns) / float(columns - 1),
                          float(int(i) / columns) / float(rows - 1));
    const glm::vec2 pixel = pixels.empty() ? share : glm::vec2(pixels[i][0], pixels[i][1]);
    wall.surface.push_back({{points[i][0], points[i][1], points[i][2]}, {pixel, 1.0f}, share});
  }
}

Wall read_wall(const Json& value, const std::string& where, Errors& errors) {
  JsonFields fields(value, where, errors);
  Wall wall;
  wall.name = fields.text("name");
  if (wall.name.empty() || wall.name.find_first_of("/\\.") != std::string::npos)
    fields.wrong("name", "expected a name, without / \\ and full stops: pictures are named after it");
  const auto lower_left = point_in(fields, "lower_left"), lower_right = point_in(fields, "lower_right"),
             upper_left = point_in(fields, "upper_left"), upper_right = point_in(fields, "upper_right");
  const Json *cylinder = fields.find("cylinder"), *mesh = fields.find("mesh");
  if (cylinder || mesh) {
    cylinder ? read_cylinder(*cylinder, where, wall, errors) : read_mesh(*mesh, where, wall, errors);
  } else if (lower_left && lower_right && (upper_left || upper_right)) {
    wall.lower_left = *lower_left, wall.lower_right = *lower_right;
    set_corners(wall, upper_left, upper_right);
  } else {
    fields.wrong("",
                 "expected \"lower_left\", \"lower_right\" and \"upper_right\" (or \"upper_left\"), or a "
                 "\"cylinder\" or \"mesh\"");
  }
  if (const auto pixels = fields.numbers("pixels", 2, max_wall_pixels)) {
    wall.pixels = {int((*pixels)[0]), int((*pixels)[1])};
    if (wall.pixels.x < 1 || wall.pixels.y < 1)
      fields.wrong("pixels", fmt::format("expected width and height, 1 to {}", max_wall_pixels));
  }
  const std::vector<std::vector<double>> keystone = fields.rows("keystone", 2, 2.0, 4);
  if (keystone.size() == 4 && !wall.is_curved) {
    std::array<glm::dvec2, 4> corners;
    for (std::size_t i = 0; i < 4; ++i) corners[i] = {keystone[i][0], keystone[i][1]};
    if (Status status = set_keystone(wall, corners); !status)
      fields.wrong("keystone", status.errors()[0].message);
  } else if (fields.find("keystone")) {
    fields.wrong("keystone",
                 "expected the four corners of a flat wall in the projector's picture, [x, y] each");
  }
  if (const Json* overlap = fields.find("overlap")) {
    JsonFields sides(*overlap, where + ".overlap", errors);
    constexpr std::array names{"left", "right", "below", "above"};
    for (std::size_t i = 0; i < 4; ++i) wall.overlap[i] = sides.number(names[i], 0.0, 0.0, 1.0);
    sides.finish();
  }
  const std::string eye = fields.text("eye", "both");
  wall.eye = eye == "left" ? Eye::left : eye == "right" ? Eye::right : Eye::both;
  if (eye != "left" && eye != "right" && eye != "both") fields.wrong("eye", "expected both, left or right");
  if (const Json* window = fields.find("window")) {
    JsonFields place(*window, where + ".window", errors);
    if (const auto at = place.numbers("at", 2, 1e5)) wall.window.at = glm::ivec2((*at)[0], (*at)[1]);
    wall.window.is_full_screen = place.flag("full_screen", false);
    wall.window.has_border = place.flag("border", true);
    wall.window.x_display = place.text("x_display");
    place.finish();
  }
  fields.finish();
  return wall;
}

Result<Display> read_json(const std::string& text, const std::string& file) {
  const Result<Json> read = read_versioned_json(text, file, "parvis_display", json_version);
  if (!read) return read.errors();
  const Json& whole = *read;
  Errors errors;
  JsonFields fields(whole, file, errors);
  fields.find("parvis_display"), fields.find("$schema");
  Display display;
  display.name = fields.text("name", std::filesystem::path(file).stem().string());
  display.eye = point_in(fields, "eye").value_or(display.eye);
  display.eye_separation_m = fields.number("eye_separation_m", display.eye_separation_m, 0.0, 1.0);
  display.scale = fields.number("scale", 1.0, 1e-3, 1e6);
  display.is_upright = fields.flag("upright", true);
  display.gamma = fields.number("gamma", 0.0, 0.0, 5.0);
  display.head = fields.text("head"), display.wand = fields.text("wand");
  if (!display.head.empty() && display.head == display.wand)
    fields.wrong("wand", fmt::format("the tracker \"{}\" is the head's, too; each needs one of its own",
                                     display.wand));
  const std::string stereo = fields.text("stereo", "none");
  if (const auto kind = stereo_named(stereo))
    display.stereo = *kind;
  else
    fields.wrong("stereo", fmt::format("\"{}\" is none of {}", stereo, fmt::join(stereo_names, ", ")));
  const Json* walls = fields.find("walls");
  if (!walls || !walls->is_array()) {
    fields.wrong("walls", "expected a list of walls");
  } else if (walls->size() > max_walls) {
    fields.wrong("walls", fmt::format("{} walls; a display has {} at most", walls->size(), max_walls));
  } else {
    for (std::size_t i = 0; i < walls->size(); ++i)
      display.walls.push_back(read_wall((*walls)[i], fmt::format("{}: walls[{}]", file, i), errors));
  }
  fields.finish();
  if (!errors.empty()) return errors;
  return checked(std::move(display), file);
}

/// Content of a .pvx file, as expat reads it.
struct PvxReader {
  XML_Parser parser = nullptr;
  std::string file;
  Display display;
  Errors errors;
  bool is_pvx = false;

  FileLocation here() const {
    return {file, int(XML_GetCurrentLineNumber(parser)), int(XML_GetCurrentColumnNumber(parser)) + 1};
  }

  /// Numbers between white space; nothing where one is none, "0/05" say.
  std::vector<double> numbers(const std::string& name, const std::string& text, std::size_t count) {
    std::vector<double> result;
    const char *at = text.data(), *const end = at + text.size();
    while (at < end) {
      if (*at == ' ' || *at == '\t' || *at == '\n' || *at == ',') {
        ++at;
        continue;
      }
      double value = 0.0;
      const auto [next, problem] = std::from_chars(at, end, value);
      if (problem != std::errc() || !(std::abs(value) <= max_coordinate) ||
          (next < end && !std::isspace(static_cast<unsigned char>(*next)) && *next != ',')) {
        result.clear();
        break;
      }
      result.push_back(value), at = next;
    }
    if (result.size() == count) return result;
    errors.push_back(error_at(here(), "{}=\"{}\": expected {} numbers", name, text, count));
    return std::vector<double>(count, 0.0);
  }

  /// ParaView's y is up and its z backwards.
  std::optional<glm::dvec3> corner(const std::map<std::string, std::string>& attributes, const char* name) {
    const auto found = attributes.find(name);
    if (found == attributes.end()) return std::nullopt;
    const std::vector<double> at = numbers(name, found->second, 3);
    return glm::dvec3(at[0], -at[2], at[1]);
  }

  void read_machine(const std::map<std::string, std::string>& attributes) {
    const auto text = [&](const char* name) {
      const auto found = attributes.find(name);
      return found == attributes.end() ? std::string() : found->second;
    };
    Wall wall;
    wall.name = fmt::format("wall_{}", display.walls.size() + 1);  // machines of several walls have one name
    const auto lower_left = corner(attributes, "LowerLeft"), lower_right = corner(attributes, "LowerRight"),
               upper_left = corner(attributes, "UpperLeft"), upper_right = corner(attributes, "UpperRight");
    if (!lower_left || !lower_right || (!upper_left && !upper_right)) {
      errors.push_back(
          error_at(here(),
                   "a machine without corners: expected LowerLeft, LowerRight and UpperRight (or "
                   "UpperLeft)"));
      return;
    }
    wall.lower_left = *lower_left, wall.lower_right = *lower_right;
    set_corners(wall, upper_left, upper_right);
    if (const std::string geometry = text("Geometry"); !geometry.empty()) {
      int width = 0, height = 0, x = 0, y = 0;
      const int read = std::sscanf(geometry.c_str(), "%dx%d%d%d", &width, &height, &x, &y);
      if (read < 2 || width < 1 || height < 1 || width > max_wall_pixels || height > max_wall_pixels)
        errors.push_back(error_at(here(), "Geometry=\"{}\": expected WIDTHxHEIGHT+X+Y", geometry));
      wall.pixels = {width, height};
      if (read == 4) wall.window.at = glm::ivec2(x, y);
    }
    wall.window.is_full_screen = text("FullScreen") == "1";
    wall.window.has_border = text("ShowBorders") == "1";
    if (const std::string environment = text("Environment"); environment.starts_with("DISPLAY="))
      wall.window.x_display = environment.substr(8, environment.find(' ') - 8);
    display.walls.push_back(std::move(wall));
  }

  static void begin(void* data, const char* element, const char** pairs) {
    PvxReader& reader = *static_cast<PvxReader*>(data);
    std::map<std::string, std::string> attributes;
    for (; *pairs; pairs += 2) attributes[pairs[0]] = pairs[1];
    const std::string name = element;
    if (name == "pvx") reader.is_pvx = true;
    if (name == "EyeSeparation")
      reader.display.eye_separation_m = reader.numbers("EyeSeparation", attributes["Value"], 1)[0];
    if (name == "Machine" && reader.display.walls.size() <= max_walls) reader.read_machine(attributes);
  }
};

Result<Display> read_pvx(const std::string& text, const std::string& file) {
  PvxReader reader;
  reader.file = file;
  reader.display.name = std::filesystem::path(file).stem().string();
  reader.display.eye = glm::dvec3(0.0);
  const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(XML_ParserCreate(nullptr),
                                                                            &XML_ParserFree);
  reader.parser = parser.get();
  XML_SetUserData(parser.get(), &reader);
  XML_SetStartElementHandler(parser.get(), &PvxReader::begin);
  if (XML_Parse(parser.get(), text.data(), int(text.size()), 1) != XML_STATUS_OK)
    return error_at(reader.here(), "{}", XML_ErrorString(XML_GetErrorCode(parser.get())));
  if (!reader.is_pvx) return error("{}: expected ParaView's element <pvx>", file);
  if (!reader.errors.empty()) return reader.errors;
  return checked(std::move(reader.display), file);
}

}  // namespace

Result<Display> read_display_text(const std::string& text, const std::filesystem::path& file) {
  return file.extension() == ".pvx" ? read_pvx(text, file.string()) : read_json(text, file.string());
}

Result<Display> read_display(const std::filesystem::path& file) {
  constexpr std::uint64_t max_bytes = 16 << 20;
  const Result<std::string> text = read_file(file, max_bytes);
  if (!text) return text.errors();
  return read_display_text(*text, file);
}

}  // namespace parvis::display
