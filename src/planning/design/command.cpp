#include "planning/design/command.h"

#include <algorithm>
#include <cmath>
#include <glm/gtx/component_wise.hpp>
#include <set>

#include "base/known_names.h"
#include "planning/design/design_nodes.h"
#include "planning/design/shape_models.h"
#include "scene/data/name_pattern.h"

namespace parvis::design {
namespace {

using scene::Node;

constexpr double max_reach_m = 100'000.0;  // from the scene's origin: floats are off by millimetres there
constexpr double same_place_m = 0.01;
constexpr std::size_t max_objects = 20'000;

/// The design's objects, as a command changes them step by step.
class Draft {
 public:
  /// `known`: heights that were found when the command was done first.
  explicit Draft(const DesignView& view, OpenHeights known = {}) : view_(view), known_(std::move(known)) {}

  void fail(Error error) { errors_.push_back(std::move(error)); }
  bool has_failed() const { return !errors_.empty(); }

  /// The objects of these names or patterns, as they are; each once. Locked ones are an error where
  /// `to_change`.
  std::vector<Node> objects(const Names& names, bool to_change = true);
  /// The same; a name may be that of a group.
  std::vector<Node> members(const Names& names);
  Node fresh(const char* type) const;
  /// The node of the design by this name; null: there is none.
  const Node* child(const std::string& name) const {
    if (view_.design)
      for (const Node& node : view_.design->children)
        if (node.text("name") == name) return &node;
    return nullptr;
  }

  void changes(const Node& before, Node after) { made_.push_back({before, std::move(after), {}}); }
  void adds(Node node) { made_.push_back({std::nullopt, std::move(node), {}}); }
  void removes(const Node& node) { made_.push_back({node, std::nullopt, {}}); }

  /// Adds the names of all that stands on the ground.
  void add_placed(Names& names) const {
    if (!view_.design) return;
    for (const Node& node : view_.design->children)
      if (node.schema->type == placed_type) names.push_back(node.text("name"));
  }
  std::string free_name(const std::string& stem);
  bool check_word(const std::string& name);  ///< false: it is no name, and the draft has failed
  void check_name(const std::string& name);
  double height_at(glm::dvec2 at, const Names& without = {}) const {
    return view_.resting_height ? view_.resting_height(at, without) : 0.0;
  }
  /// The height that the command leaves open next: the known one, or what `now` finds.
  template <class Find>
  double open_height(const Find& now) {
    found_.push_back(found_.size() < known_.size() ? known_[found_.size()] : now());
    return found_.back();
  }
  const OpenHeights& found_heights() const { return found_; }
  bool knows_kind(const std::string& name) const { return find_kind(view_.scene, name) != nullptr; }
  const Kind* kind(const std::string& name) {
    const Kind* found = find_kind(view_.scene, name);
    if (!found) fail(error("{}", no_such_kind(view_.scene, name)));
    return found;
  }
  template <class Value>
  void give(Node& node, const char* attribute, const Value& value);
  void give_text(Node& node, const char* attribute, const std::string& text);
  void place(Node& node, glm::dvec3 at);

  Result<Changes> finish(Errors* refusals);

 private:
  bool is_near(const Node& one, const Node& other) const;
  Errors taken_places() const;

