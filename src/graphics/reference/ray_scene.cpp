#include "graphics/reference/ray_scene.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <unordered_set>

#include "graphics/reference/traced_hit.h"
#include "scene/data/mip_levels.h"

namespace parvis::reference {
namespace {

using Places = std::vector<std::unique_ptr<PlacedPart>>;

/// What travels with a query to the filters below.
struct QueryContext {
  RTCIntersectContext embree;
  const Places& places;
  Passage* passage;  ///< null: the ray sees as the renderer draws

  QueryContext(const Places& all, Passage* p) : places(all), passage(p) { rtcInitIntersectContext(&embree); }
};

RTCRay embree_ray(const Ray& ray) {
  return {ray.origin.x,
          ray.origin.y,
          ray.origin.z,
          ray.min_m,
          ray.direction.x,
          ray.direction.y,
          ray.direction.z,
          0.0f,
          ray.max_m,
          ~0u,
          0,
          0};
}

/// Instance of the joined triangles; that of place i is i + 1.
constexpr unsigned joined_instance = 0;

unsigned instance_of(std::size_t place) { return unsigned(place + 1); }

/// Which place a hit belongs to.
std::size_t place_of(unsigned instance, unsigned geometry) {
  return instance == joined_instance ? geometry : instance - 1;
}

/// Front and back are decided in the mesh's frame, where a mirroring transform does not exchange them.
bool meets_back(const RTCFilterFunctionNArguments* arguments) {
  const glm::vec3 ng(RTCHitN_Ng_x(arguments->hit, arguments->N, 0),
                     RTCHitN_Ng_y(arguments->hit, arguments->N, 0),
                     RTCHitN_Ng_z(arguments->hit, arguments->N, 0));
  const glm::vec3 direction(RTCRayN_dir_x(arguments->ray, arguments->N, 0),
                            RTCRayN_dir_y(arguments->ray, arguments->N, 0),
                            RTCRayN_dir_z(arguments->ray, arguments->N, 0));
  return glm::dot(ng, direction) > 0.0f;
}

/// The ray is in the frame of the triangles.
glm::vec3 direction_in_world(const PlacedPart& place, const RTCFilterFunctionNArguments* arguments) {
  const glm::vec3 direction(RTCRayN_dir_x(arguments->ray, arguments->N, 0),
                            RTCRayN_dir_y(arguments->ray, arguments->N, 0),
                            RTCRayN_dir_z(arguments->ray, arguments->N, 0));
  return place.is_joined ? direction : glm::mat3(place.world_from_mesh) * direction;
}

float alpha_at_hit(const PlacedPart& place, const RTCFilterFunctionNArguments* arguments, bool is_shadow) {
  const std::uint32_t triangle = RTCHitN_primID(arguments->hit, arguments->N, 0);
  const float u = RTCHitN_u(arguments->hit, arguments->N, 0), v = RTCHitN_v(arguments->hit, arguments->N, 0);
  if (place.surface) {
    const glm::vec3 along = glm::normalize(direction_in_world(place, arguments));
    return place.surface->alpha(traced_hit(place, triangle, {u, v}, is_shadow ? along : -along, 0.0f));
  }
  const scene::Material& material = *place.material;
  if (material.base_colour_texture == scene::no_index) return material.alpha;
  const glm::vec2 uv = texture_coordinates(place, triangle, u, v);
  return material.alpha * (*place.textures)[std::size_t(material.base_colour_texture)].sample(uv, 1.0f).w;
}

bool stops_light(const PlacedPart& place, Passage& passage, const RTCFilterFunctionNArguments* arguments,
                 bool is_shadow) {
  const scene::Material& material = *place.material;
  if (!passage.sees_backs && !material.is_double_sided && meets_back(arguments)) return false;
  if (material.alpha_mode == scene::Alpha::opaque) return true;
  if (material.alpha_mode == scene::Alpha::cutout) return alpha_at_hit(place, arguments, is_shadow) >= 0.5f;
  return place.casts_shadow && passage.random.uniform() < alpha_at_hit(place, arguments, is_shadow);
}

/// A ray to the sun meets from behind what the sun sees from the front; panes and solid glass cast no
/// shadow.
bool stops_as_drawn(const PlacedPart& place, const RTCFilterFunctionNArguments* arguments, bool is_shadow) {
  const scene::Material& material = *place.material;
  const bool lets_through = material.alpha_mode == scene::Alpha::blend || material.refracts();
  if (is_shadow && (!place.casts_shadow || lets_through)) return false;
  if (!material.is_double_sided && meets_back(arguments) != is_shadow) return false;
  return material.alpha_mode != scene::Alpha::cutout || alpha_at_hit(place, arguments, is_shadow) >= 0.5f;
}

/// Embree calls this for each candidate hit.
template <bool is_shadow>
void pass_through_holes(const RTCFilterFunctionNArguments* arguments) {
  const QueryContext& context = *reinterpret_cast<const QueryContext*>(arguments->context);
  const PlacedPart& place = *context.places[place_of(RTCHitN_instID(arguments->hit, arguments->N, 0, 0),
                                                     RTCHitN_geomID(arguments->hit, arguments->N, 0))];
  const bool stops = context.passage ? stops_light(place, *context.passage, arguments, is_shadow)
                                     : stops_as_drawn(place, arguments, is_shadow);
  if (!stops) arguments->valid[0] = 0;
}

}  // namespace

glm::vec2 texture_coordinates(const PlacedPart& place, std::uint32_t triangle, float u, float v) {
  const Mesh& mesh = *place.mesh;
  const std::uint32_t* corner = mesh.indices.data() + 3 * std::size_t(triangle);
  const glm::vec2 uv =
      (1.0f - u - v) * mesh.uvs[corner[0]] + u * mesh.uvs[corner[1]] + v * mesh.uvs[corner[2]];
  return glm::vec2(place.material->texture_from_mesh_uv * glm::vec3(uv, 1.0f));
}

/// Takes over what rooms draw by themselves.
class RayScene::TracedThings final : public scene::TracedScene {
 public:
  TracedThings(RayScene& rays, int first_thing) : rays_(rays), first_thing_(first_thing) {}

