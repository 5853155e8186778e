#include "graphics/light/sun_shadow_maps.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "graphics/render/regions.h"

namespace parvis::light {
namespace {

constexpr float near_half_width_m = 60.0f;  // a texel is 2.9 cm: cornices and railings cast shadows
constexpr float near_ahead_m = 25.0f;       // the window lies where the viewer looks
// Middles of the window are this far apart: it is drawn again when the viewer comes nearer to another one.
// They do not depend on where the viewer was: maps and films that several processes draw are equal to those
// of one.
constexpr float near_step_m = 25.0f;
constexpr float room_radius_m = 12.0f;    // a place no larger lies in the near map as a whole, and finer
constexpr float round_room_m = 4.0f;      // margin for dynamic objects around it
constexpr float spot_near_m = 0.05f;      // nothing nearer to a lamp shades
constexpr float moving_height_m = 30.0f;  // vehicles stand no higher over the viewer's surroundings

glm::mat3 sun_frame(glm::vec3 to_sun) {
  const glm::vec3 aside = std::abs(to_sun.z) < 0.99f ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
  const glm::vec3 right = glm::normalize(glm::cross(aside, to_sun));
  return glm::transpose(glm::mat3(right, glm::cross(to_sun, right), to_sun));
}

bool is_room(const Bounds& place) { return place.radius() < room_radius_m; }

float near_half_width(const Bounds& place) {
  return is_room(place) ? place.radius() + round_room_m : near_half_width_m;
}

/// A point near the middle of the best seen part, among the heights of the place; of a room its middle.
glm::vec3 focus_of(const Camera& camera, const Bounds& place) {
  if (is_room(place)) return place.centre();
  const glm::vec3 forward = camera.forward_in_world();
  glm::vec3 focus = camera.position_in_world() + near_ahead_m * glm::vec3(forward.x, forward.y, 0.0f);
  focus.z = std::clamp(focus.z, place.min.z, place.max.z);
  return near_step_m * glm::round(focus / near_step_m);
}

/// The box around a box as a map shows it; all of the map where the box reaches behind its projection's
/// centre.
Bounds projected(const glm::mat4& uvz_from_world, const Bounds& box) {
  Bounds result;
  for (int corner = 0; corner < 8 && !box.empty(); ++corner) {
    const glm::vec4 p =
        uvz_from_world * glm::vec4(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                                   corner & 4 ? box.max.z : box.min.z, 1.0f);
    if (p.w < 1e-3f) return {glm::vec3(0.0f), glm::vec3(1.0f)};
    result.add(glm::vec3(p) / p.w);
  }
  return result;
}

gl::Framebuffer depth_framebuffer() {
  gl::Framebuffer framebuffer = gl::Framebuffer::create();
  glNamedFramebufferDrawBuffer(framebuffer.name(), GL_NONE);
  return framebuffer;
}

}  // namespace

SunShadowMaps::SunShadowMaps(const scene::SunLight& sun, const Bounds& fixed, FitNearMap fit)
    : fixed_(fixed.empty() ? Bounds{glm::vec3(-1), glm::vec3(1)} : fixed),
      fit_(std::move(fit)),
      depth_(gl::Texture::create(GLenum(GL_TEXTURE_2D_ARRAY))),
      near_fixed_(gl::texture_2d(GL_DEPTH_COMPONENT32F, map_size, map_size)),
      near_fixed_framebuffer_(depth_framebuffer()) {
  glTextureStorage3D(depth_.name(), 1, GL_DEPTH_COMPONENT32F, map_size, map_size, shading::shadow_map_count);
  glTextureParameteri(depth_.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(depth_.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(depth_.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glTextureParameteri(depth_.name(), GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTextureParameteri(depth_.name(), GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  for (std::size_t map = 0; map < framebuffers_.size(); ++map) {
    framebuffers_[map] = depth_framebuffer();
    glNamedFramebufferTextureLayer(framebuffers_[map].name(), GL_DEPTH_ATTACHMENT, depth_.name(), 0,
                                   GLint(map));
  }
  glNamedFramebufferTexture(near_fixed_framebuffer_.name(), GL_DEPTH_ATTACHMENT, near_fixed_.name(), 0);
  maps_.texel_uv = 1.0f / float(map_size);
  turn_to(sun);
}

void SunShadowMaps::turn_to(const scene::SunLight& sun) {
  sun_ = sun;
  to_sun_ = glm::normalize(sun.direction_to_sun);
  sun_from_world_ = sun_frame(to_sun_);
  fixed_in_sun_ = transformed(glm::mat4(sun_from_world_), fixed_);
  far_is_drawn_ = false;
  near_centre_ = glm::vec3(1e30f);
  near_.reset();
}

render::View SunShadowMaps::shadow_view(int map, const glm::mat4& clip_from_world, float texel_m) {
  render::View view;
  view.kind = render::ViewKind::shadow;
  view.clip_from_world = clip_from_world;
  view.position_in_world = sun_.spot ? sun_.spot->position : fixed_.centre() + 1e5f * to_sun_;
  view.framebuffer = framebuffers_[std::size_t(map)].name();
  view.width = view.height = map_size;
  view.subjects = render::Subjects::fixed;

  const glm::mat4 uvz_from_clip(0.5f, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, 0.5f, 0, 0.5f, 0.5f, 0.5f, 1);
  maps_.uvz_from_world[map] = uvz_from_clip * view.clip_from_world;
  maps_.texel_m[map] = texel_m;
  return view;
}

/// Both maps of a spot light show its whole cone.
render::View SunShadowMaps::aim_spot(const scene::Spot& spot, int map) {
  const glm::vec3 position = spot.position;
  const glm::vec3 up = std::abs(to_sun_.z) < 0.99f ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
  const float half_angle = std::min(spot.half_angle + 0.01f, 1.5f);
  const float far_m = glm::distance(position, fixed_.centre()) + fixed_.radius() + moving_height_m;
  const glm::mat4 clip_from_world = glm::perspective(2.0f * half_angle, 1.0f, spot_near_m, far_m) *
                                    glm::lookAt(position, position - to_sun_, up);
  const float texel = 2.0f * std::tan(half_angle) / float(map_size);  // at a metre, where w is 1
  if (map == shading::shadow_near_map) maps_.growth = 1e-6f, maps_.tile_count = 0;
  return shadow_view(
      map, clip_from_world,
      map == shading::shadow_near_map ? texel : texel * glm::distance(position, fixed_.centre()));
}

/// Turns a map's light toward a square about `centre`.
render::View SunShadowMaps::aim(int map, glm::vec3 centre, float half_width_m) {
  const float texel = 2.0f * half_width_m / float(map_size);
  glm::vec3 middle = sun_from_world_ * centre;
  middle.x = std::round(middle.x / texel) * texel;  // whole texels: edges do not crawl when the viewer moves
  middle.y = std::round(middle.y / texel) * texel;
  // Casters toward the sun all count, however far: depth spans the whole place.
  const float top = std::max(fixed_in_sun_.max.z, middle.z + half_width_m) + moving_height_m;
  const float bottom = std::min(fixed_in_sun_.min.z, middle.z - half_width_m) - 1.0f;

  glm::mat4 clip_from_sun(1.0f);
  clip_from_sun[0][0] = clip_from_sun[1][1] = 1.0f / half_width_m;
  clip_from_sun[2][2] = -2.0f / (top - bottom);
  clip_from_sun[3] = {-middle.x / half_width_m, -middle.y / half_width_m, (top + bottom) / (top - bottom),
                      1.0f};

  render::View view = shadow_view(map, clip_from_sun * glm::mat4(sun_from_world_), texel);
  view.position_in_world = centre + 1e5f * to_sun_;
  return view;
}

void SunShadowMaps::aim_near(glm::vec3 position) {
  near_centre_ = position;
  maps_.growth = 0.0f, maps_.tile_count = 0;
  near_views_ = {sun_.spot ? aim_spot(*sun_.spot, shading::shadow_near_map)
                           : aim(shading::shadow_near_map, position, near_half_width(fixed_))};
}

void SunShadowMaps::aim_near(const NearMap& near) {
  near_ = near;
  near_centre_ = glm::vec3(0.0f);
  const render::View whole = shadow_view(shading::shadow_near_map, near.clip_from_world, near.texel_m);
  maps_.growth = near.growth;
  maps_.tile_count = near.tile_count;
  for (std::size_t i = 0; i < near.tiles.size(); ++i) maps_.tiles[i] = near.tiles[i];
  near_views_.assign(std::size_t(std::max(near.tile_count, 1)), whole);
  for (std::size_t i = 0; i < std::size_t(near.tile_count); ++i) {
    const glm::vec4 tile = near.tiles[i];
    glm::mat4 tile_from_clip(1.0f);  // -1..1 of the whole to that of the quarter
    tile_from_clip[0][0] = tile.x, tile_from_clip[1][1] = tile.y;
    tile_from_clip[3] = {tile.x + 2.0f * tile.z - 1.0f, tile.y + 2.0f * tile.w - 1.0f, 0.0f, 1.0f};
    near_views_[i].clip_from_world = tile_from_clip * near.clip_from_world;
    near_views_[i].part = {int(i % 2) * map_size / 2, int(i / 2) * map_size / 2, map_size / 2, map_size / 2};
  }
}

/// Draws static geometry into the map itself, or apart from it for frames in which something moves.
void SunShadowMaps::draw_near_fixed(const render::DrawView& draw, bool is_apart) {
  is_apart_ = is_apart;
  drawn_over_.clear();
  held_over_.reset();
  if (is_apart) drawn_over_.push_back({glm::ivec2(0), glm::ivec2(map_size)});
  for (render::View view : near_views_) {
    if (is_apart) view.framebuffer = near_fixed_framebuffer_.name();
    draw(view);
  }
}

/// Something begins to move over a near map of static geometry.
void SunShadowMaps::keep_near_fixed() {
  is_apart_ = true;
  glCopyImageSubData(depth_.name(), GL_TEXTURE_2D_ARRAY, 0, 0, 0, shading::shadow_near_map,
                     near_fixed_.name(), GL_TEXTURE_2D, 0, 0, 0, 0, map_size, map_size, 1);
}

void SunShadowMaps::draw_far(const render::DrawView& draw) {
  const glm::vec3 size = fixed_in_sun_.size();
  far_view_ = sun_.spot ? aim_spot(*sun_.spot, shading::shadow_far_map)
                        : aim(shading::shadow_far_map, fixed_.centre(), 0.51f * std::max(size.x, size.y));
  draw(far_view_);
  far_is_drawn_ = true;
  postponed_.clear();
}

void SunShadowMaps::renew(const render::FixedChange& change, const Bounds& fixed) {
  Bounds all = fixed_;
  all.add(fixed);
  if (all.min != fixed_.min || all.max != fixed_.max) {
    fixed_ = all;
    turn_to(sun_);
  }
  change_ = change;
}

/// Is no point whose shadow the box may change looked up in the far map? Points are lifted by a texel or two
/// before lookups, which filter over two more.
bool SunShadowMaps::near_map_serves(const Bounds& box) const {
  if (near_centre_.x >= 1e30f || near_ || sun_.spot) return false;
  const float margin_m = 8.0f * maps_.texel_m[shading::shadow_far_map];
  const Bounds uv =
      transformed(maps_.uvz_from_world[shading::shadow_near_map], {box.min - margin_m, box.max + margin_m});
  return uv.min.x > 0.0f && uv.min.y > 0.0f && uv.max.x < 1.0f && uv.max.y < 1.0f;
}

/// Renders again the squares of a map where the boxes fall, with all of the `subjects` there.
void SunShadowMaps::redraw(render::View view, int map, std::span<const Bounds> boxes,
                           render::Subjects subjects, const render::DrawView& draw) const {
  std::vector<Bounds> squares;  // in texels, flat
  for (const Bounds& box : boxes) squares.push_back(texels_of(map, box));
  view.subjects = subjects;
  for (const Bounds& texels : render::united(std::move(squares), 0.0f)) {
    view.part = glm::ivec4(glm::ivec2(texels.min), glm::ivec2(texels.size()));
    if (view.has_part()) draw(view);
  }
}

/// Draws what came over what is there.
void SunShadowMaps::draw_newcomers(render::View view, int map, std::span<const Bounds> boxes,
                                   const render::DrawView& draw) const {
  Bounds texels;
  for (const Bounds& box : boxes)
    if (const Bounds square = texels_of(map, box); square.size().x > 0.0f && square.size().y > 0.0f)
      texels.add(square);
  if (texels.empty()) return;
  view.subjects = render::Subjects::newcomers;
  view.clears = false;
  view.part = glm::ivec4(glm::ivec2(texels.min), glm::ivec2(texels.size()));
  draw(view);
}

void SunShadowMaps::draw_changed(const render::DrawView& draw) {
  if (far_is_drawn_) {
    std::vector<Bounds> gone, come;
    for (const Bounds& box : change_.gone) (near_map_serves(box) ? postponed_ : gone).push_back(box);
    for (const Bounds& box : change_.come) (near_map_serves(box) ? postponed_ : come).push_back(box);
    redraw(far_view_, shading::shadow_far_map, gone, render::Subjects::staying, draw);
    draw_newcomers(far_view_, shading::shadow_far_map, come, draw);
  }
  if (near_) {
    near_.reset();  // it is fitted again, and drawn, in this update
  } else if (near_centre_.x < 1e30f) {
    render::View fixed_view = near_views_.front();
    if (is_apart_) fixed_view.framebuffer = near_fixed_framebuffer_.name();
    redraw(fixed_view, shading::shadow_near_map, change_.gone, render::Subjects::staying, draw);
    draw_newcomers(fixed_view, shading::shadow_near_map, change_.come, draw);
    for (const std::vector<Bounds>* boxes : {&change_.gone, &change_.come})
      for (const Bounds& box : *boxes)
        if (const Square square = square_of(shading::shadow_near_map, box);
            is_apart_ && square.size.x > 0 && square.size.y > 0)
          drawn_over_.push_back(square);
  }
  change_ = {};
}

/// The near map is about to serve another region.
void SunShadowMaps::draw_postponed(const render::DrawView& draw) {
  redraw(far_view_, shading::shadow_far_map, postponed_, render::Subjects::fixed, draw);
  postponed_.clear();
}

void SunShadowMaps::put_back(const Square& square) {
  glCopyImageSubData(near_fixed_.name(), GL_TEXTURE_2D, 0, square.corner.x, square.corner.y, 0, depth_.name(),
                     GL_TEXTURE_2D_ARRAY, 0, square.corner.x, square.corner.y, shading::shadow_near_map,
                     square.size.x, square.size.y, 1);
}

/// Where a box falls in a map, with a texel of margin.
SunShadowMaps::Square SunShadowMaps::square_of(int map, const Bounds& box) const {
  const Bounds uv = projected(maps_.uvz_from_world[map], box);
  const auto texel = [](float share) { return int(std::clamp(share, 0.0f, 1.0f) * float(map_size)); };
  const glm::ivec2 low(texel(uv.min.x) - 1, texel(uv.min.y) - 1);
  const glm::ivec2 high(texel(uv.max.x) + 2, texel(uv.max.y) + 2);
  const glm::ivec2 corner = glm::clamp(low, 0, map_size);
  return {corner, glm::clamp(high, 0, map_size) - corner};
}

Bounds SunShadowMaps::texels_of(int map, const Bounds& box) const {
  const Square square = square_of(map, box);
  return {{square.corner, 0}, {square.corner + square.size, 0}};
}

void SunShadowMaps::update(const Camera& camera, const scene::SunLight& sun, std::span<const Bounds> moving,
                           const render::DrawView& draw) {
  if (glm::normalize(sun.direction_to_sun) != to_sun_ || sun.spot != sun_.spot) turn_to(sun);
  if (!change_.empty()) draw_changed(draw);
  if (!far_is_drawn_) draw_far(draw);
  if (fit_ && !sun_.spot) {
    if (const NearMap fitted = fit_(camera, sun_, fixed_); near_ != fitted) {
      aim_near(fitted);
      draw_near_fixed(draw, !moving.empty());
    }
  } else if (const glm::vec3 focus = sun_.spot ? sun_.spot->position : focus_of(camera, fixed_);
             focus != near_centre_) {
    draw_postponed(draw);
    aim_near(focus);
    draw_near_fixed(draw, !moving.empty());
  }

  if (held_over_) drawn_over_.push_back(*held_over_);
  held_over_.reset();
  for (const Square& square : drawn_over_) put_back(square);
  drawn_over_.clear();
  if (moving.empty()) return;
  if (!is_apart_) keep_near_fixed();
  for (const Bounds& box : moving)
    if (const Square square = square_of(shading::shadow_near_map, box);
        square.size.x > 2 && square.size.y > 2)
      drawn_over_.push_back(square);
  // They may fall into any tile; and one copy of all takes less time than many small ones.
  constexpr std::size_t max_squares = 96;
  if (maps_.tile_count > 0 || drawn_over_.size() > max_squares)
    drawn_over_.assign(1, {glm::ivec2(0), glm::ivec2(map_size)});
  for (render::View moving_view : near_views_) {
    moving_view.subjects = render::Subjects::moving;
    moving_view.clears = false;
    draw(moving_view);
  }
}

void SunShadowMaps::cast_held(const Bounds& casters, const render::DrawView& draw) {
  if (!is_apart_) keep_near_fixed();
  if (held_over_) put_back(*held_over_);
  held_over_ = square_of(shading::shadow_near_map, casters);
  if (maps_.tile_count > 0) held_over_ = Square{glm::ivec2(0), glm::ivec2(map_size)};
  if (held_over_->size.x <= 0 || held_over_->size.y <= 0) return held_over_.reset();
  for (render::View view : near_views_) {
    view.subjects = render::Subjects::all;
    view.clears = false;
    draw(view);
  }
}

void SunShadowMaps::bind(GLuint unit) const { glBindTextureUnit(unit, depth_.name()); }

shading::SunShadow SunShadowMaps::read_back() const {
  shading::SunShadow shadow;
  shadow.maps = maps_;
  for (std::size_t map = 0; map < shadow.depth.size(); ++map) {
    ImageF& depth = shadow.depth[map];
    depth = ImageF(map_size, map_size, 1);
    glGetTextureSubImage(depth_.name(), 0, 0, 0, GLint(map), map_size, map_size, 1, GL_DEPTH_COMPONENT,
                         GL_FLOAT, GLsizei(depth.pixels.size() * sizeof(float)), depth.pixels.data());
  }
  return shadow;
}

}  // namespace parvis::light