  const DesignView& view_;
  OpenHeights known_, found_;
  Changes made_;
  std::set<std::string> taken_;
  std::vector<Error> errors_;
};

std::string name_of(const Node& node) { return node.text("name"); }
bool is_surface(const Node& node) { return node.schema->type == surface_type; }
bool is_placed(const Node& node) { return node.schema->type == placed_type; }
/// The attribute with the points of a surface or a measurement.
const char* points_of(const Node& node) { return is_surface(node) ? "outline" : "points"; }
/// "surface" or "measurement", for people.
const char* what_is(const Node& node) {
  return is_surface(node) ? "surface" : is_placed(node) ? "object" : "measurement";
}
/// The word before the numbers of objects that commands make.
std::string stem_of(const Node& node) { return is_surface(node) ? "surface" : node.text("kind"); }
glm::dvec3 place_of(const Node& node) { return exact_decimals(node.vec3("position")); }

std::vector<Node> Draft::objects(const Names& names, bool to_change) {
  std::vector<Node> found;
  std::set<const Node*> seen;
  if (names.empty()) fail(error("nothing is selected: name the objects, or select some first"));
  for (const std::string& wanted : names) {
    bool is_any = false;
    if (view_.design)
      for (const Node& node : view_.design->children) {
        const std::string name = name_of(node);
        const bool is_meant =
            is_thing(node) && (scene::is_pattern(wanted) ? scene::matches(wanted, name) : wanted == name);
        if (!is_meant) continue;
        is_any = true;
        if (!seen.insert(&node).second) continue;
        if (to_change && node.flag("locked"))
          fail(error("\"{}\" is locked; unlock it first", name));
        else
          found.push_back(node);
      }
    if (is_any) continue;
    std::vector<std::string> known;
    if (view_.design)
      for (const Node& node : view_.design->children) known.push_back(name_of(node));
    fail(error("the design has no object \"{}\"{}", wanted.substr(0, 40), names_that_exist(wanted, known)));
  }
  return found;
}

std::vector<Node> Draft::members(const Names& names) {
  Names all;
  for (const std::string& wanted : names) {
    const std::size_t before = all.size();
    if (view_.design)
      for (const Node& node : view_.design->children)
        if (is_placed(node) && node.text("group") == wanted) all.push_back(name_of(node));
    if (all.size() == before) all.push_back(wanted);
  }
  return objects(all);
}

Node Draft::fresh(const char* type) const {
  Node node;
  node.schema = &view_.live.registry().find(type)->schema;
  return node;
}

std::string Draft::free_name(const std::string& stem) {
  for (int number = 1;; ++number) {
    std::string name = fmt::format("{}_{}", stem, number);
    if (!view_.live.find(name) && taken_.insert(name).second) return name;
  }
}

bool Draft::check_word(const std::string& name) {
  if (name.find_first_of(" \t\r\n,*?\"") == std::string::npos && !name.empty()) return true;
  fail(error("\"{}\" is no name: names have no blanks, commas, quotes, * or ?", name.substr(0, 40)));
  return false;
}

void Draft::check_name(const std::string& name) {
  if (!check_word(name)) return;
  if (name == "selected" || name == "all" || name == "none")
    return fail(error("\"{}\" is a word of commands and no name for an object", name));
  if (view_.live.find(name) || !taken_.insert(name).second)
    fail(error("the name \"{}\" is taken; names are unique in a scene", name.substr(0, 40)));
}

template <class Value>
void Draft::give(Node& node, const char* attribute, const Value& value) {
  node.set(attribute, value);
  node.attributes.back().where = {};
}

void Draft::give_text(Node& node, const char* attribute, const std::string& text) {
  const scene::AttributeSchema* schema = node.schema->find(attribute);
  if (!schema) return fail(error("a {} has no {}", node.schema->type, attribute));
  Result<scene::AttributeValue> value =
      scene::parse_value(*schema, text, Roots(view_.scene.file.parent_path()), {});
  if (!value) return fail(value.errors().front());
  node.set(attribute, *std::move(value));
  node.attributes.back().where = {};
}

void Draft::place(Node& node, glm::dvec3 at) {
  if (at.z == rests) at.z = open_height([&] { return height_at(glm::dvec2(at)); });
  for (int axis = 0; axis < 3; ++axis)
    if (!(std::abs(at[axis]) <= max_reach_m))
      return fail(error("{:g} m is further than {:g} km from the scene's origin; check the coordinates",
                        at[axis], max_reach_m / 1000.0));
  give(node, "position", glm::vec3(at));
}

/// Do two objects of one kind stand in one place?
bool Draft::is_near(const Node& one, const Node& other) const {
  return is_placed(one) && is_placed(other) && one.text("kind") == other.text("kind") &&
         glm::distance(place_of(one), place_of(other)) < same_place_m;
}

Errors Draft::taken_places() const {
  Errors refusals;
  std::set<std::string> gone;
  for (const Change& change : made_)
    if (change.before) gone.insert(name_of(*change.before));
  for (std::size_t i = 0; i < made_.size() && refusals.empty(); ++i) {
    if (!made_[i].after) continue;
    const Node& after = *made_[i].after;
    if (made_[i].before && is_placed(after) && place_of(*made_[i].before) == place_of(after)) continue;
    const auto refuse = [&](const Node& other) {
      if (is_near(after, other))
        refusals.push_back(
            error("\"{}\" stands there already; put \"{}\" beside it", name_of(other), name_of(after)));
    };
    for (std::size_t k = 0; k < i; ++k)
      if (made_[k].after) refuse(*made_[k].after);
    if (view_.design)
      for (const Node& other : view_.design->children)
        if (!gone.contains(name_of(other))) refuse(other);
  }
  return refusals;
}

Result<Changes> Draft::finish(Errors* refusals) {
  if (!has_failed()) {
    const Errors taken = taken_places();
    if (refusals)
      *refusals = taken;
    else
      for (const Error& each : taken) fail(each);
  }
  const std::size_t before = view_.design ? view_.design->children.size() : 0;
  std::size_t added = 0;
  for (const Change& change : made_) added += !change.before;
  if (before + added > max_objects)
    fail(error("a design has at most {} objects; divide it into several designs", max_objects));
  if (has_failed()) return Errors(errors_.begin(), errors_.end());
  return made_;
}

/// The lengths that a kind lets be changed.
void resize_one(Draft& draft, Node& node, const Resize& how) {
  const Kind* kind = draft.kind(node.text("kind"));
  if (!kind) return;
  struct Axis {
    const char* name;
    const std::optional<double>& wanted;
    Changeable what;
    double usual;
  };
  for (const Axis& axis : {Axis{"width", how.width, Changeable::width, kind->size_m.x},
                           Axis{"depth", how.depth, Changeable::depth, kind->size_m.y},
                           Axis{"height", how.height, Changeable::height, kind->size_m.z}}) {
    const bool is_asked = axis.wanted.has_value();
    if (!is_asked && (how.factor == 1.0 || !kind->may_change(axis.what))) continue;
    if (!kind->may_change(axis.what)) {
      draft.fail(error("the {} of a {} is fixed", axis.name, kind->name));
      continue;
    }
    const double now = node.gives(axis.name) ? node.number(axis.name) : axis.usual;
    const double length = is_asked ? *axis.wanted : now * how.factor;
    const int i = axis.what == Changeable::width ? 0 : axis.what == Changeable::depth ? 1 : 2;
    if (!(length >= kind->min_m[i] && length <= kind->max_m[i]))
      draft.fail(error("the {} of a {} is {:g} to {:g} m, not {:g} m", axis.name, kind->name, kind->min_m[i],
                       kind->max_m[i], length));
    else
      draft.give(node, axis.name, length);
  }
}

void forget(Node& node, const char* attribute) {
  std::erase_if(node.attributes, [&](const auto& each) { return each.schema->name == attribute; });
}

void paint_one(Draft& draft, Node& node, const std::string& colour, const std::string& material) {
  const Kind* kind = is_placed(node) ? draft.kind(node.text("kind")) : nullptr;
  if (!colour.empty()) {
    if (kind && !kind->may_change(Changeable::colour))
      draft.fail(error("the colour of a {} is fixed", kind->name));
    else
      draft.give_text(node, "colour", colour);
  }
  if (!material.empty()) {
    if (kind && !kind->may_change(Changeable::material))
      draft.fail(error("the material of a {} is fixed; another kind (swap) may have another", kind->name));
    else
      draft.give_text(node, "material", material);
  }
}

Node made_object(Draft& draft, const Insert& what) {
  Node node = draft.fresh(placed_type);
  if (!draft.kind(what.kind)) return node;
  if (!what.name.empty()) draft.check_name(what.name);
  draft.give(node, "name", what.name.empty() ? draft.free_name(what.kind) : what.name);
  draft.give(node, "kind", what.kind);
  draft.place(node, what.position);
  if (!(std::abs(what.heading_deg) <= 1e6))
    draft.fail(error("{:g} degrees are no heading", what.heading_deg));
  if (what.heading_deg != 0.0) draft.give(node, "heading_deg", glm::radians(what.heading_deg));
  if (what.width || what.depth || what.height)
    resize_one(draft, node, {{}, 1.0, what.width, what.depth, what.height});
  paint_one(draft, node, what.colour, what.material);
  return node;
}

/// Applies each command to the draft.
struct Maker {
  Draft& draft;

