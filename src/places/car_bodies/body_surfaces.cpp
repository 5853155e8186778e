#include "places/car_bodies/body_surfaces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string_view>

#include "places/car_bodies/names.h"

namespace parvis::car_bodies {
namespace {

constexpr float whole_fraction = 0.8f;     // of the outer area, from which on all of it is a pane or a lamp
constexpr float max_part_fraction = 0.6f;  // of the car's outer area that anything but paint may have
constexpr float max_lamp_fraction = 0.15f;
constexpr float min_outer_fraction = 0.05f;  // of its own area: what shows less lies inside
constexpr float min_outer_m2 = 0.02f;        // of a part that is looked at on its own
constexpr float min_pane_height = 0.45f;     // mean height of panes, as a fraction of the car's
constexpr float min_lamp_forward = 0.25f;    // mean distance of lamps from the middle, over the car's length
constexpr float paint_tolerance = 0.13f, min_paint_fraction = 0.2f, min_painted_fraction = 0.25f;

/// Words in the names of materials and objects, in lower case, in several languages.
constexpr std::string_view lamp_words[] = {"lamp", "light", "scheinwerfer", "phare", "blinker", "indicator"};
constexpr std::string_view glass_words[] = {"glass",   "window", "windscreen", "windshield", "fenster",
                                            "scheibe", "vitre",  "verre",      "vetro",      "cristal"};
constexpr std::string_view no_glass_words[] = {"frame", "trim", "seal", "wiper", "rubber"};
constexpr std::string_view chrome_words[] = {"chrom"};
constexpr std::string_view rubber_words[] = {"rubber", "seal", "tyre", "tire", "gummi"};
constexpr std::string_view plastic_words[] = {"plastic", "trim", "grill", "carbon", "wiper"};
constexpr std::string_view paint_words[] = {"paint", "lacquer", "carros", "autolack"};

/// The finish that a name states, if any.
std::optional<Finish> finish_named(const std::string& given) {
  const std::string name = lower_case(given);
  const auto holds = [&](const auto& words) {
    return std::ranges::any_of(words, [&](std::string_view w) { return name.find(w) != std::string::npos; });
  };
  if (holds(lamp_words)) return Finish::lamp;
  if (holds(glass_words) && !holds(no_glass_words)) return Finish::glass;
  if (holds(chrome_words)) return Finish::chrome;
  if (holds(rubber_words)) return Finish::rubber;
  if (holds(plastic_words)) return Finish::plastic;
  if (holds(paint_words)) return Finish::paint;
  return std::nullopt;
}

/// Areas, square metres, and moments of them.
struct Areas {
  float all = 0.0f, outer = 0.0f;
  float panes = 0.0f, lamps = 0.0f, painted = 0.0f;  // of the outer one
  float height = 0.0f, off_middle = 0.0f;            // of all
  float panes_top = 0.0f;                            // fraction of the car's height

  void add(const SurfaceSample& sample, glm::vec3 paint) {
    const float m2 = sample.area_m2;
    all += m2, height += m2 * sample.height, off_middle += m2 * std::abs(sample.forward);
    if (!sample.is_outer) return;
    outer += m2;
    if (is_pane(sample, paint)) panes += m2, panes_top = std::max(panes_top, sample.top);
    if (is_lamp(sample, paint)) lamps += m2;
    const glm::vec3 off = glm::abs(sample.srgb - paint);
    if (std::max({off.x, off.y, off.z}) <= paint_tolerance) painted += m2;
  }
};

bool lets_light_through(const scene::Material& material) {
  return material.alpha_mode == scene::Alpha::blend && material.alpha < 1.0f;
}

/// The finish by names, place and colour of a material or of one of its parts, if any; `outer_m2` of the
/// car.
std::optional<Finish> finish_shown(const std::optional<Finish>& named, bool sees_through, const Areas& of,
                                   float outer_m2) {
  const float height = of.all > 0.0f ? of.height / of.all : 0.0f;
  const bool is_at_end = of.all > 0.0f && of.off_middle / of.all > min_lamp_forward;
  const bool is_small = of.outer < max_lamp_fraction * outer_m2;
  if (of.outer > max_part_fraction * outer_m2) return std::nullopt;
  if (named == Finish::lamp && is_small && is_at_end) return Finish::lamp;
  if (named == Finish::glass || sees_through) {
    if (height >= min_pane_height) return Finish::glass;
    if (is_at_end && is_small) return Finish::lamp;
    return std::nullopt;
  }
  if (named == Finish::chrome || named == Finish::rubber || named == Finish::plastic) return named;
  const bool is_pane_alone = of.panes >= whole_fraction * of.outer && of.outer > 0.0f;
  if (is_pane_alone && reaches_roof(of.panes_top)) return Finish::glass;
  if (of.lamps >= whole_fraction * of.outer && of.outer > 0.0f) return Finish::lamp;
  return std::nullopt;
}

/// Parts of which every triangle belongs to a wheel, and parts that are called wheels.
std::set<std::size_t> wheel_parts(const scene::Model& model, const std::vector<OwnWheel>& wheels) {
  std::map<std::size_t, std::size_t> taken;
  for (const OwnWheel& wheel : wheels)
    for (const auto& [part, triangles] : wheel.triangles) taken[part] += triangles.size();
  std::set<std::size_t> parts;
  for (const auto& [part, count] : taken)
    if (count == model.parts[part].mesh.triangle_count()) parts.insert(part);
  for (std::size_t part = 0; part < model.parts.size(); ++part) {  // spare wheels
    const scene::Part& each = model.parts[part];
    if (names_a_wheel(each.object) || names_a_wheel(model.nodes[std::size_t(each.node)].name))
      parts.insert(part);
  }
  return parts;
}

class Sorter {
 public:
  Sorter(const Body& body, const std::vector<SurfaceSample>& samples, const std::vector<OwnWheel>& wheels)
      : model_(body.model()),
        samples_(samples),
        paint_(paint_of(samples)),
        wheels_(wheel_parts(body.model(), wheels)),
        of_parts_(model_.parts.size()) {
    for (const SurfaceSample& sample : samples) {
      if (wheels_.contains(sample.part)) continue;
      of_parts_[sample.part].add(sample, paint_);
      of_materials_[material_of(sample.part)].add(sample, paint_);
    }
    for (const auto& [material, areas] : of_materials_) {
      outer_m2_ += areas.outer, panes_m2_ += areas.panes;
      largest_m2_ = std::max(largest_m2_, areas.outer);
    }
  }

