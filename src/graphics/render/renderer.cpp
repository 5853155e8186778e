#include "graphics/render/renderer.h"

#include <cassert>
#include <utility>

#include "graphics/render/bindings.h"
#include "graphics/render/frame.h"
#include "graphics/render/held_drawables.h"
#include "graphics/shading/realism.h"
#include "scene/data/realism.h"

namespace parvis::render {
namespace {

/// Depth 1 at the near plane and 0 far away: floats then resolve a centimetre at a kilometre, where depth
/// that grows confuses what lies 0.5 m apart. Needs GL_ZERO_TO_ONE.
glm::mat4 with_reversed_depth(const glm::mat4& clip_from_world) {
  glm::mat4 rows = glm::transpose(clip_from_world);
  rows[2] = 0.5f * (rows[3] - rows[2]);
  return glm::transpose(rows);
}

constexpr GLsizeiptr block_alignment = 256;  // no OpenGL asks for more

bool has_colour(const View& view) { return view.kind < ViewKind::shadow; }

std::vector<Drawable*> all_of(SceneDrawable& scene, const std::vector<Drawables::Made>& others) {
  std::vector<Drawable*> all{&scene};
  for (const Drawables::Made& other : others) all.push_back(other.drawable.get());
  return all;
}

Bounds fixed_bounds_of(const std::vector<Drawable*>& drawables) {
  Bounds bounds;
  for (const Drawable* drawable : drawables) bounds.add(drawable->extents().fixed);
  return bounds;
}

/// Each drawable's wish gets a level: within the budget of a frame, or the best where it has none.
void choose_quality(const std::vector<Drawable*>& drawables, const View& main_view, const Culling& culling,
                    double budget_ms) {
  std::vector<QualityWish> wishes;
  std::vector<std::span<QualityWish>> by_drawable;
  for (Drawable* drawable : drawables) {
    by_drawable.push_back(drawable->quality_wishes(main_view, culling));
    wishes.insert(wishes.end(), by_drawable.back().begin(), by_drawable.back().end());
  }
  if (wishes.empty()) return;
  if (budget_ms > 0.0)
    QualityBudget(budget_ms).choose(wishes);
  else
    for (QualityWish& wish : wishes) wish.level = int(wish.levels.size()) - 1;
  auto chosen = wishes.begin();
  for (const std::span<QualityWish> own : by_drawable)
    for (QualityWish& wish : own) wish.level = (chosen++)->level;
}

template <class T, class Range>
void append(std::vector<T>& all, const Range& more) {
  all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

Renderer::~Renderer() = default;

Result<std::unique_ptr<Renderer>> Renderer::create(const scene::Scene& scene, const Drawables& drawables,
                                                   const MakeLight& make_light) {
  Result<SceneDrawable> drawable = SceneDrawable::create(scene);
  if (!drawable) return drawable.errors();
  std::vector<Drawables::Made> room_drawables;
  if (Status status = drawables.follow(scene, room_drawables); !status) return status.errors();
  Result<std::unique_ptr<LightSource>> light =
      make_light(scene, fixed_bounds_of(all_of(*drawable, room_drawables)));
  if (!light) return light.errors();
  Result<PictureTarget> target = PictureTarget::create();
  if (!target) return target.errors();
  return std::unique_ptr<Renderer>(new Renderer(scene, *std::move(drawable), drawables,
                                                std::move(room_drawables), *std::move(light),
                                                *std::move(target)));
}

Renderer::Renderer(const scene::Scene& scene, SceneDrawable drawable, Drawables kinds,
                   std::vector<Drawables::Made> room_drawables, std::unique_ptr<LightSource> light,
                   PictureTarget target)
    : light_(std::move(light)),
      scene_(std::move(drawable)),
      occluders_(scene, scene_.gpu()),
      kinds_(std::move(kinds)),
      room_drawables_(std::move(room_drawables)),
      drawables_(all_of(scene_, room_drawables_)),
      object_count_(scene.objects.size()),
      frame_blocks_(1 << 18),
      body_blocks_(1 << 16) {
  targets_.push_back(std::move(target));
}

void Renderer::bind_frame(const View& view) {
  Frame frame{};
  frame.clip_from_world =
      view.kind == ViewKind::shadow ? view.clip_from_world : with_reversed_depth(view.clip_from_world);
  frame.viewer_position = glm::vec4(view.position_in_world, 1.0f);
  frame.frame_size = {float(view.width), float(view.height), 0.0f, 0.0f};
  frame.frame_realism = shading::realism_at(realism_);
  light_->fill(frame);
  const bool has_traced_sun = view.kind == ViewKind::main && traced_sun_ != 0;
  frame.frame_shadow_extra.y = has_traced_sun ? 1.0f : 0.0f;
  if (has_traced_sun) glBindTextureUnit(traced_sun_unit, traced_sun_);
  const GLintptr offset = frame_blocks_.append(std::span<const Frame>(&frame, 1), block_alignment);
  glBindBufferRange(GL_UNIFORM_BUFFER, frame_block, frame_blocks_.name(), offset, sizeof(Frame));
}

void Renderer::begin_view(const View& view) {
  const bool is_shadow = view.kind == ViewKind::shadow;
  glBindFramebuffer(GL_FRAMEBUFFER, view.framebuffer);
  glViewport(0, 0, view.width, view.height);
  glEnable(GL_DEPTH_TEST);
  glClipControl(GL_LOWER_LEFT, is_shadow ? GL_NEGATIVE_ONE_TO_ONE : GL_ZERO_TO_ONE);
  glDepthFunc(is_shadow ? GL_LEQUAL : GL_GEQUAL);
  glClearDepth(is_shadow ? 1.0 : 0.0);
  if (view.has_part()) {
    glEnable(GL_SCISSOR_TEST);
    glScissor(view.part.x, view.part.y, view.part.z, view.part.w);
  }
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  glFrontFace(GL_CCW);
  glCullFace(GL_BACK);
  bind_frame(view);
}

void Renderer::draw_prepared(const View& view, std::span<Drawable* const> drawables) {
  begin_view(view);
  if (view.kind == ViewKind::picking) {
    constexpr GLuint nothing[4]{};
    glClearBufferuiv(GL_COLOR, 0, nothing);
  }
  if (view.clears) glClear(GL_DEPTH_BUFFER_BIT);
  if (has_colour(view)) light_->bind();
  for (Drawable* drawable : drawables) drawable->draw(view, Pass::opaque);
  if (has_colour(view)) glEnable(GL_SAMPLE_ALPHA_TO_COVERAGE);
  for (Drawable* drawable : drawables) drawable->draw(view, Pass::cutout);
  glDisable(GL_SAMPLE_ALPHA_TO_COVERAGE);

  if (has_colour(view)) {
    if (view.kind != ViewKind::mirrored && view.clears) light_->draw_sky(view);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE,
                        GL_ONE_MINUS_SRC_ALPHA);  // alpha: coverage
    glDepthMask(GL_FALSE);
    for (Drawable* drawable : drawables) drawable->draw(view, Pass::blend);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
  }
  glDisable(GL_SCISSOR_TEST);
  glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);  // as a window's panels expect it
}

Culling Renderer::cull(const View& view) {
  const bool draws_occluders = view.culls_hidden && view.kind != ViewKind::mirrors;
  if (draws_occluders) occluders_.draw(view, scene_.gpu());
  return {view, draws_occluders ? &occluders_.culler() : nullptr};
}

void Renderer::draw_view(const View& view) {
  const Culling culling = cull(view);
  for (Drawable* drawable : drawables_) drawable->prepare(view, culling);
  draw_prepared(view, drawables_);
}

/// Nodes of the scene may have come that make the first thing of their kind. Where its drawable cannot be
/// made, the things are not drawn.
void Renderer::follow_things(const scene::Scene& scene) {
  const std::size_t known = room_drawables_.size();
  if (const Status status = kinds_.follow(scene, room_drawables_); !status)
    fmt::print(stderr, "{}\n", to_string(status.errors()));
  for (std::size_t i = known; i < room_drawables_.size(); ++i)
    drawables_.insert(drawables_.begin() + 1 + std::ptrdiff_t(i), room_drawables_[i].drawable.get());
}

void Renderer::gather_extents() {
  fixed_bounds_ = {};
  moving_bounds_.clear();
  bodies_.clear();
  fixed_change_ = {};
  for (const Drawable* drawable : drawables_) {
    const Extents extents = drawable->extents();
    fixed_bounds_.add(extents.fixed);
    append(moving_bounds_, extents.moving);
    append(bodies_, extents.bodies);
    if (!extents.fixed_change || extents.fixed_change->empty()) continue;
    append(fixed_change_.gone, extents.fixed_change->gone);
    append(fixed_change_.come, extents.fixed_change->come);
    // The heights that hide the sky follow single objects of the scene; else all are rebuilt.
    fixed_change_.has_moved |= extents.fixed_change->has_moved || drawable != &scene_;
  }
}

void Renderer::begin(const scene::Scene& scene, const Camera& camera, bool has_moving_shade) {
  ++frames_begun_;
  follow_things(scene);
  for (Drawable* drawable : drawables_) drawable->update(scene);
  if (std::exchange(object_count_, scene.objects.size()) != scene.objects.size())
    occluders_.follow_objects(scene, scene_.gpu());
  gather_extents();
  if (!fixed_change_.empty()) {
    occluders_.find_fixed(scene);
    light_->renew(scene, scene_.gpu(), fixed_change_, fixed_bounds_);
    ++fixed_changes_;
  }
  if (light_->update(scene)) ++fixed_changes_;
  exposure_ = scene.exposure;
  realism_ = scene.data<scene::Realism>().level;
  body_shade_ = shading::make_body_shade(
      has_moving_shade ? std::span<const shading::Body>(bodies_) : std::span<const shading::Body>(),
      camera.position_in_world());
  const GLintptr bodies =
      body_blocks_.append(std::span<const shading::BodyShade>(&body_shade_, 1), block_alignment);
  glBindBufferRange(GL_UNIFORM_BUFFER, bodies_block, body_blocks_.name(), bodies, sizeof(shading::BodyShade));
  glEnable(GL_DEPTH_CLAMP);  // a caster in front of the sun's near plane still casts its shadow
  light_->draw_shadows(camera,
                       has_moving_shade ? std::span<const Bounds>(moving_bounds_) : std::span<const Bounds>(),
                       [this](const View& view) { draw_view(view); });
  glDisable(GL_DEPTH_CLAMP);
  light_->bind();  // for methods of reflection that evaluate light before any view is drawn
}

Status Renderer::reserve_eyes(std::size_t count) {
  while (targets_.size() < count) {
    Result<PictureTarget> target = PictureTarget::create();
    if (!target) return target.errors();
    targets_.push_back(*std::move(target));
  }
  return Ok{};
}

void Renderer::prepare_main_view(const Camera& camera, int width, int height, Subjects subjects,
                                 const std::vector<std::uint8_t>* shown_objects) {
  target().resize(width, height, has_one_sample_);
  main_view_frame_ = frames_begun_;
  main_view_ = camera_view(camera, target().framebuffer(), width, height);
  main_view_.has_one_sample = has_one_sample_;
  main_view_.culls_hidden = !shown_objects;  // static occluders hide things though they are left out
  main_view_.subjects = subjects;
  main_view_.shown_objects = shown_objects;
  const Culling culling = cull(main_view_);
  choose_quality(drawables_, main_view_, culling, budget_ms_);
  for (Drawable* drawable : drawables_) drawable->prepare(main_view_, culling);
  traced_sun_ = light_->trace_view(camera, width, height);
}

void Renderer::draw_main_view() {
  draw_prepared(main_view_, drawables_);
  main_view_.shown_objects = nullptr;
  target().set_realism(realism_);
  target().resolve(exposure_);
}

void Renderer::relight_main_view(const scene::Scene& scene, const Camera& camera) {
  if (main_view_frame_ == frames_begun_) return;
  begin_frame(scene, camera);
  main_view_frame_ = frames_begun_;
}

Status Renderer::draw_over(const scene::Scene& held, bool is_kept) {
  if (!held_) held_ = std::make_unique<HeldDrawables>();
  if (Status status = held_->follow(held, kinds_); !status) return status;
  assert(main_view_.kind == ViewKind::main && "a view has been drawn");
  if (is_kept) target().restore();
  Bounds casters;
  for (const Drawable* drawable : held_->all()) {
    const Extents extents = drawable->extents();
    casters.add(extents.fixed);
    for (const Bounds& box : extents.moving) casters.add(box);
  }
  glEnable(GL_DEPTH_CLAMP);  // as in `begin`
  light_->cast_held(casters, [this](const View& shadow_view) {
    const Culling culling(shadow_view, nullptr);
    for (Drawable* drawable : held_->all()) drawable->prepare(shadow_view, culling);
    draw_prepared(shadow_view, held_->all());
  });
  glDisable(GL_DEPTH_CLAMP);
  View view = main_view_;
  view.clears = view.culls_hidden = false;
  view.subjects = Subjects::all;
  const Culling culling(view, nullptr);
  for (Drawable* drawable : held_->all()) drawable->prepare(view, culling);
  // The sun's rays were traced for what stands at each pixel: things that are held look up its map.
  const TracedSun traced_sun = std::exchange(traced_sun_, 0);
  draw_prepared(view, held_->all());
  traced_sun_ = traced_sun;
  target().resolve(exposure_);
  return Ok{};
}

ObjectPicture Renderer::pick(const Camera& camera, int width, int height, bool culls_hidden) {
  gl::Texture objects = gl::texture_2d(GL_R32UI, width, height);
  gl::Texture depth = gl::texture_2d(GL_DEPTH_COMPONENT32F, width, height);
  gl::Framebuffer framebuffer = gl::Framebuffer::create();
  glNamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT0, objects.name(), 0);
  glNamedFramebufferTexture(framebuffer.name(), GL_DEPTH_ATTACHMENT, depth.name(), 0);
  View view = camera_view(camera, framebuffer.name(), width, height);
  view.kind = ViewKind::picking;
  view.culls_hidden = culls_hidden;
  draw_view(view);

  ObjectPicture picture(width, height, 1);
  glGetTextureImage(objects.name(), 0, GL_RED_INTEGER, GL_UNSIGNED_INT, GLsizei(4 * picture.pixels.size()),
                    picture.pixels.data());
  flip_rows(picture);
  return picture;
}

}  // namespace parvis::render