  void operator()(const Insert& c) const { draft.adds(made_object(draft, c)); }

  void operator()(const Surface& c) const {
    Node node = draft.fresh(surface_type);
    if (c.outline.size() < 3)
      return draft.fail(error("a surface has at least three corners, not {}", c.outline.size()));
    if (Status status = check_measurement(Quantity::area, c.outline); !status)
      return draft.fail(status.errors().front());
    if (!c.name.empty()) draft.check_name(c.name);
    draft.give(node, "name", c.name.empty() ? draft.free_name("surface") : c.name);
    draft.give(node, "outline", placed_points(c.outline));
    draft.give_text(node, "material", c.material);
    if (!c.colour.empty()) draft.give_text(node, "colour", c.colour);
    draft.adds(std::move(node));
  }

  /// The points, as far away as objects may stand.
  std::vector<glm::vec3> placed_points(const std::vector<glm::dvec3>& points) const {
    std::vector<glm::vec3> placed;
    for (const glm::dvec3& point : points) {
      Node there = draft.fresh(placed_type);
      draft.place(there, point);
      if (!draft.has_failed()) placed.push_back(there.vec3("position"));
    }
    return placed;
  }

  void operator()(const Measure& c) const {
    const auto known = std::ranges::find(quantity_names(), c.quantity);
    if (known == quantity_names().end())
      return draft.fail(error("\"{}\" cannot be measured{}", c.quantity.substr(0, 40),
                              names_that_exist(c.quantity, quantity_names())));
    Node node = draft.fresh(measured_type);
    if (!c.name.empty()) draft.check_name(c.name);
    draft.give(node, "name", c.name.empty() ? draft.free_name(c.quantity) : c.name);
    draft.give_text(node, "kind", c.quantity);
    draft.give(node, "points", placed_points(c.points));
    if (!draft.has_failed()) check(node);
    draft.adds(std::move(node));
  }