  void add(std::shared_ptr<const Mesh> mesh, std::shared_ptr<const scene::TracedSurface> surface,
           const glm::mat4& world_from_mesh, const scene::TracedPlacing& placing) override {
    if (!placing.is_visible) return;
    auto material = std::make_shared<scene::Material>();
    material->alpha_mode = surface->alpha_mode();
    material->is_double_sided = surface->is_double_sided();
    PlacedPart part{};
    part.mesh = mesh.get();
    part.material = material.get();
    part.surface = surface.get();
    part.world_from_mesh = world_from_mesh;
    part.object = first_thing_ + placing.thing;
    part.casts_shadow = placing.casts_shadow;
    rays_.place(part, true);
    rays_.kept_.insert(rays_.kept_.end(), {std::move(mesh), std::move(surface), std::move(material)});
  }

  void add(std::shared_ptr<const scene::Model> model, const glm::mat4& world_from_model,
           const scene::TracedPlacing& placing) override {
    if (!placing.is_visible) return;
    const std::vector<glm::mat4> pose = scene::rest_pose(*model);
    for (std::size_t p = 0; p < model->parts.size(); ++p) {
      const scene::Part& part = model->parts[p];
      rays_.place(*model, p, part.mesh, world_from_model * pose[std::size_t(part.node)],
                  first_thing_ + placing.thing, false, true, false);
    }
    rays_.kept_.push_back(std::move(model));
  }

