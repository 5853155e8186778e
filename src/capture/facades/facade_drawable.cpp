#include "capture/facades/facade_drawable.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "capture/facades/placed_facade.h"
#include "graphics/gl/uniform_block.h"
#include "graphics/render/bindings.h"
#include "graphics/render/static_things.h"
#include "graphics/render/view_programs.h"
#include "graphics/shading/glsl.h"
#include "scene/data/scene.h"
#include "scene/data/sun_shadows.h"

namespace parvis::facades {
namespace {

namespace block_shared {
using namespace parvis::shading;
#include "capture/facades/facade_block.glsl"
}  // namespace block_shared

using render::Culling;
using render::Extents;
using render::Pass;
using render::ViewKind;

/// Triangles of one surface, culled together.
struct SurfaceRange {
  std::size_t first = 0, count = 0;
  Bounds bounds;  ///< in the facade's frame
  bool is_backdrop = false;
};

std::vector<SurfaceRange> ranges_of(const PackedFacade& facade) {
  std::vector<SurfaceRange> ranges;
  for (std::size_t t = 0; t < facade.triangle_count(); ++t) {
    if (t == 0 || facade.surface_of_triangle[t] != facade.surface_of_triangle[t - 1])
      ranges.push_back({t, 0, {}, facade.surfaces[facade.surface_of_triangle[t]] == backdrop_name});
    ++ranges.back().count;
    for (std::size_t k = 0; k < 3; ++k) ranges.back().bounds.add(facade.corners[3 * t + k]);
  }
  return ranges;
}

Bounds solid_bounds(const PackedFacade& facade) {
  Bounds bounds;
  for (const SurfaceRange& range : ranges_of(facade))
    if (!range.is_backdrop) bounds.add(range.bounds);
  return bounds;
}

/// Data shared by facades made of one packed file.
struct LoadedFacade {
  FacadeTextures textures;
  ViewChooser chooser;
  std::vector<SurfaceRange> ranges;
  Bounds bounds, solid_bounds;  ///< of all, and without the backdrop
  bool has_holes = false;
  std::uint64_t max_texture_bytes = 0;
  unsigned residency = 0;  ///< counts the changes of what is resident
};

struct ShownFacade {
  LoadedFacade* loaded = nullptr;
  glm::mat4 world_from_facade{1.0f};
  float radiance_of_exposed = 1.0f;
  float kept_in_shadow = 1.0f;
  bool is_visible = true;
  bool casts_shadow = true;
};

/// The photographs chosen for an eye, in the frame of the facade that is shown.
struct ChosenForEye {
  const LoadedFacade* loaded = nullptr;
  glm::vec3 eye{0.0f};
  float pixel_angle = 0.0f;
  unsigned residency = 0;  ///< of LoadedFacade, when they were chosen
  ChosenLists lists;
};

/// Doublings of a pixel's angle from which on photographs are chosen again: their mipmaps' levels change.
constexpr float largest_zoom_step = 0.1f;

/// Radians per pixel in the middle of a view.
float pixel_angle_of(const render::View& view) {
  const glm::mat4& clip = view.clip_from_world;
  const float scale = glm::length(glm::vec3(clip[0][1], clip[1][1], clip[2][1]));
  return 2.0f / std::max(scale * float(view.height), 1e-6f);
}

/// A run of triangles of a facade.
struct DrawnRange {
  std::size_t facade, first, count;
};

/// Whether there is something that its photographs do not show, whose shadow may fall on a facade
/// (light/inserted_shadows.h).
bool receives_inserted(const scene::Scene& scene) {
  bool receives = !scene.objects.empty();
  scene::for_each_traced_kind(scene, [&](const scene::TracedKind& kind, int) {
    receives = receives || (!kind.is_recorded && kind.count(scene) > 0);
  });
  return receives;
}

struct Programs {
  render::ViewPrograms solid, cutout;
  render::ViewPrograms chosen;  ///< of triangles whose photographs were chosen once for all their pixels