  /// Checks that a measurement's points can be measured.
  void check(const Node& node) const {
    const Measurement made = measurement(node, "");
    if (Status status = check_measurement(made.quantity, made.points); !status)
      draft.fail(status.errors().front());
  }

  void operator()(const KeepView& c) const {
    Node node = draft.fresh(view_type);
    const Node* before = draft.child(c.name);
    if (before && before->schema->type != view_type)
      return draft.fail(error("\"{}\" is an object of the design; give the view another name", c.name));
    if (!before) draft.check_name(c.name);
    draft.give(node, "name", c.name);
    draft.place(node, c.position);
    draft.give(node, "heading_deg", glm::radians(c.heading_deg));
    draft.give(node, "pitch_deg", glm::radians(c.pitch_deg));
    if (c.parallel_m)
      draft.give(node, "parallel", *c.parallel_m);
    else
      draft.give(node, "fov_deg", glm::radians(c.fov_deg));
    for (const scene::NodeAttribute& attribute : node.attributes)
      if (Status status = scene::check_value(*attribute.schema, attribute.value); !status)
        draft.fail(status.errors().front());
    if (draft.has_failed()) return;
    if (before)
      draft.changes(*before, std::move(node));
    else
      draft.adds(std::move(node));
  }

  void operator()(const TakeKind& c) const {
    if (draft.knows_kind(c.name)) return draft.fail(error("the catalogue has a kind \"{}\" already", c.name));
    if (!(glm::compMin(c.size_m) >= 0.01 && glm::compMax(c.size_m) <= 200.0))
      return draft.fail(error("a kind is 0.01 to 200 m large, not {:g} x {:g} x {:g} m", c.size_m.x,
                              c.size_m.y, c.size_m.z));
    draft.check_name(c.name);
    Node node = draft.fresh(kind_type);
    draft.give(node, "name", c.name);
    draft.give_text(node, "file", c.file);
    if (draft.has_failed()) return;
    node.attributes.back().text = c.file;  // so a script writes it: below the scene's folder
    draft.give(node, "size", glm::vec3(c.size_m));
    draft.give(node, "changes", std::string("width depth height"));
    draft.adds(std::move(node));
  }