 private:
  RayScene& rays_;
  int first_thing_;
};

RayScene::RayScene(const scene::Scene& scene)
    : shadows_(scene.data<scene::SunShadows>()),
      device_(rtcNewDevice(nullptr)),
      top_(rtcNewScene(device_)),
      joined_(rtcNewScene(device_)) {
  rtcSetSceneFlags(joined_, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry instance = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(instance, joined_);
  rtcAttachGeometryByID(top_, instance, joined_instance);
  rtcReleaseGeometry(instance);
  for (const scene::Object& object : scene.objects)
    for (std::size_t p = 0; p < object.model->parts.size(); ++p) ++placed_[&object.mesh(p)];
  for (std::size_t o = 0; o < scene.objects.size(); ++o) add_object(scene.objects[o], int(o));
  object_places_ = places_.size();
  trace_things(scene);
  commit();
}

void RayScene::commit() {
  if (has_other_joined_) {
    rtcCommitScene(joined_);
    rtcCommitGeometry(rtcGetGeometry(top_, joined_instance));
    has_other_joined_ = false;
  }
  rtcCommitScene(top_);
}

void RayScene::trace_things(const scene::Scene& scene) {
  scene::for_each_traced_kind(scene, [&](const scene::TracedKind& kind, int first_thing) {
    TracedThings things(*this, first_thing);
    kind.trace(scene, things);
  });
}

/// Traced things are described as a whole for each picture: only their meshes may be those of the last one.
void RayScene::forget_things() {
  for (std::size_t i = object_places_; i < places_.size(); ++i) {
    triangle_count_ -= places_[i]->mesh->triangle_count();
    rtcDetachGeometry(top_, instance_of(i));
  }
  places_.resize(object_places_);
}

bool RayScene::update(const scene::Scene& scene) {
  bool has_changed = false;
  std::size_t next = 0;
  for (const scene::Object& object : scene.objects) {
    const std::vector<glm::mat4> pose = object.pose.empty() ? scene::rest_pose(*object.model) : object.pose;
    for (std::size_t p = 0; p < object.model->parts.size(); ++p, ++next) {
      const Mesh& mesh = object.mesh(p);
      has_changed |=
          move(next, mesh, object.world_from_model * pose[std::size_t(object.model->parts[p].node)],
               object.is_visible);
      if (&mesh == &object.model->parts[p].mesh || !places_[next]->is_traced) continue;
      deform(next);
      has_changed = true;
    }
  }
  if (!scene.traced_kinds.empty()) {
    std::vector<std::shared_ptr<const void>> last = std::move(kept_);
    kept_.clear();
    forget_things();
    trace_things(scene);
    forget_meshes_but_those_placed();
    has_changed |= places_.size() > object_places_;  // they may have moved
  }
  if (has_changed) commit();
  return has_changed;
}

Bounds RayScene::fixed_bounds(const scene::Scene& scene) const {
  Bounds bounds;
  for (const std::unique_ptr<PlacedPart>& place : places_) {
    const auto object = std::size_t(place->object);
    const bool is_dynamic = object < scene.objects.size() && scene.objects[object].is_dynamic;
    if (place->is_traced && !is_dynamic)
      bounds.add(transformed(place->world_from_mesh, place->mesh->bounds()));
  }
  return bounds;
}

/// Embree's hierarchies of meshes that no place shows any more.
void RayScene::forget_meshes_but_those_placed() {
  std::unordered_set<const Mesh*> placed;
  for (const std::unique_ptr<PlacedPart>& place : places_) placed.insert(place->mesh);
  std::erase_if(mesh_scenes_, [&](const auto& entry) {
    if (placed.contains(entry.first)) return false;
    rtcReleaseScene(entry.second);
    return true;
  });
}

RayScene::~RayScene() {
  rtcReleaseScene(top_);
  rtcReleaseScene(joined_);
  for (const auto& [mesh, scene] : mesh_scenes_) rtcReleaseScene(scene);
  rtcReleaseDevice(device_);
}

const std::vector<MipTexture>& RayScene::textures_of(const scene::Model& model) {
  auto& textures = textures_[&model];
  if (textures) return *textures;
  textures = std::make_unique<std::vector<MipTexture>>();
  const std::vector<char> is_cutout = scene::cutout_textures(model);
  for (std::size_t t = 0; t < model.textures.size(); ++t)
    textures->emplace_back(model.textures[t], is_cutout[t] != 0);
  return *textures;
}

void RayScene::add_object(const scene::Object& object, int number) {
  const scene::Model& model = *object.model;
  const bool is_still = !object.is_dynamic && object.deformed_meshes.empty();
  const std::vector<glm::mat4> pose = object.pose.empty() ? scene::rest_pose(model) : object.pose;
  for (std::size_t p = 0; p < model.parts.size(); ++p)
    place(model, p, object.mesh(p), object.world_from_model * pose[std::size_t(model.parts[p].node)], number,
          object.takes_reflection, object.is_visible, is_still && placed_[&object.mesh(p)] == 1);
}

void RayScene::place(const scene::Model& model, std::size_t p, const Mesh& mesh,
                     const glm::mat4& world_from_mesh, int number, bool takes_reflection, bool is_visible,
                     bool may_join) {
  const scene::Part& source = model.parts[p];
  PlacedPart part{};
  part.mesh = &mesh;
  part.part = int(p);
  part.material = &model.materials[std::size_t(source.material)];
  part.textures = &textures_of(model);
  part.world_from_mesh = world_from_mesh;
  part.object = number;
  part.casts_shadow = source.casts_shadow && shadows_.casts(std::size_t(number));
  part.receives_shadow = shadows_.receives(std::size_t(number));
  part.is_mirror = takes_reflection && part.material->is_mirror_like;
  place(part, is_visible, may_join);
}

void RayScene::place(const PlacedPart& part, bool is_visible, bool may_join) {
  places_.push_back(std::make_unique<PlacedPart>(part));
  triangle_count_ += part.mesh->triangle_count();
  RTCGeometry instance = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcAttachGeometryByID(top_, instance, instance_of(places_.size() - 1));
  rtcDisableGeometry(instance);
  rtcReleaseGeometry(instance);
  const float volume = glm::determinant(glm::mat3(part.world_from_mesh));
  if (may_join && is_visible && !part.mesh->indices.empty() && volume > 0.0f && std::isfinite(volume))
    return join(places_.size() - 1);
  move(places_.size() - 1, *part.mesh, part.world_from_mesh, is_visible);
}

/// Adds the triangles of a part to those in the world. Mirroring transforms have no business there: they
/// exchange front and back.
void RayScene::join(std::size_t place) {
  PlacedPart& part = *places_[place];
  const RTCGeometry geometry = triangles(*part.mesh, part.world_from_mesh);
  rtcAttachGeometryByID(joined_, geometry, unsigned(place));
  rtcReleaseGeometry(geometry);
  part.world_from_normal = glm::transpose(glm::inverse(glm::mat3(part.world_from_mesh)));
  part.is_joined = part.is_traced = true, part.is_mirrored = false;
  has_other_joined_ = true;
}

/// What is hidden or moves after all is an instance of its own from then on.
void RayScene::leave_joined(std::size_t place) {
  rtcDetachGeometry(joined_, unsigned(place));
  places_[place]->is_joined = places_[place]->is_traced = false;
  has_other_joined_ = true;
}

/// An instance stays, disabled, where nothing of it can be seen. Its mesh gets a hierarchy when it is first
/// seen.
bool RayScene::move(std::size_t number, const Mesh& mesh, const glm::mat4& world_from_mesh, bool is_visible) {
  PlacedPart& part = *places_[number];
  const float volume = glm::determinant(glm::mat3(world_from_mesh));
  const bool is_seen = is_visible && !mesh.indices.empty() && volume != 0.0f && std::isfinite(volume);
  const bool is_same = part.world_from_mesh == world_from_mesh && part.mesh == &mesh;
  if (is_seen == part.is_traced && (is_same || !is_seen)) return false;
  if (part.is_joined) leave_joined(number);
  const RTCGeometry instance = rtcGetGeometry(top_, instance_of(number));
  part.is_traced = is_seen;
  if (!is_seen) {
    rtcDisableGeometry(instance);
    return true;
  }
  part.mesh = &mesh;
  part.world_from_mesh = world_from_mesh;
  part.world_from_normal = glm::transpose(glm::inverse(glm::mat3(world_from_mesh)));
  part.is_mirrored = volume < 0.0f;
  rtcSetGeometryInstancedScene(instance, mesh_scene(mesh));
  rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, glm::value_ptr(world_from_mesh));
  rtcEnableGeometry(instance);
  rtcCommitGeometry(instance);
  return true;
}

RTCScene RayScene::mesh_scene(const Mesh& mesh) {
  const auto [entry, is_new] = mesh_scenes_.try_emplace(&mesh, nullptr);
  if (!is_new) return entry->second;
  const RTCGeometry geometry = triangles(mesh, glm::mat4(1.0f));
  entry->second = rtcNewScene(device_);
  rtcSetSceneFlags(entry->second, RTC_SCENE_FLAG_ROBUST);  // no ray slips between two triangles
  rtcAttachGeometry(entry->second, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(entry->second);
  return entry->second;
}

RTCGeometry RayScene::triangles(const Mesh& mesh, const glm::mat4& transform) const {
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  glm::vec3* const vertices = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), mesh.positions.size()));
  const bool is_moved = transform != glm::mat4(1.0f);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    vertices[i] = is_moved ? glm::vec3(transform * glm::vec4(mesh.positions[i], 1.0f)) : mesh.positions[i];
  void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                          3 * sizeof(std::uint32_t), mesh.triangle_count());
  std::copy(mesh.indices.begin(), mesh.indices.end(), static_cast<std::uint32_t*>(indices));
  rtcSetGeometryIntersectFilterFunction(geometry, pass_through_holes<false>);
  rtcSetGeometryOccludedFilterFunction(geometry, pass_through_holes<true>);
  rtcCommitGeometry(geometry);
  return geometry;
}