  /// `receives`: shadows of what was inserted. A renderer in software would look them up where there are
  /// none, too, which takes as long as a facade without them.
  static Result<Programs> create(bool receives) {
    const auto programs_of = [&](gl::Defines defines) {
      defines.emplace_back("HAS_BACKS", "");
      defines.emplace_back("IS_RECORDED", "");
      if (receives) defines.emplace_back("RECEIVES_INSERTED", "");
      return render::ViewPrograms::create(
          {"capture/facades/facade_vertex.glsl", "capture/facades/facade_surface.glsl", std::move(defines)});
    };
    Result<render::ViewPrograms> solid = programs_of({}), cutout = programs_of({{"HAS_HOLES", ""}}),
                                 chosen = programs_of({{"IS_CHOSEN", ""}});
    for (const auto* one : {&solid, &cutout, &chosen})
      if (!*one) return one->errors();
    return Programs{*std::move(solid), *std::move(cutout), *std::move(chosen)};
  }
};

class FacadeDrawable final : public render::Drawable {
 public:
  static Result<std::unique_ptr<render::Drawable>> create(const scene::Scene& scene, int first_thing,
                                                          Compared compared, HeldTexels held) {
    const bool receives = receives_inserted(scene);
    Result<Programs> programs = Programs::create(receives);
    if (!programs) return programs.errors();
    std::unique_ptr<FacadeDrawable> made(
        new FacadeDrawable(first_thing, compared, held, receives, *std::move(programs)));
    if (Status status = made->load(scene); !status) return status.errors();
    made->update(scene);
    return std::unique_ptr<render::Drawable>(std::move(made));
  }

  void update(const scene::Scene& scene) override {
    // A file that cannot be loaded was an error when the scene was read; a full graphics memory shows
    // nothing.
    if (!load(scene)) return;
    if (const bool receives = receives_inserted(scene); receives != receives_inserted_)
      if (Result<Programs> programs = Programs::create(receives); programs)
        programs_ = *std::move(programs), receives_inserted_ = receives;
    const auto& [facades, makers] = scene.data<scene::ItemsOf<PlacedFacade>>();
    const auto& shadows = scene.data<scene::SunShadows>();
    things_.begin_update(facades.size());
    chosen_.resize(facades.size()), shown_.resize(facades.size());
    for (std::size_t i = 0; i < facades.size(); ++i) {
      const PlacedFacade& placed = facades[i];
      LoadedFacade& loaded = *loaded_.at(placed.facade);
      shown_[i] = {&loaded,
                   placed.world_from_facade,
                   placed.brightness / scene.exposure,
                   placed.kept_in_shadow,
                   placed.is_visible,
                   shadows.casts_item_of(makers[i])};
      things_.update(i, {&loaded, placed.world_from_facade, placed.is_visible,
                         transformed(placed.world_from_facade, loaded.bounds),
                         transformed(placed.world_from_facade, loaded.solid_bounds)});
    }
  }

  void renumber(int first_thing) override { first_thing_ = first_thing; }
  Extents extents() const override { return things_.extents(); }

  void prepare(const render::View& view, const Culling& culling) override {
    std::vector<DrawnRange>& list = list_of(view);
    list.clear();
    take_in_photographs(view);
    for (std::size_t i = 0; i < shown_.size(); ++i) {
      if (!shown_[i].is_visible || !culling.shows(first_thing_ + int(i), {false, things_.is_newcomer(i)}) ||
          !culling.may_see(things_.bounds(i)))
        continue;
      if (view.kind == ViewKind::shadow && !shown_[i].casts_shadow) continue;
      choose(i, view);
      for (const SurfaceRange& range : shown_[i].loaded->ranges) {
        const Bounds bounds = transformed(shown_[i].world_from_facade, range.bounds);
        if (range.is_backdrop && view.kind == ViewKind::shadow) continue;
        if (!culling.may_see(bounds) || culling.is_hidden(bounds)) continue;
        const bool joins =
            !list.empty() && list.back().facade == i && list.back().first + list.back().count == range.first;
        if (joins)
          list.back().count += range.count;
        else
          list.push_back({i, range.first, range.count});
      }
    }
  }