  void operator()(const MovePoint& c) const {
    const std::vector<Node> objects = draft.objects({c.name});
    if (objects.empty()) return;
    const Node& node = objects.front();
    if (objects.size() > 1 || is_placed(node))
      return draft.fail(error("\"{}\" is no measurement and no surface: it has no points to move", c.name));
    std::vector<glm::vec3> points = node.points(points_of(node));
    if (c.number < 1 || std::size_t(c.number) > points.size())
      return draft.fail(error("\"{}\" has points 1 to {}, not {}", c.name, points.size(), c.number));
    const std::vector<glm::vec3> to = placed_points({c.to});
    if (to.empty()) return;
    points[std::size_t(c.number) - 1] = to.front();
    Node after = node;
    draft.give(after, points_of(node), points);
    if (!is_surface(node)) check(after);
    draft.changes(node, std::move(after));
  }

  /// Names of things that cannot carry those objects: they themselves, and for a surface all that stands on
  /// the ground.
  Names not_below(const std::vector<Node>& moved, bool is_ground) const {
    Names names;
    for (const Node& node : moved) names.push_back(name_of(node));
    if (is_ground) draft.add_placed(names);
    return names;
  }

  /// A place after a way to `to`: with the height of what is there, where it rested before.
  glm::dvec3 carried(glm::dvec3 from, glm::dvec3 to, const Names& without) const {
    constexpr double resting_m = 0.05;  // a layer of paving that was laid round it counts
    if (to.z == rests)
      to.z = draft.open_height([&] {
        const bool rested = std::abs(from.z - draft.height_at(glm::dvec2(from), without)) < resting_m;
        return rested ? draft.height_at(glm::dvec2(to), without) : from.z;
      });
    return to;
  }

  /// `after` stands where `node` does, `by` further.
  void shift(const Node& node, glm::dvec3 by, const Names& without, Node& after) const {
    const auto shifted = [&](glm::dvec3 from) {
      return carried(from, {from.x + by.x, from.y + by.y, by.z == rests ? rests : from.z + by.z}, without);
    };
    if (is_placed(node)) return draft.place(after, shifted(place_of(node)));
    std::vector<glm::dvec3> moved;
    for (const glm::vec3& point : node.points(points_of(node)))
      moved.push_back(shifted(exact_decimals(point)));
    draft.give(after, points_of(node), placed_points(moved));
  }

  /// Gives each object, with the names of what cannot carry it and the way, to `give`.
  template <class Give>
  void shift_all(const std::vector<Node>& objects, glm::dvec3 by, const Give& give) const {
    const Names moved = not_below(objects, false);
    const Names below = std::ranges::any_of(objects, is_surface) ? not_below(objects, true) : moved;
    for (const Node& node : objects) give(node, is_surface(node) ? below : moved, by);
  }