/// The hierarchy keeps its tree and fits it to the corners as they are deformed now.
void RayScene::deform(std::size_t place) {
  const Mesh& mesh = *places_[place]->mesh;
  const RTCScene scene = mesh_scene(mesh);
  const RTCGeometry geometry = rtcGetGeometry(scene, 0);
  void* vertices = rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_VERTEX, 0);
  std::copy(mesh.positions.begin(), mesh.positions.end(), static_cast<glm::vec3*>(vertices));
  rtcUpdateGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0);
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_REFIT);
  rtcCommitGeometry(geometry);
  rtcCommitScene(scene);
  rtcCommitGeometry(rtcGetGeometry(top_, instance_of(place)));
}

/// Embree asserts that rays are finite. One that is not hits nothing: a surface so degenerate that it has no
/// normal must not end the program.
static bool is_finite(const Ray& ray) {
  constexpr float embree_limit = 1.8e18f;
  const auto fits = [](glm::vec3 v) {
    return std::abs(v.x) < embree_limit && std::abs(v.y) < embree_limit && std::abs(v.z) < embree_limit;
  };
  return fits(ray.origin) && fits(ray.direction) && ray.min_m <= ray.max_m;
}

std::optional<Hit> RayScene::nearest_hit(const Ray& ray, Passage* passage) const {
  if (!is_finite(ray)) return std::nullopt;
  QueryContext context(places_, passage);
  RTCRayHit query{};
  query.ray = embree_ray(ray);
  query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(top_, &context.embree, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  const std::size_t place = place_of(query.hit.instID[0], query.hit.geomID);
  return Hit{places_[place].get(), query.hit.primID, query.hit.u, query.hit.v, query.ray.tfar};
}

bool RayScene::is_blocked(const Ray& ray, Passage* passage) const {
  if (!is_finite(ray)) return false;
  QueryContext context(places_, passage);
  RTCRay query = embree_ray(ray);
  rtcOccluded1(top_, &context.embree, &query);
  return query.tfar < 0.0f;
}

std::optional<Hit> RayScene::nearest_hit(const Ray& ray) const { return nearest_hit(ray, nullptr); }
std::optional<Hit> RayScene::nearest_hit(const Ray& ray, Passage& passage) const {
  return nearest_hit(ray, &passage);
}
bool RayScene::is_blocked(const Ray& ray) const { return is_blocked(ray, nullptr); }
bool RayScene::is_blocked(const Ray& ray, Passage& passage) const { return is_blocked(ray, &passage); }

}  // namespace parvis::reference
