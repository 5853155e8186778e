#include "places/dressing/facades.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <set>
#include <string>

#include "base/parallel.h"
#include "base/random.h"
#include "places/dressing/brick_texture.h"
#include "places/dressing/street_level_texture.h"
#include "places/dressing/wall_panels.h"
#include "scene/data/model.h"

namespace parvis::dressing {

namespace {

constexpr float steepest_roof_z = 0.34f;  // cosine of 70 degrees: above it a surface is roof
constexpr float shed_m = 2.9f;            // lower: nobody lives there
constexpr float narrowest_on_roof_m =
    5.0f;                         // of a wall above a lower roof: else it is the side of the next house
constexpr float garage_m = 2.7f;  // width of a shed with a door
constexpr float max_ground_storey_m = 4.2f, cornice_m = 0.2f;  // no storey is higher; above the last one
constexpr float shop_share = 0.2f, two_storeys_m = 5.4f;       // of houses from so high on
constexpr float same_eaves_m = 0.9f;                           // houses of a row differ where their eaves do
constexpr float seam_m = 1e-3f;                                // no strip is lower
constexpr std::size_t sheet_count = 3;

/// What the walls of one house have in common.
struct HouseStyle {
  int colour;
  float storey_m, bay_m;
  StreetBand band;
  bool is_shop;
};

HouseStyle style_of(const WallPanel& panel, std::uint64_t seed) {
  const auto height = std::uint64_t(std::lround(panel.eaves_m / same_eaves_m) + 100'000);
  Random random(seed + 7919 * panel.building, height);
  HouseStyle style;
  style.colour = random.index(brick_colour_count);
  style.storey_m = random.uniform(2.8f, 3.35f), style.bay_m = random.uniform(2.5f, 3.3f);
  style.is_shop = random.chance(shop_share) && panel.eaves_m - panel.low.y > two_storeys_m;
  style.band = random.chance(0.5f) ? StreetBand::houses : StreetBand::wide_panes;
  return style;
}

/// Material 3 i + sheet from the first index, of brick colour i.
int add_wall_materials(scene::Model& model) {
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
      material.relief_m = is_plain ? 0.0f : city::canvas_relief_m;
      material.is_double_sided = true;
    }
  }
  return first;
}

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

/// Of the lowest and of the highest point.
std::pair<float, float> bottom_and_top(const std::vector<ModelTriangle>& pieces) {
  float bottom_m = 1e30f, top_m = -1e30f;
  for (const ModelTriangle& piece : pieces)
    for (const glm::vec3& corner : piece.corners)
      bottom_m = std::min(bottom_m, corner.z), top_m = std::max(top_m, corner.z);
  return {bottom_m, top_m};
}

/// Dresses one panel, strip by strip from its foot to its top.
class Dresser {
 public:
  Dresser(DressedParts& parts, const std::vector<ModelTriangle>& walls, int first_material,
          std::uint64_t seed)
      : parts_(parts), walls_(walls), first_material_(first_material), seed_(seed) {}

  void dress(const WallPanel& panel) {
    panel_ = &panel;
    style_ = style_of(panel, seed_);
    pieces_.clear();
    for (const std::size_t i : panel.triangles) pieces_.push_back(walls_[i]);
    pieces_ = clipped(pieces_, panel.along, panel.low.x, panel.high.x);
    const auto [bottom_m, top_m] = bottom_and_top(pieces_);
    foot_m_ = panel.low.y - bottom_m > seam_m ? panel.low.y : bottom_m;
    eaves_m_ = top_m - panel.eaves_m > seam_m ? panel.eaves_m : top_m;
    const float width_m = panel.high.x - panel.low.x, height_m = eaves_m_ - foot_m_;
    Random random(seed_ + 104729 * panel.building, std::uint64_t(std::abs(panel.low.x + panel.offset_m)));
    const bool is_side = !panel.stands_on_ground && width_m < narrowest_on_roof_m;
    if (panel.has_openings || panel.is_party_wall || is_side || !is_large(panel))
      return plain(bottom_m, top_m);
    plain(bottom_m, foot_m_);
    if (panel.stands_on_ground && height_m < shed_m)
      add_shed(width_m, random);
    else
      add_house_front(width_m, height_m, random);
    plain(eaves_m_, top_m);
  }

