#include "places/dressing/facades.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>

#include "base/parallel.h"
#include "base/random.h"
#include "places/dressing/brick_texture.h"
#include "places/dressing/kind_walls.h"
#include "places/dressing/round_walls.h"
#include "places/dressing/street_level_texture.h"
#include "places/dressing/undersides.h"
#include "places/dressing/wall_panels.h"
#include "scene/data/model.h"

namespace parvis::dressing {

namespace {

constexpr float steepest_roof_z = 0.34f;  // cosine of 70 degrees: above it a surface is roof
constexpr float shed_m = 2.9f;            // lower: nobody lives there
constexpr float narrowest_on_roof_m =
    5.0f;                         // of a wall above a lower roof: else it is the side of the next house
constexpr float garage_m = 2.7f;  // width of a shed with a door
constexpr float max_ground_storey_m = 4.2f, cornice_m = 0.2f;   // no storey is higher; above the last one
constexpr float shop_probability = 0.2f, two_storeys_m = 5.4f;  // of houses from so high on
constexpr float same_eaves_m = 0.9f;                            // houses of a row differ where their eaves do
constexpr float seam_m = 1e-3f;                                 // no strip is lower
constexpr std::size_t sheet_count = 3;

constexpr float min_storey_m = 2.2f, max_storey_m = 5.5f;  // else the number of storeys is not believed
constexpr float gates_m = 4.8f, low_gates_m = 3.1f;        // height of the gates' strip: of works, of sheds
constexpr float nave_foot_m = 1.4f, nave_m = 12.0f, nave_bay_m = 4.6f;
constexpr float nave_top_m = 0.5f, lowest_nave_m = 4.5f;  // of wall above; lower walls have no windows
constexpr float below_next_row = 0.01f;                   // fraction of a cell of a sheet

/// Properties that the walls of one house have in common.
struct HouseStyle {
  int colour;
  float storey_m, bay_m;
  StreetBand band;
  bool is_shop;
  std::optional<WallLook> look = std::nullopt;  ///< of the house's kind; nothing: bricks of no certain time
};

/// Does the file say anything of a building from which its walls look different? Dwellings and shops of no
/// certain time have the common bricks.
bool has_own_look(const scene::BuildingKind& kind) {
  using Use = scene::BuildingUse;
  const bool is_common =
      kind.use == Use::unknown || kind.use == Use::dwelling || kind.use == Use::shop || kind.use == Use::shed;
  return !is_common || kind.epoch != scene::BuildingEpoch::unknown ||
         kind.finish != scene::WallFinish::unknown || kind.tint != scene::WallTint::unknown;
}

HouseStyle style_of(const WallPanel& panel, std::uint64_t seed) {
  const auto height = std::uint64_t(std::lround(panel.eaves_m / same_eaves_m) + 100'000);
  Random random(seed + 7919 * panel.building, height);
  HouseStyle style;
  style.colour = random.index(brick_colour_count);
  style.storey_m = random.uniform(2.8f, 3.35f), style.bay_m = random.uniform(2.5f, 3.3f);
  style.is_shop = random.chance(shop_probability) && panel.eaves_m - panel.low.y > two_storeys_m;
  style.band = random.chance(0.5f) ? StreetBand::houses : StreetBand::wide_panes;
  if (panel.kind.use != scene::BuildingUse::unknown)
    style.is_shop = panel.kind.use == scene::BuildingUse::shop;
  if (!has_own_look(panel.kind)) return style;
  const ChosenWall wall = chosen_wall(panel.kind, random);
  const WallMeasures measures = measures_of(wall.look);
  style.look = wall.look, style.colour = wall.colour;
  style.storey_m = random.uniform(measures.storey_m.x, measures.storey_m.y);
  style.bay_m = random.uniform(measures.bay_m.x, measures.bay_m.y);
  return style;
}

/// Material 3 i + sheet from the first index, of brick colour i.
int add_brick_materials(scene::Model& model) {
  const int first = int(model.materials.size());
  model.materials.resize(model.materials.size() + sheet_count * brick_colour_count);
  std::array<BrickWalls, sheet_count> sheets;
  parallel_for(sheet_count, [&](std::size_t i) { sheets[i] = brick_wall_pictures(BrickSheet(i), 1); });
  for (std::size_t sheet = 0; sheet < sheet_count; ++sheet) {
    const bool is_plain = BrickSheet(sheet) == BrickSheet::plain;
    const char* name = is_plain                                  ? "brick wall"
                       : BrickSheet(sheet) == BrickSheet::street ? "street level"
                                                                 : "facade";
    const int normal = add_texture(model, name, std::move(sheets[sheet].normal), false);
    const int surface = add_texture(model, name, std::move(sheets[sheet].surface), false);
    for (std::size_t i = 0; i < brick_colour_count; ++i) {
      scene::Material& material = model.materials[std::size_t(first) + sheet_count * i + sheet];
      material.name = name;
      material.base_colour = glm::vec3(1.0f), material.roughness = 1.0f, material.metallic = 1.0f;
      material.base_colour_texture = add_texture(model, name, std::move(sheets[sheet].colours[i]), true);
      material.normal_texture = normal, material.surface_texture = surface;
      material.relief_m = is_plain ? 0.0f : synthesis::canvas_relief_m;
      material.is_double_sided = true;
    }
  }
  return first;
}

/// The materials of the walls of a model, added when the first wall needs them.
class WallMaterials {
 public:
  explicit WallMaterials(scene::Model& model) : model_(model) {}

  int brick(BrickSheet sheet, int colour) {
    if (first_brick_ == scene::no_index) first_brick_ = add_brick_materials(model_);
    return first_brick_ + int(sheet_count) * colour + int(sheet);
  }

  int of(KindSheet sheet, const WallLook& look, int colour) {
    const auto [known, is_new] = of_kinds_.try_emplace({sheet, look, colour}, int(model_.materials.size()));
    if (!is_new) return known->second;
    const Painted& painted = painted_sheet(sheet, look);
    scene::Material& material = model_.materials.emplace_back();
    material.name = name_of(sheet, look.finish);
    material.base_colour = glm::vec3(1.0f), material.roughness = 1.0f, material.metallic = 1.0f;
    const glm::vec3 factor = wall_colours(look.finish)[std::size_t(colour)] / painted.colour;
    material.base_colour_texture =
        add_texture(model_, material.name, in_colour(painted.picture, factor), true);
    material.normal_texture = painted.normal, material.surface_texture = painted.surface;
    material.relief_m = sheet == KindSheet::plain ? 0.0f : synthesis::canvas_relief_m;
    material.is_double_sided = true;
    return known->second;
  }

 private:
  /// A sheet as painted, and the textures that all its colours share.
  struct Painted {
    Image8 picture;
    glm::vec3 colour;
    int normal, surface;
  };

  static std::string name_of(KindSheet sheet, scene::WallFinish finish) {
    if (sheet == KindSheet::plain) return scene::words_of({.finish = finish}) + " wall";
    return sheet == KindSheet::street ? "street level" : "facade";
  }

  const Painted& painted_sheet(KindSheet sheet, const WallLook& look) {
    const auto [known, is_new] = painted_.try_emplace({sheet, look});
    if (!is_new) return known->second;
    KindPictures made = wall_pictures(sheet, look);
    const std::string name = name_of(sheet, look.finish);
    const int normal = add_texture(model_, name, std::move(made.pictures.normal), false);
    const int surface = add_texture(model_, name, std::move(made.pictures.surface), false);
    return known->second = {std::move(made.pictures.colour), made.painted, normal, surface};
  }

  scene::Model& model_;
  int first_brick_ = scene::no_index;
  std::map<std::tuple<KindSheet, WallLook, int>, int> of_kinds_;
  std::map<std::pair<KindSheet, WallLook>, Painted> painted_;
};

/// Whether one of the words of a name says that it is a window or a door; "WallWithWindows" is a wall.
bool names_opening(std::string_view name) {
  static const std::set<std::string_view> openings{"window", "windows", "ifcwindow",
                                                   "door",   "doors",   "ifcdoor"};
  std::string word;
  for (const char c : std::string(name) + ' ')
    if (std::isalpha(static_cast<unsigned char>(c))) {
      word += char(std::tolower(static_cast<unsigned char>(c)));
    } else {
      if (openings.contains(word)) return true;
      word.clear();
    }
  return false;
}

/// The parts that are windows and doors which the model has itself.
std::set<const scene::Part*> opening_parts(const scene::Model& model) {
  std::set<const scene::Part*> openings;
  for (const scene::Part& part : model.parts)
    if (names_opening(part.object) || names_opening(model.materials[std::size_t(part.material)].name))
      openings.insert(&part);
  return openings;
}

/// The middles of their triangles.
std::vector<glm::vec3> middles_of(const std::set<const scene::Part*>& openings, const scene::Model& model) {
  const std::vector<glm::mat4> pose = scene::rest_pose(model);
  std::vector<glm::vec3> middles;
  for (const scene::Part* part : openings)
    for (std::size_t i = 0; i + 2 < part->mesh.indices.size(); i += 3) {
      glm::vec3 sum(0.0f);
      for (std::size_t k = 0; k < 3; ++k) sum += part->mesh.positions[part->mesh.indices[i + k]];
      middles.emplace_back(pose[std::size_t(part->node)] * glm::vec4(sum / 3.0f, 1.0f));
    }
  return middles;
}

/// Heights of the lowest and of the highest point.
std::pair<float, float> bottom_and_top(const std::vector<ModelTriangle>& pieces) {
  float bottom_m = 1e30f, top_m = -1e30f;
  for (const ModelTriangle& piece : pieces)
    for (const glm::vec3& corner : piece.corners)
      bottom_m = std::min(bottom_m, corner.z), top_m = std::max(top_m, corner.z);
  return {bottom_m, top_m};
}

/// Where a strip of wall takes its texture from.
struct StripSheet {
  int material;
  glm::vec2 cells;  ///< across and up the sheet
};

/// Dresses one panel, strip by strip from its foot to its top.
class Dresser {
 public:
  Dresser(DressedParts& parts, const std::vector<ModelTriangle>& walls, WallMaterials& materials,
          std::uint64_t seed, bool has_openings)
      : parts_(parts), walls_(walls), materials_(materials), seed_(seed), has_openings_(has_openings) {}

  void dress(const WallPanel& panel) {
    panel_ = &panel;
    style_ = style_of(panel, seed_);
    pieces_.clear();
    for (const std::size_t i : panel.triangles) pieces_.push_back(walls_[i]);
    pieces_ = clipped(pieces_, panel.along, panel.low.x, panel.high.x);
    const auto [bottom_m, top_m] = bottom_and_top(pieces_);
    foot_m_ = panel.low.y - bottom_m > seam_m ? panel.low.y : bottom_m;
    eaves_m_ = top_m - panel.eaves_m > seam_m ? panel.eaves_m : top_m;
    const float width_m = panel.run.length_m, height_m = eaves_m_ - foot_m_;
    Random random(seed_ + 104729 * panel.building, std::uint64_t(std::abs(panel.run.place_m)));
    const bool is_side = !panel.stands_on_ground && !panel.hangs && width_m < narrowest_on_roof_m;
    if (!has_openings_ || panel.has_openings || panel.is_party_wall || is_side || !is_large(panel))
      return plain(bottom_m, top_m);
    plain(bottom_m, foot_m_);
    if (panel.kind.use == scene::BuildingUse::church)
      add_nave(height_m);
    else if (panel.kind.use == scene::BuildingUse::industry)
      add_gates(width_m, height_m, gates_m, random);
    else if (panel.stands_on_ground && height_m < shed_m && !style_.look)
      add_shed(width_m, random);
    else if (panel.kind.use == scene::BuildingUse::shed || (panel.stands_on_ground && height_m < shed_m))
      add_gates(width_m, height_m, low_gates_m, random);
    else
      add_house_front(height_m, random);
    plain(eaves_m_, top_m);
  }

 private:
  void add_shed(float width_m, Random& random) {
    const bool has_garage = width_m > garage_m && random.chance(0.5f) && !is_round();
    const RunBays bays = bays_of(panel_->run, brick_bay_m);
    add(sheet_of(BrickSheet::street), foot_m_, eaves_m_,
        {float(has_garage ? garage_bay : small_window_bay) + bays.shift, float(StreetBand::sheds)},
        {bays.count, 1.0f});
  }

  bool is_round() const { return panel_->run.facets > 1; }

  /// Gates on some flat walls at the ground, no windows.
  void add_gates(float width_m, float height_m, float strip_m, Random& random) {
    const glm::vec2 cell_m = layout_of(KindSheet::gates).cell_m * (strip_m / gates_m);
    const bool has_gates =
        panel_->stands_on_ground && width_m > 0.7f * cell_m.x && random.chance(0.5f) && !is_round();
    if (!has_gates) return plain(foot_m_, eaves_m_);
    const float top_m = foot_m_ + std::min(strip_m, height_m);
    const float bays = std::max(1.0f, std::round(width_m / cell_m.x));
    add(sheet_of(KindSheet::gates), foot_m_, top_m, {0.0f, 0.0f}, {bays, 1.0f});
    plain(top_m, eaves_m_);
  }

  /// Tall windows that begin above the heads of people.
  void add_nave(float height_m) {
    const float top_m = std::min(eaves_m_ - nave_top_m, foot_m_ + nave_foot_m + nave_m);
    if (height_m < lowest_nave_m) return plain(foot_m_, eaves_m_);
    const RunBays bays = bays_of(panel_->run, nave_bay_m);
    plain(foot_m_, foot_m_ + nave_foot_m);
    add(sheet_of(KindSheet::nave), foot_m_ + nave_foot_m, top_m, {bays.shift, 0.0f}, {bays.count, 1.0f});
    plain(top_m, eaves_m_);
  }

  /// The height of a storey: of the file's number of storeys where that is believable.
  float storey_m(float height_m) const {
    if (panel_->kind.storeys == 0 || !panel_->stands_on_ground) return style_.storey_m;
    const float given_m = (height_m - cornice_m) / float(panel_->kind.storeys);
    return given_m > min_storey_m && given_m < max_storey_m ? given_m : style_.storey_m;
  }

  /// The street's storey, those above it, and a plain rest where there is less than a storey.
  void add_house_front(float height_m, Random& random) {
    const RunBays bays = bays_of(panel_->run, style_.bay_m);
    const float each_m = storey_m(height_m);
    const float street_m = !panel_->stands_on_ground ? 0.0f : each_m + (style_.is_shop ? 0.6f : 0.15f);
    const float rest_m = height_m - street_m - cornice_m;
    const float storeys = std::max(0.0f, std::round(rest_m / each_m));
    const float street_top = foot_m_ + (storeys > 0.0f ? street_m : std::min(height_m, max_ground_storey_m));
    if (panel_->stands_on_ground) {
      const StreetBand band = style_.is_shop ? StreetBand::shops : style_.band;
      const int span = std::min(int(bays.count), brick_bays);  // the first bays that hold a door
      const int start = (brick_bays + door_bay - random.index(span)) % brick_bays;
      const float row = !style_.look ? float(band) : style_.is_shop ? 1.0f : 0.0f;
      // Up to a little below the next row of the sheet, whose plinth would be a dark line under the storeys.
      add(style_.look ? sheet_of(KindSheet::street) : sheet_of(BrickSheet::street), foot_m_, street_top,
          {float(start) + bays.shift, row}, {bays.count, 1.0f - below_next_row});
    }
    if (storeys == 0.0f) return plain(street_top, eaves_m_);
    const float start = float(random.index(brick_bays)), row = float(random.index(brick_storeys));
    add(style_.look ? sheet_of(KindSheet::storeys) : sheet_of(BrickSheet::storeys),
        panel_->stands_on_ground ? street_top : foot_m_, eaves_m_, {start + bays.shift, row},
        {bays.count, storeys});
  }

  /// The wall without openings.
  void plain(float low_m, float high_m) {
    const glm::vec2 cell_m(brick_bay_m, brick_storey_m);
    const StripSheet sheet = style_.look ? sheet_of(KindSheet::plain) : sheet_of(BrickSheet::plain);
    glm::vec2 count = glm::vec2(panel_->run.length_m, high_m - low_m) / cell_m;
    if (panel_->run.is_ring)  // whole sheets, or the ring would have a seam
      count.x = std::max(1.0f, std::round(count.x / sheet.cells.x)) * sheet.cells.x;
    add(sheet, low_m, high_m, {0.0f, 0.0f}, count);
  }

  StripSheet sheet_of(BrickSheet sheet) {
    return {materials_.brick(sheet, style_.look ? 0 : style_.colour),
            brick_sheet_m(sheet) / glm::vec2(brick_bay_m, brick_storey_m)};
  }

  /// The sheet in the house's look; gates of common bricks are those of no certain time.
  StripSheet sheet_of(KindSheet sheet) {
    return {materials_.of(sheet, style_.look.value_or(WallLook{}), style_.colour), layout_of(sheet).count};
  }

  /// The panel's part of a strip of its run between two heights: `count` bays and storeys from the cell
  /// `first` of a sheet on.
  void add(const StripSheet& sheet, float low_m, float high_m, glm::vec2 first, glm::vec2 count) {
    if (!(high_m > low_m)) return;
    const glm::vec2 low(panel_->low.x - panel_->run.before_m, low_m);
    const glm::vec2 size = glm::max(glm::vec2(panel_->run.length_m, high_m - low_m), 1e-4f);
    for (const ModelTriangle& piece : clipped(pieces_, {0.0f, 0.0f, 1.0f}, low_m, high_m)) {
      std::array<glm::vec2, 3> uvs;
      std::array<glm::vec3, 3> normals;
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::vec2 place(glm::dot(piece.corners[k], panel_->along), piece.corners[k].z);
        const glm::vec2 at = (first + (place - low) / size * count) / sheet.cells;
        uvs[k] = {at.x, -at.y};
        if (is_round()) normals[k] = normal_at(place.x);
      }
      if (is_round())
        parts_.add(piece, sheet.material, uvs, normals);
      else
        parts_.add(piece, sheet.material, uvs);
    }
  }

  /// Normal of the curve that the panel is a facet of, at a place along it.
  glm::vec3 normal_at(float place) const {
    const float fraction = (place - panel_->low.x) / std::max(panel_->high.x - panel_->low.x, 1e-4f);
    return glm::normalize(glm::mix(panel_->run.first_normal, panel_->run.last_normal, fraction));
  }

  DressedParts& parts_;
  const std::vector<ModelTriangle>& walls_;
  WallMaterials& materials_;
  std::uint64_t seed_;
  bool has_openings_;
  const WallPanel* panel_ = nullptr;
  HouseStyle style_{};
  std::vector<ModelTriangle> pieces_;     ///< of the panel
  float foot_m_ = 0.0f, eaves_m_ = 0.0f;  ///< of the panel: below and above are walls without openings
};

}  // namespace

std::size_t add_facades(scene::Model& model, std::string_view target, std::uint64_t seed, bool has_openings) {
  const std::set<const scene::Part*> own_openings = opening_parts(model);
  const std::vector<glm::vec3> openings = middles_of(own_openings, model);
  const std::vector<ModelTriangle> walls =
      take_triangles(model, target, [&](const scene::Part& part, glm::vec3 normal) {
        return std::abs(normal.z) < steepest_roof_z && !own_openings.contains(&part) &&
               model.materials[std::size_t(part.material)].base_colour_texture == scene::no_index;
      });
  if (walls.empty()) return 0;
  WallMaterials materials(model);
  DressedParts parts(model, "facade");
  Dresser dresser(parts, walls, materials, seed, has_openings);
  const Undersides undersides(model);
  for (WallPanel& panel : wall_panels(walls, openings)) {
    panel.hangs = undersides.begin_at(panel);
    panel.stands_on_ground = panel.stands_on_ground && !panel.hangs;
    dresser.dress(panel);
  }
  return walls.size();
}

}  // namespace parvis::dressing