  void operator()(const Move& c) const {
    const std::vector<Node> objects = draft.objects(c.names);
    if (objects.empty()) return;
    glm::dvec3 by = c.by;
    if (c.is_absolute) {
      const Node& node = objects.front();
      const glm::dvec3 first =
          is_placed(node) ? place_of(node) : exact_decimals(node.points(points_of(node)).front());
      by = {by.x - first.x, by.y - first.y, by.z == rests ? rests : by.z - first.z};
    }
    shift_all(objects, by, [&](const Node& node, const Names& without, glm::dvec3 way) {
      Node after = node;
      if (c.is_absolute && is_placed(node) && &node == &objects.front()) {  // exactly there
        glm::dvec3 to = c.by;
        if (to.z == rests) to.z = draft.open_height([&] { return draft.height_at(glm::dvec2(to), without); });
        draft.place(after, to);
      } else {
        shift(node, way, without, after);
      }
      draft.changes(node, std::move(after));
    });
  }

  void operator()(const Turn& c) const {
    if (!(std::abs(c.degrees) <= 1e6)) return draft.fail(error("{:g} degrees are no turn", c.degrees));
    const double cosine = std::cos(glm::radians(-c.degrees)), sine = std::sin(glm::radians(-c.degrees));
    const std::vector<Node> objects = draft.objects(c.names);
    const Names without = not_below(objects, false);
    for (const Node& node : objects) {
      Node after = node;
      const auto turned = [&](glm::dvec2 at) {
        const glm::dvec2 from = at - *c.about;
        return *c.about + glm::dvec2(cosine * from.x - sine * from.y, sine * from.x + cosine * from.y);
      };
      if (!is_placed(node)) {
        if (!c.about) {
          draft.fail(error("\"{}\" is a {}: say about which place it turns", name_of(node), what_is(node)));
          continue;
        }
        std::vector<glm::vec3> outline = node.points(points_of(node));
        for (glm::vec3& corner : outline) corner = glm::vec3(glm::vec2(turned(glm::dvec2(corner))), corner.z);
        draft.give(after, points_of(node), outline);
      } else {
        double heading = c.is_absolute ? c.degrees : glm::degrees(node.number("heading_deg")) + c.degrees;
        heading = std::remainder(heading, 360.0);
        draft.give(after, "heading_deg", glm::radians(heading));
        const glm::dvec3 at = place_of(node);
        if (c.about) draft.place(after, carried(at, glm::dvec3(turned(glm::dvec2(at)), rests), without));
      }
      draft.changes(node, std::move(after));
    }
  }

  void operator()(const Resize& c) const {
    if (c.factor == 1.0 && !c.width && !c.depth && !c.height)
      return draft.fail(error("no size is given: by FACTOR, width M, depth M or height M"));
    for (const Node& node : draft.objects(c.names)) {
      if (!is_placed(node)) {
        draft.fail(error("\"{}\" is a {}: move its points to resize it", name_of(node), what_is(node)));
        continue;
      }
      Node after = node;
      resize_one(draft, after, c);
      draft.changes(node, std::move(after));
    }
  }

  void operator()(const Delete& c) const {
    for (const Node& node : draft.objects(c.names)) draft.removes(node);
  }

  void operator()(const Duplicate& c) const {
    shift_all(draft.objects(c.names, false), c.by,
              [&](const Node& node, const Names& without, glm::dvec3 by) {
                Node copy = node;
                draft.give(copy, "name", draft.free_name(stem_of(node)));
                forget(copy, "locked");
                shift(node, by, without, copy);
                draft.adds(std::move(copy));
              });
  }