 private:
  void add_shed(float width_m, Random& random) {
    const bool has_garage = width_m > garage_m && random.chance(0.5f);
    const float bays = std::max(1.0f, std::round(width_m / brick_bay_m));
    add(BrickSheet::street, foot_m_, eaves_m_,
        {has_garage ? garage_bay : small_window_bay, float(StreetBand::sheds)}, {bays, 1.0f});
  }

  /// The street's storey, those above it, and a plain rest where there is less than a storey.
  void add_house_front(float width_m, float height_m, Random& random) {
    const float bays = std::max(1.0f, std::round(width_m / style_.bay_m));
    const float street_m =
        !panel_->stands_on_ground ? 0.0f : style_.storey_m + (style_.is_shop ? 0.6f : 0.15f);
    const float rest_m = height_m - street_m - cornice_m;
    const float storeys = std::max(0.0f, std::round(rest_m / style_.storey_m));
    const float street_top = foot_m_ + (storeys > 0.0f ? street_m : std::min(height_m, max_ground_storey_m));
    if (panel_->stands_on_ground) {
      const StreetBand band = style_.is_shop ? StreetBand::shops : style_.band;
      const int span = std::min(int(bays), brick_bays);  // the first bays that hold a door
      const int start = (brick_bays + door_bay - random.index(span)) % brick_bays;
      add(BrickSheet::street, foot_m_, street_top, {start, float(band)}, {bays, 1.0f});
    }
    if (storeys == 0.0f) return plain(street_top, eaves_m_);
    const float start = float(random.index(brick_bays)), row = float(random.index(brick_storeys));
    add(BrickSheet::storeys, panel_->stands_on_ground ? street_top : foot_m_, eaves_m_, {start, row},
        {bays, storeys});
  }

  /// Bricks without openings.
  void plain(float low_m, float high_m) {
    const glm::vec2 cell_m(brick_bay_m, brick_storey_m);
    add(BrickSheet::plain, low_m, high_m, {0.0f, 0.0f},
        glm::vec2(panel_->high.x - panel_->low.x, high_m - low_m) / cell_m);
  }

  /// A strip of the panel between two heights: `count` bays and storeys from the cell `first` of a sheet on.
  void add(BrickSheet sheet, float low_m, float high_m, glm::vec2 first, glm::vec2 count) {
    if (!(high_m > low_m)) return;
    const glm::vec2 low(panel_->low.x, low_m);
    const glm::vec2 size = glm::max(glm::vec2(panel_->high.x - panel_->low.x, high_m - low_m), 1e-4f);
    const glm::vec2 cells =
        brick_sheet_m(sheet) / glm::vec2(brick_bay_m, brick_storey_m);  // across and up the sheet
    const int material = first_material_ + int(sheet_count) * style_.colour + int(sheet);
    for (const ModelTriangle& piece : clipped(pieces_, {0.0f, 0.0f, 1.0f}, low_m, high_m)) {
      std::array<glm::vec2, 3> uvs;
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::vec2 place(glm::dot(piece.corners[k], panel_->along), piece.corners[k].z);
        const glm::vec2 at = (first + (place - low) / size * count) / cells;
        uvs[k] = {at.x, -at.y};
      }
      parts_.add(piece, material, uvs);
    }
  }

  DressedParts& parts_;
  const std::vector<ModelTriangle>& walls_;
  int first_material_;
  std::uint64_t seed_;
  const WallPanel* panel_ = nullptr;
  HouseStyle style_{};
  std::vector<ModelTriangle> pieces_;     ///< of the panel
  float foot_m_ = 0.0f, eaves_m_ = 0.0f;  ///< of the panel: below and above are bricks without openings
};

}  // namespace

std::size_t add_facades(scene::Model& model, std::string_view target, std::uint64_t seed) {
  const std::set<const scene::Part*> own_openings = opening_parts(model);
  const std::vector<glm::vec3> openings = middles_of(own_openings, model);
  const std::vector<ModelTriangle> walls =
      take_triangles(model, target, [&](const scene::Part& part, glm::vec3 normal) {
        return std::abs(normal.z) < steepest_roof_z && !own_openings.contains(&part) &&
               model.materials[std::size_t(part.material)].base_colour_texture == scene::no_index;
      });
  if (walls.empty()) return 0;
  const int first_material = add_wall_materials(model);
  DressedParts parts(model, "facade");
  Dresser dresser(parts, walls, first_material, seed);
  for (const WallPanel& panel : wall_panels(walls, openings)) dresser.dress(panel);
  return walls.size();
}

}  // namespace parvis::dressing