  std::vector<BodySurface> sort() {
    for (std::size_t part = 0; part < model_.parts.size(); ++part) {
      if (model_.parts[part].mesh.indices.empty()) continue;
      const int material = material_of(part);
      const Finish finish = wheels_.contains(part) ? wheel_finish(material) : finish_of(part);
      const auto found = std::ranges::find_if(surfaces_, [&](const BodySurface& surface) {
        return surface.material == material && surface.finish == finish;
      });
      if (found != surfaces_.end()) {
        found->parts.push_back(part);
      } else {
        surfaces_.push_back({.material = material,
                             .finish = finish,
                             .parts = {part},
                             .sees_through = lets_light_through(material_at(material))});
      }
    }
    for (BodySurface& surface : surfaces_) add_masks(surface);
    return std::move(surfaces_);
  }

 private:
  int material_of(std::size_t part) const { return model_.parts[part].material; }
  const scene::Material& material_at(int material) const { return model_.materials[std::size_t(material)]; }

  /// A wheel in the body's own plain colour would be painted; one with a picture or a material looks like
  /// one.
  Finish wheel_finish(int material) const {
    const bool is_of_body = of_materials_.contains(material);
    return is_of_body && material_at(material).base_colour_texture == scene::no_index ? Finish::rubber
                                                                                      : Finish::as_in_file;
  }

  Finish finish_of(std::size_t part) const {
    const int index = material_of(part);
    const scene::Material& material = material_at(index);
    const Areas& of_material = of_materials_.at(index);
    const bool sees_through = lets_light_through(material);
    const std::optional<Finish> named = finish_named(material.name);
    if (const auto finish = finish_shown(named, sees_through, of_material, outer_m2_)) return *finish;
    if (of_material.outer < min_outer_fraction * of_material.all) return Finish::as_in_file;
    const std::string& node = model_.nodes[std::size_t(model_.parts[part].node)].name;
    std::optional<Finish> part_named = finish_named(model_.parts[part].object);
    if (!part_named) part_named = finish_named(node);
    const Areas& of_part = of_parts_[part];
    if (of_part.outer >= min_outer_m2)
      if (const auto finish = finish_shown(part_named, sees_through, of_part, outer_m2_)) return *finish;
    const bool is_painted = named == Finish::paint ||
                            of_material.painted >= min_paint_fraction * of_material.outer ||
                            of_material.outer >= min_painted_fraction * largest_m2_;
    return is_painted ? Finish::paint : Finish::as_in_file;
  }

  void add_masks(BodySurface& surface) const {
    const int picture = material_at(surface.material).base_colour_texture;
    if (surface.finish != Finish::paint || picture == scene::no_index) return;
    std::vector<SurfaceSample> own;
    for (const SurfaceSample& sample : samples_)
      if (std::ranges::binary_search(surface.parts, sample.part)) own.push_back(sample);
    surface.masks = find_masks(model_.textures[std::size_t(picture)].image, own, paint_, panes_m2_);
  }

  const scene::Model& model_;
  const std::vector<SurfaceSample>& samples_;
  glm::vec3 paint_;
  std::set<std::size_t> wheels_;
  std::vector<Areas> of_parts_;
  std::map<int, Areas> of_materials_;
  float outer_m2_ = 0.0f, panes_m2_ = 0.0f, largest_m2_ = 0.0f;
  std::vector<BodySurface> surfaces_;
};

}  // namespace

std::vector<BodySurface> surfaces_of(const Body& body, const std::vector<SurfaceSample>& samples,
                                     const std::vector<OwnWheel>& wheels) {
  return Sorter(body, samples, wheels).sort();
}

}  // namespace parvis::car_bodies