  void operator()(const Row& c) const {
    const double length = glm::distance(c.from, c.to);
    if (!(length <= max_reach_m))
      return draft.fail(error("a row of {:g} m is too long; check the coordinates", length));
    if (length < same_place_m) return draft.fail(error("the row begins where it ends; give two places"));
    if (c.count < 0 || c.spacing_m < 0.0 || (c.count != 0) == (c.spacing_m != 0.0))
      return draft.fail(error(
          "say how many stand in the row (count N, 2 or more) or how far apart (spacing M, above 0), not "
          "both"));
    const double places = c.count > 0 ? double(c.count) : std::floor(length / c.spacing_m + 1e-9) + 1.0;
    if (places < 2.0 || places > double(max_objects))
      return draft.fail(error("a row has 2 to {} objects; this one would have {}", max_objects,
                              places > 1e5 ? "more than 100,000" : fmt::format("{:g}", places)));
    const glm::dvec2 along = (c.to - c.from) / length;
    const double step = c.count > 0 ? length / (places - 1.0) : c.spacing_m;
    const double across_deg = glm::degrees(std::atan2(-along.y, along.x));  // to the left of the row
    for (int i = 0; i < int(places); ++i) {
      const glm::dvec2 at = i + 1 == int(places) && c.count > 0 ? c.to : c.from + double(i) * step * along;
      draft.adds(made_object(
          draft, {c.kind, glm::dvec3(at, rests), c.heading_deg.value_or(across_deg), {}, {}, {}}));
    }
  }

  void operator()(const Space& c) const {
    const std::vector<Node> objects = draft.objects(c.names);
    if (objects.size() < 3)
      return draft.fail(error("even spacing needs three objects or more, not {}", objects.size()));
    if (!std::ranges::all_of(objects, is_placed))
      return draft.fail(error("surfaces and measurements cannot be spaced"));
    const glm::dvec3 from = place_of(objects.front()), to = place_of(objects.back());
    const Names without = not_below(objects, false);
    for (std::size_t i = 1; i + 1 < objects.size(); ++i) {
      Node after = objects[i];
      const glm::dvec3 at = glm::mix(from, to, double(i) / double(objects.size() - 1));
      draft.place(after, carried(place_of(objects[i]), {at.x, at.y, rests}, without));
      draft.changes(objects[i], std::move(after));
    }
  }

  void operator()(const Align& c) const {
    const std::vector<Node> objects = draft.objects(c.names);
    if (objects.size() < 2) return draft.fail(error("objects are aligned with the first: name two or more"));
    if (!std::ranges::all_of(objects, is_placed))
      return draft.fail(error("surfaces and measurements cannot be aligned"));
    const int axis = c.what == "x" ? 0 : c.what == "y" ? 1 : c.what == "z" ? 2 : -1;
    if (axis < 0 && c.what != "heading")
      return draft.fail(error("\"{}\": objects are aligned by x, y, z or heading", c.what.substr(0, 40)));
    const Names without = not_below(objects, false);
    for (std::size_t i = 1; i < objects.size(); ++i) {
      Node after = objects[i];
      if (axis >= 0) {
        const glm::dvec3 before = place_of(objects[i]);
        glm::dvec3 at(before.x, before.y, rests);
        at[axis] = place_of(objects.front())[axis];
        draft.place(after, carried(before, at, without));
      } else {
        draft.give(after, "heading_deg", objects.front().number("heading_deg"));
      }
      draft.changes(objects[i], std::move(after));
    }
  }

  void operator()(const Group& c) const {
    if (!c.group.empty()) draft.check_word(c.group);
    for (const Node& node : c.group.empty() ? draft.members(c.names) : draft.objects(c.names)) {
      Node after = node;
      if (c.group.empty())
        forget(after, "group");
      else
        draft.give(after, "group", c.group);
      draft.changes(node, std::move(after));
    }
  }

  void operator()(const Lock& c) const {
    for (const Node& node : draft.objects(c.names, false)) {
      Node after = node;
      if (c.locks)
        draft.give(after, "locked", true);
      else
        forget(after, "locked");
      draft.changes(node, std::move(after));
    }
  }

