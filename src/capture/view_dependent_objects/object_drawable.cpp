#include "capture/view_dependent_objects/object_drawable.h"

#include <map>

#include "capture/view_dependent_objects/object_textures.h"
#include "capture/view_dependent_objects/placed_object.h"
#include "graphics/gl/uniform_block.h"
#include "graphics/render/bindings.h"
#include "graphics/render/static_things.h"
#include "graphics/render/view_programs.h"
#include "graphics/shading/glsl.h"
#include "scene/data/scene.h"
#include "scene/data/sun_shadows.h"

namespace parvis::view_dependent_objects {
namespace {

namespace block_shared {
using namespace parvis::shading;
#include "capture/view_dependent_objects/object_block.glsl"
}  // namespace block_shared

using render::Culling;
using render::Extents;
using render::Pass;
using render::View;
using render::ViewKind;

class ObjectDrawable final : public render::Drawable {
 public:
  static Result<std::unique_ptr<render::Drawable>> create(const scene::Scene& scene, int first_thing) {
    const auto programs_of = [](gl::Defines defines) {
      defines.emplace_back("HAS_BACKS", "");
      defines.emplace_back("IS_RECORDED", "");
      defines.emplace_back("RECEIVES_INSERTED", "");
      return render::ViewPrograms::create({"capture/view_dependent_objects/object_vertex.glsl",
                                           "capture/view_dependent_objects/object_surface.glsl",
                                           std::move(defines)});
    };
    Result<render::ViewPrograms> solid = programs_of({}), cutout = programs_of({{"HAS_HOLES", ""}});
    if (!solid) return solid.errors();
    if (!cutout) return cutout.errors();
    std::unique_ptr<ObjectDrawable> made(
        new ObjectDrawable(first_thing, *std::move(solid), *std::move(cutout)));
    if (Status status = made->load(scene); !status) return status.errors();
    made->update(scene);
    return std::unique_ptr<render::Drawable>(std::move(made));
  }

  void update(const scene::Scene& scene) override {
    if (!load(scene)) return;  // what is new shows nothing where graphics memory is full
    placed_ = scene.items<PlacedObject>(), casts_shadow_.resize(placed_.size());
    exposure_ = scene.exposure;
    const auto& shadows = scene.data<scene::SunShadows>();
    const std::vector<int>& makers = scene.data<scene::ItemsOf<PlacedObject>>().makers;
    things_.begin_update(placed_.size());
    for (std::size_t i = 0; i < placed_.size(); ++i) {
      const PlacedObject& object = placed_[i];
      casts_shadow_[i] = shadows.casts_item_of(makers[i]);
      const Bounds all = transformed(object.world_from_object, object.model->bounds());
      things_.update(i, {object.model.get(), object.world_from_object, object.is_visible, all, all});
    }
  }

  void renumber(int first_thing) override { first_thing_ = first_thing; }
  Extents extents() const override { return things_.extents(); }

  void prepare(const View& view, const Culling& culling) override {
    std::vector<Shown>& list = list_of(view);
    list.clear();
    for (std::size_t i = 0; i < placed_.size(); ++i) {
      if (!placed_[i].is_visible || !culling.shows(first_thing_ + int(i), {false, things_.is_newcomer(i)}))
        continue;
      if (view.kind == ViewKind::shadow && !casts_shadow_[i]) continue;
      for (const Piece& piece : placed_[i].model->pieces) {
        const Bounds bounds = transformed(placed_[i].world_from_object, piece.bounds);
        if (culling.may_see(bounds) && !culling.is_hidden(bounds)) list.push_back({i, &piece});
      }
    }
  }

  void draw(const View& view, Pass pass) override {
    if (pass == Pass::blend) return;
    const gl::Program* program = nullptr;
    std::size_t bound = placed_.size();
    for (const Shown& shown : list_of(view)) {
      const PlacedObject& object = placed_[shown.object];
      if (object.model->has_holes != (pass == Pass::cutout)) continue;
      if (!program) program = (pass == Pass::cutout ? cutout_ : solid_).use(view);
      if (!program) return;
      if (bound != shown.object) loaded_.at(object.model).bind(*program);
      bound = shown.object;
      draw(*program, object, *shown.piece, first_thing_ + int(shown.object));
    }
  }

 private:
  struct Shown {
    std::size_t object;
    const Piece* piece;
  };
  using Loaded = std::map<std::shared_ptr<const BlendedModel>, ObjectTextures>;

  ObjectDrawable(int first_thing, render::ViewPrograms solid, render::ViewPrograms cutout)
      : first_thing_(first_thing), solid_(std::move(solid)), cutout_(std::move(cutout)) {}

  /// Models that are new in the scene; those that left it are given back.
  Status load(const scene::Scene& scene) {
    Loaded kept;
    for (const PlacedObject& placed : scene.items<PlacedObject>()) {
      if (kept.contains(placed.model) || loaded_.contains(placed.model)) continue;
      Result<ObjectTextures> textures = ObjectTextures::create(*placed.model);
      if (!textures) return textures.errors();  // nothing has changed: what is shown stays
      kept.emplace(placed.model, *std::move(textures));
    }
    for (const PlacedObject& placed : scene.items<PlacedObject>())
      if (auto known = loaded_.extract(placed.model)) kept.insert(std::move(known));
    loaded_ = std::move(kept);
    return Ok{};
  }

  void draw(const gl::Program& program, const PlacedObject& object, const Piece& piece, int thing) const {
    block_.bind(program, {.world_from_object = object.world_from_object,
                          .object_from_world = glm::inverse(object.world_from_object),
                          .radiance_of_exposed = object.brightness / exposure_,
                          .kept_of_shadows = object.kept_in_shadow,
                          .lit_luminance = object.model->lit_luminance,
                          .thing = thing,
                          .first_entry = piece.first_entry,
                          .view_count = piece.views,
                          .pass_count = object.passes,
                          .first_triangle = int(piece.first_triangle)});
    glDisable(GL_CULL_FACE);
    glDrawArrays(GL_TRIANGLES, GLint(3 * piece.first_triangle), GLsizei(3 * piece.triangle_count));
  }

  std::vector<Shown>& list_of(const View& view) {
    return view.kind == ViewKind::main ? main_list_ : other_list_;
  }

  int first_thing_;
  render::ViewPrograms solid_, cutout_;
  gl::UniformBlock<block_shared::ViewDependentObject> block_{"ViewDependentObject",
                                                             render::first_drawable_block};
  Loaded loaded_;
  std::vector<PlacedObject> placed_;  ///< as of the last update
  std::vector<bool> casts_shadow_;    ///< each of them
  float exposure_ = 1.0f;
  render::StaticThings things_;
  std::vector<Shown> main_list_, other_list_;
};

}  // namespace

render::DrawableKind objects_kind() { return {traced_objects(), &ObjectDrawable::create}; }

}  // namespace parvis::view_dependent_objects
