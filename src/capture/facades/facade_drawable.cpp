#include "capture/facades/facade_drawable.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "capture/facades/placed_facade.h"
#include "graphics/render/static_things.h"
#include "graphics/render/view_programs.h"
#include "scene/data/scene.h"
#include "scene/data/sun_shadows.h"

namespace parvis::facades {
namespace {

using render::Culling;
using render::Extents;
using render::Pass;
using render::View;
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

/// What facades made of one packed file share.
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
  unsigned residency = 0;  ///< of LoadedFacade, when they were chosen
  ChosenLists lists;
};

/// Radians per pixel in the middle of a view.
float pixel_angle_of(const View& view) {
  const glm::mat4& clip = view.clip_from_world;
  const float scale = glm::length(glm::vec3(clip[0][1], clip[1][1], clip[2][1]));
  return 2.0f / std::max(scale * float(view.height), 1e-6f);
}

/// A run of triangles of a facade.
struct DrawnRange {
  std::size_t facade, first, count;
};

class FacadeDrawable final : public render::Drawable {
 public:
  static Result<std::unique_ptr<render::Drawable>> create(const scene::Scene& scene, int first_thing,
                                                          Compared compared, HeldTexels held) {
    const auto programs_of = [](gl::Defines defines) {
      defines.emplace_back("HAS_BACKS", "");
      defines.emplace_back("IS_RECORDED", "");
      defines.emplace_back("RECEIVES_INSERTED", "");
      return render::ViewPrograms::create(
          {"capture/facades/facade_vertex.glsl", "capture/facades/facade_surface.glsl", std::move(defines)});
    };
    Result<render::ViewPrograms> solid = programs_of({}), cutout = programs_of({{"HAS_HOLES", ""}});
    if (!solid) return solid.errors();
    if (!cutout) return cutout.errors();
    std::unique_ptr<FacadeDrawable> made(
        new FacadeDrawable(first_thing, compared, held, *std::move(solid), *std::move(cutout)));
    if (Status status = made->load(scene); !status) return status.errors();
    made->update(scene);
    return std::unique_ptr<render::Drawable>(std::move(made));
  }

  void update(const scene::Scene& scene) override {
    // A file that cannot be loaded was an error when the scene was read; a full graphics memory shows
    // nothing.
    if (!load(scene)) return;
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

  Extents extents() const override { return things_.extents(); }

  void prepare(const View& view, const Culling& culling) override {
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

  void draw(const View& view, Pass pass) override {
    if (pass == Pass::blend) return;
    const gl::Program* program = nullptr;
    std::size_t bound = shown_.size();
    for (const DrawnRange& range : list_of(view)) {
      const ShownFacade& facade = shown_[range.facade];
      if (facade.loaded->has_holes != (pass == Pass::cutout)) continue;
      if (!program) program = (pass == Pass::cutout ? cutout_ : solid_).use(view);
      if (!program) return;
      if (bound != range.facade)
        bind(*program, facade, chosen_for(range.facade, view)->lists, first_thing_ + int(range.facade));
      bound = range.facade;
      facade.loaded->textures.draw(range.first, range.count);
    }
  }

 private:
  FacadeDrawable(int first_thing, Compared compared, HeldTexels held, render::ViewPrograms solid,
                 render::ViewPrograms cutout)
      : first_thing_(first_thing),
        compared_(compared),
        held_(held),
        solid_(std::move(solid)),
        cutout_(std::move(cutout)) {}

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
    return Done{};
  }

  /// The photographs nearest to the viewer become resident. Other views (shadows, reflections) use what is
  /// there, unless nothing is.
  void take_in_photographs(const View& view) {
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

  std::optional<ChosenForEye>& chosen_for(std::size_t facade, const View& view) {
    return chosen_[facade][view.kind == ViewKind::main ? 0 : 1];
  }

  /// Chooses the photographs for a view's eye, unless the eye has hardly moved. Shadows have no colour.
  void choose(std::size_t facade, const View& view) {
    const ShownFacade& shown = shown_[facade];
    std::optional<ChosenForEye>& chosen = chosen_for(facade, view);
    const glm::mat4 facade_from_world = glm::inverse(shown.world_from_facade);
    const glm::vec3 eye(facade_from_world * glm::vec4(view.position_in_world, 1.0f));
    if (chosen && chosen->loaded == shown.loaded && chosen->residency == shown.loaded->residency &&
        (view.kind == ViewKind::shadow || glm::distance(eye, chosen->eye) <= shown.loaded->chooser.step()))
      return;
    if (!chosen || chosen->loaded != shown.loaded)
      chosen = ChosenForEye{shown.loaded, eye, 0, shown.loaded->textures.chosen_lists()};
    chosen->eye = eye, chosen->residency = shown.loaded->residency;
    const ViewChooser& chooser = shown.loaded->chooser;
    chosen->lists.set(compared_ == Compared::all
                          ? chooser.all()
                          : chooser.choice(eye, pixel_angle_of(view), shown.loaded->textures.resident()));
  }

  static void bind(const gl::Program& program, const ShownFacade& facade, const ChosenLists& lists,
                   int thing) {
    facade.loaded->textures.bind(program, lists);
    program.set("world_from_facade", facade.world_from_facade);
    program.set("facade_from_world", glm::inverse(facade.world_from_facade));
    program.set("facade_thing", thing);
    program.set("radiance_of_exposed", facade.radiance_of_exposed);
    program.set("kept_of_shadows", facade.kept_in_shadow);
    glDisable(GL_CULL_FACE);
  }

  std::vector<DrawnRange>& list_of(const View& view) {
    return view.kind == ViewKind::main ? main_list_ : other_list_;
  }

  using Loaded = std::map<std::shared_ptr<const PackedFacade>, std::unique_ptr<LoadedFacade>>;

  int first_thing_;
  Compared compared_;
  HeldTexels held_;
  render::ViewPrograms solid_, cutout_;
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