  void operator()(const Paint& c) const {
    for (const Node& node : draft.objects(c.names)) {
      Node after = node;
      paint_one(draft, after, c.colour, c.material);
      draft.changes(node, std::move(after));
    }
  }

  void operator()(const Swap& c) const {
    if (!draft.kind(c.kind)) return;
    for (const Node& node : draft.objects(c.names)) {
      if (!is_placed(node)) {
        draft.fail(error("\"{}\" is a {} and cannot be swapped", name_of(node), what_is(node)));
        continue;
      }
      Node after = node;
      for (const char* own : {"width", "depth", "height", "colour", "material"}) forget(after, own);
      draft.give(after, "kind", c.kind);
      draft.changes(node, std::move(after));
    }
  }

  void operator()(const Apply& c) const {
    const std::vector<Node> from = draft.objects({c.from}, false);
    if (from.empty()) return;
    for (const Node& node : draft.objects(c.names)) {
      if (name_of(node) == name_of(from.front())) continue;
      if (node.schema != from.front().schema || node.schema->type == measured_type) {
        draft.fail(error("\"{}\" is a {}, \"{}\" a {}: one cannot look like the other", c.from,
                         what_is(from.front()), name_of(node), what_is(node)));
        continue;
      }
      Node after = node;
      for (const char* look : {"kind", "width", "depth", "height", "colour", "material"}) {
        if (!node.schema->find(look)) continue;
        forget(after, look);
        for (const scene::NodeAttribute& attribute : from.front().attributes)
          if (attribute.schema->name == look) after.attributes.push_back(attribute);
      }
      draft.changes(node, std::move(after));
    }
  }

  void operator()(const Rename& c) const {
    const std::vector<Node> objects = draft.objects({c.from});
    draft.check_name(c.to);
    if (objects.size() != 1)
      return draft.fail(error("\"{}\" names {} objects; name one", c.from, objects.size()));
    Node after = objects.front();
    draft.give(after, "name", c.to);
    draft.changes(objects.front(), std::move(after));
  }
};

/// The heights of a command that has some.
OpenHeights* heights_of(Command& command) {
  return std::visit(
      [](auto& c) -> OpenHeights* {
        if constexpr (requires { c.heights; })
          return &c.heights;
        else
          return nullptr;
      },
      command);
}

}  // namespace

Result<Changes> changes_of(const DesignView& view, const Command& command, Errors* refusals) {
  Command known = command;
  const OpenHeights* heights = heights_of(known);
  Draft draft(view, heights ? *heights : OpenHeights());
  std::visit(Maker{draft}, command);
  return draft.finish(refusals);
}

Result<Command> resolved(const DesignView& view, Command command) {
  const auto rest = [&](glm::dvec3& at, const Names& without = {}) {
    if (at.z == rests) at.z = view.resting_height ? view.resting_height(glm::dvec2(at), without) : 0.0;
  };
  if (OpenHeights* heights = heights_of(command)) {
    Draft draft(view, *heights);
    std::visit(Maker{draft}, command);
    *heights = draft.found_heights();
  } else if (auto* insert = std::get_if<Insert>(&command)) {
    rest(insert->position);
    if (insert->name.empty()) insert->name = Draft(view).free_name(insert->kind);
  } else if (auto* surface = std::get_if<Surface>(&command)) {
    Names placed;  // the ground is covered, not what stands on it
    Draft(view).add_placed(placed);
    for (glm::dvec3& corner : surface->outline) rest(corner, placed);
    if (surface->name.empty()) surface->name = Draft(view).free_name("surface");
  } else if (auto* measure = std::get_if<Measure>(&command)) {
    for (glm::dvec3& point : measure->points) rest(point);
    if (measure->name.empty()) measure->name = Draft(view).free_name(measure->quantity);
  } else if (auto* point = std::get_if<MovePoint>(&command)) {
    rest(point->to);
  }
  return command;
}

}  // namespace parvis::design
