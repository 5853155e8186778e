// The text form of commands: words parted by spaces, numbers with a point, places as X,Y or X,Y,Z.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/known_names.h"
#include "planning/design/command.h"

namespace parvis::design {
namespace {

using Words = std::vector<std::string>;

Words words_of(std::string_view text) {
  Words words;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t first = text.find_first_not_of(" \t\r\n", at);
    if (first == std::string_view::npos) break;
    const std::size_t end = std::min(text.find_first_of(" \t\r\n", first), text.size());
    words.emplace_back(text.substr(first, end - first));
    at = end;
  }
  return words;
}

std::vector<std::string> parts_of(const std::string& word) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= word.size();) {
    const std::size_t end = std::min(word.find(',', at), word.size());
    if (end > at) parts.push_back(word.substr(at, end - at));
    at = end + 1;
  }
  return parts;
}

std::optional<double> number_of(const std::string& word) {
  double value = 0.0;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (code != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// Takes words from the front, and keeps the first problem.
class WordReader {
 public:
  explicit WordReader(Words words) : words_(std::move(words)) {}

  bool is_at_end() const { return next_ == words_.size(); }
  const std::string& peek() const {
    static const std::string none;
    return is_at_end() ? none : words_[next_];
  }
  bool takes(const char* word) {
    if (peek() != word || is_at_end()) return false;
    return ++next_, true;
  }
  std::string word(const char* what) {
    if (is_at_end()) return fail(fmt::format("expected {} at its end", what)), "";
    return words_[next_++];
  }
  Names names(const char* what = "names of objects, parted by commas") { return parts_of(word(what)); }
  double number(const char* what) {
    const std::string text = word(what);
    const std::optional<double> value = number_of(text);
    if (!value && problem_.empty())
      fail(fmt::format("expected {} in place of \"{}\"", what, text.substr(0, 40)));
    return value.value_or(0.0);
  }
  /// Two numbers or three.
  glm::dvec3 place(const char* what, double height) {
    const std::string text = word(what);
    const std::vector<std::string> parts = parts_of(text);
    glm::dvec3 at(0.0, 0.0, height);
    bool is_right = parts.size() == 2 || parts.size() == 3;
    for (std::size_t i = 0; is_right && i < parts.size(); ++i) {
      const std::optional<double> value = number_of(parts[i]);
      is_right = value.has_value();
      if (value) at[glm::length_t(i)] = *value;
    }
    if (!is_right && problem_.empty())
      fail(fmt::format("expected {} (X,Y or X,Y,Z, in metres) in place of \"{}\"", what, text.substr(0, 40)));
    return at;
  }
  void fail(std::string problem) {
    if (problem_.empty()) problem_ = std::move(problem);
  }
  const std::string& problem() const { return problem_; }

 private:
  Words words_;
  std::size_t next_ = 0;
  std::string problem_;
};

/// "heights Z,Z,..." at the end of a command: heights that it left open when it was done first.
void read_heights(WordReader& words, OpenHeights& heights) {
  if (!words.takes("heights")) return;
  for (const std::string& part : parts_of(words.word("heights, parted by commas"))) {
    const std::optional<double> height = number_of(part);
    if (!height) words.fail(fmt::format("\"{}\" is no height in m", part.substr(0, 40)));
    heights.push_back(height.value_or(0.0));
  }
}

struct Form {
  const char* verb;
  const char* form;
  Command (*read)(WordReader& words);
};

/// Sizes and looks that several commands take: false where the next word is none of them.
bool read_size(WordReader& words, std::optional<double>& width, std::optional<double>& depth,
               std::optional<double>& height) {
  if (words.takes("width")) return width = words.number("a width in m"), true;
  if (words.takes("depth")) return depth = words.number("a depth in m"), true;
  if (words.takes("height")) return height = words.number("a height in m"), true;
  return false;
}

Command read_insert(WordReader& words) {
  Insert insert;
  insert.kind = words.word("a kind of the catalogue");
  insert.position = words.place("where it stands", rests);
  while (!words.is_at_end() && words.problem().empty()) {
    if (read_size(words, insert.width, insert.depth, insert.height)) continue;
    if (words.takes("heading"))
      insert.heading_deg = words.number("degrees clockwise from north");
    else if (words.takes("colour"))
      insert.colour = words.word("a colour as #RRGGBB");
    else if (words.takes("material"))
      insert.material = words.word("a material");
    else if (words.takes("name"))
      insert.name = words.word("a name");
    else
      words.fail(fmt::format("\"{}\" is no word of this command", words.peek().substr(0, 40)));
  }
  return insert;
}

Command read_move(WordReader& words) {
  Move move{words.names()};
  move.is_absolute = words.takes("to");
  if (!move.is_absolute && !words.takes("by")) words.fail("expected \"by\" or \"to\" behind the names");
  move.by = words.place(move.is_absolute ? "where the first goes" : "how far", rests);
  read_heights(words, move.heights);
  return move;
}

Command read_turn(WordReader& words) {
  Turn turn{words.names()};
  turn.is_absolute = words.takes("to");
  if (!turn.is_absolute && !words.takes("by")) words.fail("expected \"by\" or \"to\" behind the names");
  turn.degrees = words.number("degrees, clockwise from above");
  if (words.takes("about")) turn.about = glm::dvec2(words.place("the middle of the turn", 0.0));
  read_heights(words, turn.heights);
  return turn;
}

Command read_resize(WordReader& words) {
  Resize resize{words.names()};
  while (!words.is_at_end() && words.problem().empty()) {
    if (read_size(words, resize.width, resize.depth, resize.height)) continue;
    if (words.takes("by"))
      resize.factor = words.number("a factor");
    else
      words.fail(fmt::format("\"{}\" is no word of this command", words.peek().substr(0, 40)));
  }
  return resize;
}

Command read_row(WordReader& words) {
  Row row;
  row.kind = words.word("a kind of the catalogue");
  if (!words.takes("from")) words.fail("expected \"from\" behind the kind");
  row.from = glm::dvec2(words.place("where the first stands", 0.0));
  if (!words.takes("to")) words.fail("expected \"to\" behind the first place");
  row.to = glm::dvec2(words.place("where the last stands", 0.0));
  while (!words.is_at_end() && words.problem().empty())
    if (words.takes("count"))
      row.count = int(std::clamp(words.number("how many"), -1.0, 1e6));
    else if (words.takes("spacing"))
      row.spacing_m = words.number("metres from one to the next");
    else if (words.takes("heading"))
      row.heading_deg = words.number("degrees clockwise from north");
    else if (words.peek() == "heights")
      read_heights(words, row.heights);
    else
      words.fail(fmt::format("\"{}\" is no word of this command", words.peek().substr(0, 40)));
  return row;
}

Command read_surface(WordReader& words) {
  Surface surface;
  surface.material = words.word("a material of the ground");
  while (!words.is_at_end() && words.problem().empty())
    if (words.takes("colour"))
      surface.colour = words.word("a colour as #RRGGBB");
    else if (words.takes("name"))
      surface.name = words.word("a name");
    else
      surface.outline.push_back(words.place("a corner", rests));
  return surface;
}

Command read_measure(WordReader& words) {
  Measure measure;
  measure.quantity = words.word("distance, area, height or slope");
  while (!words.is_at_end() && words.problem().empty())
    if (words.takes("name"))
      measure.name = words.word("a name");
    else
      measure.points.push_back(words.place("a point", rests));
  return measure;
}

Command read_move_point(WordReader& words) {
  MovePoint point;
  point.name = words.word("the name of a measurement or surface");
  point.number = int(std::clamp(words.number("which of its points, from 1 on"), -1.0, 1e6));
  if (!words.takes("to")) words.fail("expected \"to\" behind the number");
  point.to = words.place("where it goes", rests);
  return point;
}

Command read_keep_view(WordReader& words) {
  KeepView view;
  view.name = words.word("a name for the view");
  view.position = words.place("where the eye stands", 1.7);
  while (!words.is_at_end() && words.problem().empty())
    if (words.takes("heading"))
      view.heading_deg = words.number("degrees clockwise from north");
    else if (words.takes("pitch"))
      view.pitch_deg = words.number("degrees upward");
    else if (words.takes("fov"))
      view.fov_deg = words.number("degrees");
    else if (words.takes("parallel"))
      view.parallel_m = words.number("a height in m");
    else
      words.fail(fmt::format("\"{}\" is no word of this command", words.peek().substr(0, 40)));
  return view;
}

Command read_take_kind(WordReader& words) {
  TakeKind kind;
  kind.name = words.word("a name for the kind");
  kind.file = words.word("a file below the scene's folder");
  kind.size_m = words.place("width, depth and height", 0.0);
  return kind;
}

/// The word between two names.
void expect(WordReader& words, const char* word) {
  if (!words.takes(word)) words.fail(fmt::format("expected \"{}\" behind the names", word));
}

const std::vector<Form>& forms() {
  static const std::vector<Form> all{
      {"insert",
       "insert KIND X,Y[,Z] [heading DEG] [width M] [depth M] [height M] [colour #RRGGBB] [material NAME] "
       "[name NAME]",
       read_insert},
      {"move", "move NAMES by DX,DY[,DZ] | move NAMES to X,Y[,Z]", read_move},
      {"turn", "turn NAMES by DEG [about X,Y] | turn NAMES to DEG", read_turn},
      {"resize", "resize NAMES [by FACTOR] [width M] [depth M] [height M]", read_resize},
      {"delete", "delete NAMES", [](WordReader& words) { return Command(Delete{words.names()}); }},
      {"duplicate", "duplicate NAMES by DX,DY[,DZ]",
       [](WordReader& words) {
         Duplicate duplicate{words.names()};
         expect(words, "by");
         duplicate.by = words.place("how far", rests);
         read_heights(words, duplicate.heights);
         return Command(duplicate);
       }},
      {"row", "row KIND from X,Y to X,Y count N|spacing M [heading DEG]", read_row},
      {"space", "space NAMES",
       [](WordReader& words) {
         Space space{words.names()};
         read_heights(words, space.heights);
         return Command(space);
       }},
      {"align", "align NAMES x|y|z|heading",
       [](WordReader& words) {
         Align align{words.names(), {}};
         align.what = words.word("x, y, z or heading");
         read_heights(words, align.heights);
         return Command(align);
       }},
      {"group", "group NAMES as NAME",
       [](WordReader& words) {
         Group group{words.names(), {}};
         expect(words, "as");
         group.group = words.word("the name of the group");
         return Command(group);
       }},
      {"ungroup", "ungroup NAMES",
       [](WordReader& words) {
         return Command(Group{words.names(), {}});
       }},
      {"lock", "lock NAMES",
       [](WordReader& words) {
         return Command(Lock{words.names(), true});
       }},
      {"unlock", "unlock NAMES",
       [](WordReader& words) {
         return Command(Lock{words.names(), false});
       }},
      {"colour", "colour NAMES #RRGGBB",
       [](WordReader& words) {
         Paint paint{words.names(), {}, {}};
         paint.colour = words.word("a colour as #RRGGBB");
         return Command(paint);
       }},
      {"material", "material NAMES MATERIAL",
       [](WordReader& words) {
         Paint paint{words.names(), {}, {}};
         paint.material = words.word("a material");
         return Command(paint);
       }},
      {"swap", "swap NAMES for KIND",
       [](WordReader& words) {
         Swap swap{words.names(), {}};
         expect(words, "for");
         swap.kind = words.word("a kind of the catalogue");
         return Command(swap);
       }},
      {"apply", "apply NAME to NAMES",
       [](WordReader& words) {
         Apply apply;
         apply.from = words.word("the name of an object");
         expect(words, "to");
         apply.names = words.names();
         return Command(apply);
       }},
      {"surface", "surface MATERIAL X,Y X,Y X,Y ... [colour #RRGGBB] [name NAME]", read_surface},
      {"measure", "measure distance|area|height|slope X,Y[,Z] X,Y[,Z] ... [name NAME]", read_measure},
      {"point", "point NAME N to X,Y[,Z]", read_move_point},
      {"view", "view NAME X,Y,Z [heading DEG] [pitch DEG] [fov DEG|parallel M]", read_keep_view},
      {"kind", "kind NAME FILE WIDTH,DEPTH,HEIGHT", read_take_kind},
      {"rename", "rename NAME as NAME",
       [](WordReader& words) {
         Rename rename;
         rename.from = words.word("the name of an object");
         expect(words, "as");
         rename.to = words.word("another name");
         return Command(rename);
       }},
  };
  return all;
}

std::string place(const glm::dvec3& at) {
  return at.z == rests ? fmt::format("{},{}", at.x, at.y) : fmt::format("{},{},{}", at.x, at.y, at.z);
}

/// " WORD VALUE" where there is one.
std::string with(const char* word, const std::string& value) {
  return value.empty() ? "" : fmt::format(" {} {}", word, value);
}
std::string with(const char* word, const std::optional<double>& value) {
  return value ? fmt::format(" {} {}", word, *value) : "";
}

std::string with(const OpenHeights& heights) {
  return heights.empty() ? "" : fmt::format(" heights {}", fmt::join(heights, ","));
}

struct Writer {
  static std::string list(const Names& names) { return fmt::format("{}", fmt::join(names, ",")); }

  std::string operator()(const Insert& c) const {
    return fmt::format("insert {} {}", c.kind, place(c.position)) +
           (c.heading_deg != 0.0 ? fmt::format(" heading {}", c.heading_deg) : "") + with("width", c.width) +
           with("depth", c.depth) + with("height", c.height) + with("colour", c.colour) +
           with("material", c.material) + with("name", c.name);
  }
  std::string operator()(const Move& c) const {
    return fmt::format("move {} {} {}", list(c.names), c.is_absolute ? "to" : "by", place(c.by)) +
           with(c.heights);
  }
  std::string operator()(const Turn& c) const {
    return fmt::format("turn {} {} {}", list(c.names), c.is_absolute ? "to" : "by", c.degrees) +
           (c.about ? fmt::format(" about {},{}", c.about->x, c.about->y) : "") + with(c.heights);
  }
  std::string operator()(const Resize& c) const {
    return fmt::format("resize {}", list(c.names)) +
           (c.factor != 1.0 ? fmt::format(" by {}", c.factor) : "") + with("width", c.width) +
           with("depth", c.depth) + with("height", c.height);
  }
  std::string operator()(const Delete& c) const { return "delete " + list(c.names); }
  std::string operator()(const Duplicate& c) const {
    return fmt::format("duplicate {} by {}", list(c.names), place(c.by)) + with(c.heights);
  }
  std::string operator()(const Row& c) const {
    return fmt::format("row {} from {},{} to {},{}", c.kind, c.from.x, c.from.y, c.to.x, c.to.y) +
           (c.count != 0 ? fmt::format(" count {}", c.count) : "") +
           (c.spacing_m != 0.0 ? fmt::format(" spacing {}", c.spacing_m) : "") +
           with("heading", c.heading_deg) + with(c.heights);
  }
  std::string operator()(const Space& c) const { return "space " + list(c.names) + with(c.heights); }
  std::string operator()(const Align& c) const {
    return fmt::format("align {} {}", list(c.names), c.what) + with(c.heights);
  }
  std::string operator()(const Group& c) const {
    return c.group.empty() ? "ungroup " + list(c.names)
                           : fmt::format("group {} as {}", list(c.names), c.group);
  }
  std::string operator()(const Lock& c) const { return (c.locks ? "lock " : "unlock ") + list(c.names); }
  std::string operator()(const Paint& c) const {
    return c.colour.empty() ? fmt::format("material {} {}", list(c.names), c.material)
                            : fmt::format("colour {} {}", list(c.names), c.colour);
  }
  std::string operator()(const Swap& c) const { return fmt::format("swap {} for {}", list(c.names), c.kind); }
  std::string operator()(const Apply& c) const {
    return fmt::format("apply {} to {}", c.from, list(c.names));
  }
  std::string operator()(const Surface& c) const {
    std::string text = "surface " + c.material;
    for (const glm::dvec3& corner : c.outline) text += fmt::format(" {}", place(corner));
    return text + with("colour", c.colour) + with("name", c.name);
  }
  std::string operator()(const Measure& c) const {
    std::string text = "measure " + c.quantity;
    for (const glm::dvec3& point : c.points) text += fmt::format(" {}", place(point));
    return text + with("name", c.name);
  }
  std::string operator()(const MovePoint& c) const {
    return fmt::format("point {} {} to {}", c.name, c.number, place(c.to));
  }
  std::string operator()(const KeepView& c) const {
    return fmt::format("view {} {} heading {} pitch {}", c.name, place(c.position), c.heading_deg,
                       c.pitch_deg) +
           (c.parallel_m ? with("parallel", c.parallel_m) : fmt::format(" fov {}", c.fov_deg));
  }
  std::string operator()(const TakeKind& c) const {
    return fmt::format("kind {} {} {}", c.name, c.file, place(c.size_m));
  }
  std::string operator()(const Rename& c) const { return fmt::format("rename {} as {}", c.from, c.to); }
};

/// "bench_1", or "12 objects".
std::string those(const Names& names) {
  return names.size() == 1 ? names.front() : fmt::format("{} objects", names.size());
}

struct Teller {
  std::string operator()(const Insert& c) const { return "inserted " + (c.name.empty() ? c.kind : c.name); }
  std::string operator()(const Move& c) const {
    return c.is_absolute
               ? "moved " + those(c.names)
               : fmt::format("moved {} by {:.2f} m", those(c.names),
                             glm::length(c.by.z == rests ? glm::dvec3(glm::dvec2(c.by), 0.0) : c.by));
  }
  std::string operator()(const Turn& c) const { return "turned " + those(c.names); }
  std::string operator()(const Resize& c) const { return "resized " + those(c.names); }
  std::string operator()(const Delete& c) const { return "deleted " + those(c.names); }
  std::string operator()(const Duplicate& c) const { return "duplicated " + those(c.names); }
  std::string operator()(const Row& c) const { return fmt::format("inserted a row of {}", c.kind); }
  std::string operator()(const Space& c) const { return "spaced " + those(c.names) + " evenly"; }
  std::string operator()(const Align& c) const { return "aligned " + those(c.names); }
  std::string operator()(const Group& c) const {
    return (c.group.empty() ? "ungrouped " : "grouped ") + those(c.names);
  }
  std::string operator()(const Lock& c) const { return (c.locks ? "locked " : "unlocked ") + those(c.names); }
  std::string operator()(const Paint& c) const { return "painted " + those(c.names); }
  std::string operator()(const Swap& c) const {
    return fmt::format("swapped {} for {}", those(c.names), c.kind);
  }
  std::string operator()(const Apply& c) const {
    return fmt::format("applied {} to {}", c.from, those(c.names));
  }
  std::string operator()(const Surface& c) const { return "inserted a surface of " + c.material; }
  std::string operator()(const Measure& c) const {
    return "measured " + (c.name.empty() ? c.quantity : c.name);
  }
  std::string operator()(const MovePoint& c) const { return "moved a point of " + c.name; }
  std::string operator()(const KeepView& c) const { return "kept the view " + c.name; }
  std::string operator()(const TakeKind& c) const { return "took up the kind " + c.name; }
  std::string operator()(const Rename& c) const { return fmt::format("renamed {} to {}", c.from, c.to); }
};

}  // namespace

Result<Command> parse_command(std::string_view text) {
  WordReader words(words_of(text));
  const std::string verb = words.word("a command");
  const auto form = std::ranges::find(forms(), verb, [](const Form& each) { return std::string(each.verb); });
  if (form == forms().end()) {
    std::vector<std::string> known;
    for (const Form& each : forms()) known.emplace_back(each.verb);
    return error("\"{}\" is no command{}", verb.substr(0, 40), names_that_exist(verb, known));
  }
  Command command = form->read(words);
  if (words.problem().empty() && !words.is_at_end())
    words.fail(fmt::format("\"{}\" is one word too many", words.peek().substr(0, 40)));
  if (!words.problem().empty())
    return error("\"{}\": {}; it is written {}", text.substr(0, 80), words.problem(), form->form);
  return command;
}

std::string text_of(const Command& command) { return std::visit(Writer{}, command); }
std::string sentence_of(const Command& command) { return std::visit(Teller{}, command); }

KeepView view_of(const Camera& camera, const std::string& name) {
  const glm::dvec3 ahead(camera.forward_in_world());
  const bool is_vertical = std::abs(ahead.z) > 0.9999;
  const glm::dvec3 level = is_vertical ? glm::dvec3(camera.world_from_camera[1]) : ahead;
  KeepView view{name, glm::round(1e3 * glm::dvec3(camera.position_in_world())) / 1e3};
  const auto tenths = [](double degrees) { return std::round(100.0 * degrees) / 100.0; };
  view.heading_deg = tenths(glm::degrees(std::atan2(level.x, level.y)));
  view.pitch_deg = tenths(glm::degrees(std::asin(std::clamp(ahead.z, -1.0, 1.0))));
  constexpr double nominal_aspect = 16.0 / 9.0;
  view.fov_deg =
      tenths(glm::degrees(2.0 * std::atan(nominal_aspect * std::tan(0.5 * double(camera.vertical_fov)))));
  if (camera.parallel) view.parallel_m = double(camera.parallel->height_m);
  return view;
}

const std::vector<std::string>& command_forms() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> lines;
    for (const Form& form : forms()) lines.emplace_back(form.form);
    return lines;
  }();
  return all;
}

}  // namespace parvis::design