  void draw(const render::View& view, Pass pass) override {
    if (pass == Pass::cutout) draw_with(programs_.cutout, view, Drawn::all);
    if (pass != Pass::opaque) return;
    draw_with(programs_.chosen, view, Drawn::chosen);
    draw_with(programs_.solid, view, Drawn::others);
  }

 private:
  FacadeDrawable(int first_thing, Compared compared, HeldTexels held, bool receives, Programs programs)
      : first_thing_(first_thing),
        compared_(compared),
        held_(held),
        receives_inserted_(receives),
        programs_(std::move(programs)) {}

  /// Which triangles: all, of facades with holes; of the others those whose photographs were chosen once for
  /// all pixels, or the rest.
  enum class Drawn : std::uint8_t { all, chosen, others };

  void draw_with(const render::ViewPrograms& programs, const render::View& view, Drawn drawn) {
    const gl::Program* program = nullptr;
    std::size_t bound = shown_.size();
    for (const DrawnRange& range : list_of(view)) {
      const ShownFacade& facade = shown_[range.facade];
      const ChosenLists& lists = chosen_for(range.facade, view)->lists;
      if (facade.loaded->has_holes != (drawn == Drawn::all)) continue;
      if (drawn == Drawn::chosen && !lists.has_chosen()) continue;
      if (!program) program = programs.use(view);
      if (!program) return;
      if (bound != range.facade) bind(*program, facade, lists, first_thing_ + int(range.facade));
      bound = range.facade;
      if (drawn == Drawn::all || !lists.has_chosen())
        facade.loaded->textures.draw(range.first, range.count);
      else
        lists.draw(range.first, range.count, drawn == Drawn::chosen);
    }
  }

  /// Facades that are new in the scene; those that left it are given back.
  Status load(const scene::Scene& scene) {
    Loaded kept;
    std::map<std::shared_ptr<const PackedFacade>, std::uint64_t> max_bytes;  // the largest of all its nodes'
    for (const PlacedFacade& placed : scene.items<PlacedFacade>())
      max_bytes[placed.facade] = std::max(max_bytes[placed.facade], placed.max_texture_bytes);
    for (const auto& [facade, max_texture_bytes] : max_bytes) {
      const auto known = loaded_.find(facade);
      if (known != loaded_.end() && known->second->max_texture_bytes == max_texture_bytes) continue;
      Result<FacadeTextures> textures = FacadeTextures::create(*facade, held_, max_texture_bytes);
      if (!textures) return textures.errors();  // nothing has changed: what is shown stays
      kept.emplace(facade,
                   std::make_unique<LoadedFacade>(LoadedFacade{
                       *std::move(textures), ViewChooser(*facade), ranges_of(*facade), facade->bounds(),
                       solid_bounds(*facade), has_holes(*facade), max_texture_bytes}));
    }
    if (!kept.empty()) chosen_.clear();  // a new one may lie where one that is gone was chosen for
    for (const auto& [facade, bytes] : max_bytes)
      if (!kept.contains(facade)) kept.insert(loaded_.extract(facade));
    loaded_ = std::move(kept);
    return Ok{};
  }

  /// The photographs nearest to the viewer become resident. Other views (shadows, reflections) use what is
  /// there, unless nothing is.
  void take_in_photographs(const render::View& view) {
    for (const auto& [file, loaded] : loaded_) {
      const bool is_empty = std::ranges::count(loaded->textures.resident(), 1) == 0;
      if (view.kind != ViewKind::main && !is_empty) continue;
      std::vector<glm::vec3> eyes;
      for (const ShownFacade& shown : shown_)
        if (shown.loaded == loaded.get() && shown.is_visible)
          eyes.emplace_back(glm::inverse(shown.world_from_facade) * glm::vec4(view.position_in_world, 1.0f));
      if (loaded->textures.follow(eyes)) ++loaded->residency;
    }
  }

  std::optional<ChosenForEye>& chosen_for(std::size_t facade, const render::View& view) {
    return chosen_[facade][view.kind == ViewKind::main ? 0 : 1];
  }

  /// Chooses the photographs for a view's eye, unless the eye has hardly moved. Shadows have no colour.
  void choose(std::size_t facade, const render::View& view) {
    const ShownFacade& shown = shown_[facade];
    std::optional<ChosenForEye>& chosen = chosen_for(facade, view);
    const glm::mat4 facade_from_world = glm::inverse(shown.world_from_facade);
    const glm::vec3 eye(facade_from_world * glm::vec4(view.position_in_world, 1.0f));
    const float pixel_angle = pixel_angle_of(view);
    const ViewChooser& chooser = shown.loaded->chooser;
    const auto serves = [&](const ChosenForEye& before) {
      if (before.loaded != shown.loaded || before.residency != shown.loaded->residency) return false;
      return view.kind == ViewKind::shadow ||
             (glm::distance(eye, before.eye) <= chooser.step(before.eye) &&
              std::abs(std::log2(pixel_angle / before.pixel_angle)) <= largest_zoom_step);
    };
    if (chosen && serves(*chosen)) return;
    if (!chosen || chosen->loaded != shown.loaded)
      chosen = ChosenForEye{shown.loaded, eye, pixel_angle, 0, shown.loaded->textures.chosen_lists()};
    chosen->eye = eye, chosen->pixel_angle = pixel_angle, chosen->residency = shown.loaded->residency;
    const FacadeTextures& textures = shown.loaded->textures;
    chosen->lists.set(
        compared_ == Compared::all ? chooser.all() : chooser.choice(eye, pixel_angle, textures.resident()),
        textures.resident_tiles());
  }

  void bind(const gl::Program& program, const ShownFacade& facade, const ChosenLists& lists,
            int thing) const {
    facade.loaded->textures.bind(program, lists);
    const glm::mat4 facade_from_world = glm::inverse(facade.world_from_facade);
    block_.bind(program, {.world_from_facade = facade.world_from_facade,
                          .facade_from_world = facade_from_world,
                          .radiance_of_exposed = facade.radiance_of_exposed,
                          .kept_of_shadows = facade.kept_in_shadow,
                          .facade_units_log2 = std::log2(glm::length(glm::vec3(facade_from_world[0]))),
                          .facade_thing = thing});
    glDisable(GL_CULL_FACE);
  }

  std::vector<DrawnRange>& list_of(const render::View& view) {
    return view.kind == ViewKind::main ? main_list_ : other_list_;
  }

  using Loaded = std::map<std::shared_ptr<const PackedFacade>, std::unique_ptr<LoadedFacade>>;

  int first_thing_;
  Compared compared_;
  HeldTexels held_;
  bool receives_inserted_;
  Programs programs_;
  gl::UniformBlock<block_shared::Facade> block_{"Facade", render::first_drawable_block};
  Loaded loaded_;
  std::vector<ShownFacade> shown_;
  std::vector<std::array<std::optional<ChosenForEye>, 2>> chosen_;  ///< per facade: main view, others
  render::StaticThings things_;
  std::vector<DrawnRange> main_list_, other_list_;
};

}  // namespace

render::DrawableKind facades_kind(Compared compared, HeldTexels held) {
  return {traced_facades(), [compared, held](const scene::Scene& scene, int first_thing) {
            return FacadeDrawable::create(scene, first_thing, compared, held);
          }};
}

}  // namespace parvis::facades
