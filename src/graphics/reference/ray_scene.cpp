#include "graphics/reference/ray_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <iterator>
#include <numeric>
#include <unordered_set>
#include <utility>

#include "graphics/reference/ray_query.h"
#include "scene/data/mip_levels.h"

namespace parvis::reference {
namespace {

/// Error of single precision, as a fraction of the distance of corners and rays from the origin: several
/// roundings of 6e-8 each, and as much again to spare.
constexpr float share_of_rounding = 4e-6f;

/// No ray slips between two triangles, and queries bring filters of their own.
const auto traced_flags = RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;

/// The volume of a transformed unit volume, negative if it mirrors; 0 if it leads nowhere finite.
float volume_of(const glm::mat4& world_from_mesh) {
  const float volume = glm::determinant(glm::mat3(world_from_mesh));
  const glm::vec3 place(world_from_mesh[3]);
  return std::isfinite(volume + place.x + place.y + place.z) ? volume : 0.0f;
}

/// Sets the share of each corner's triangle, which was grown by `margin`: a point whose barycentric weights
/// are all larger lies within the triangle as it was, by as much again as it has been grown.
void set_certain_shares(const glm::vec3* corners, std::size_t count, float margin, float* shares) {
  for (std::size_t i = 0; i + 2 < count; i += 3) {
    const glm::vec3 ab = corners[i + 1] - corners[i], ac = corners[i + 2] - corners[i];
    const float longest = std::max({glm::length(ab), glm::length(ac), glm::length(ac - ab)});
    const float min_height = glm::length(glm::cross(ab, ac)) / longest;
    const float share = 2.0f * margin / min_height;
    shares[i] = shares[i + 1] = shares[i + 2] = share < 1.0f ? share : 1.0f;  // not a number: of no area
  }
}

/// How far from the origin anything lies that rays may hit. What has no finite place is left out.
class Reach final : public scene::TracedScene {
 public:
  void add(const Bounds& bounds) {
    for (int axis = 0; axis < 3; ++axis) {
      const float reach = std::max(std::abs(bounds.min[axis]), std::abs(bounds.max[axis]));
      if (bounds.min[axis] <= bounds.max[axis] && std::isfinite(reach)) reach_ = std::max(reach_, reach);
    }
  }
  void add(std::shared_ptr<const Mesh> mesh, std::shared_ptr<const scene::TracedSurface>,
           const glm::mat4& world_from_mesh, const scene::TracedPlacing&) override {
    add(transformed(world_from_mesh, mesh->bounds()));
  }
  void add(std::shared_ptr<const scene::Model> model, const glm::mat4& world_from_model,
           const scene::TracedPlacing&) override {
    const std::vector<glm::mat4> pose = scene::rest_pose(*model);
    for (const scene::Part& part : model->parts)
      add(transformed(world_from_model * pose[std::size_t(part.node)], part.mesh.bounds()));
  }
  float value() const { return reach_; }

 private:
  float reach_ = 1.0f;
};

float reach_of(const scene::Scene& scene) {
  Reach reach;
  for (const scene::Object& object : scene.objects) {
    const std::vector<glm::mat4> pose = object.pose.empty() ? scene::rest_pose(*object.model) : object.pose;
    for (std::size_t p = 0; p < object.model->parts.size(); ++p)
      reach.add(transformed(object.world_from_model * pose[std::size_t(object.model->parts[p].node)],
                            object.mesh(p).bounds()));
  }
  scene::for_each_traced_kind(scene, [&](const scene::TracedKind& kind, int) { kind.trace(scene, reach); });
  return reach.value();
}

/// Neither has moved to become the other.
bool stand_alike(const PlacedPart& one, const PlacedPart& other) {
  if (one.is_traced != other.is_traced) return false;
  return !one.is_traced ||
         (one.world_from_mesh == other.world_from_mesh && one.casts_shadow == other.casts_shadow &&
          one.mesh->positions == other.mesh->positions && one.mesh->indices == other.mesh->indices);
}

}  // namespace

/// Takes over what rooms draw by themselves.
class RayScene::TracedThings final : public scene::TracedScene {
 public:
  TracedThings(RayScene& rays, int first_thing, bool is_recorded)
      : rays_(rays), first_thing_(first_thing), is_recorded_(is_recorded) {}

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
    part.casts_shadow = placing.casts_shadow && !placing.is_backdrop;
    part.is_recorded = is_recorded_;
    part.is_backdrop = placing.is_backdrop;
    rays_.place(part, true);
    rays_.kept_.insert(rays_.kept_.end(), {std::move(mesh), std::move(surface), std::move(material)});
  }

  void add(std::shared_ptr<const scene::Model> model, const glm::mat4& world_from_model,
           const scene::TracedPlacing& placing) override {
    if (!placing.is_visible) return;
    const std::vector<glm::mat4> pose = scene::rest_pose(*model);
    for (std::size_t p = 0; p < model->parts.size(); ++p) {
      const scene::Part& source = model->parts[p];
      PlacedPart part =
          rays_.part_of(*model, model->materials, p, source.mesh,
                        world_from_model * pose[std::size_t(source.node)], first_thing_ + placing.thing);
      part.is_backdrop |= placing.is_backdrop;
      part.casts_shadow &= placing.casts_shadow && !placing.is_backdrop;
      part.is_recorded = is_recorded_;
      rays_.place(part, true);
    }
    rays_.kept_.push_back(std::move(model));
  }

 private:
  RayScene& rays_;
  int first_thing_;
  bool is_recorded_;
};

RayScene::RayScene(const scene::Scene& scene, Precision precision)
    : shadows_(scene.data<scene::SunShadows>()),
      leaves_(scene.data<scene::LeafOpenness>()),
      device_(rtcNewDevice(nullptr)),
      has_wide_packets_(rtcGetDeviceProperty(device_, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0),
      top_(rtcNewScene(device_)),
      joined_(rtcNewScene(device_)),
      margin_m_(precision == Precision::fine ? share_of_rounding * reach_of(scene) : 0.0f) {
  rtcSetSceneFlags(joined_, traced_flags);
  RTCGeometry instance = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(instance, joined_);
  rtcAttachGeometryByID(top_, instance, joined_instance);
  rtcReleaseGeometry(instance);
  for (const scene::Object& object : scene.objects)
    for (std::size_t p = 0; p < object.model->parts.size(); ++p) ++placed_[&object.mesh(p)];
  for (std::size_t o = 0; o < scene.objects.size(); ++o) add_object(scene.objects[o], int(o));
  object_places_ = places_.size(), object_count_ = scene.objects.size();
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
    TracedThings things(*this, first_thing, kind.is_recorded);
    kind.trace(scene, things);
  });
}

/// Traced things are described as a whole for each picture: only their meshes may be those of the last one.
std::vector<std::unique_ptr<PlacedPart>> RayScene::forget_things() {
  for (std::size_t i = object_places_; i < places_.size(); ++i) {
    triangle_count_ -= places_[i]->mesh->triangle_count();
    rtcDetachGeometry(top_, instance_of(i));
  }
  std::vector<std::unique_ptr<PlacedPart>> things(
      std::make_move_iterator(places_.begin() + std::ptrdiff_t(object_places_)),
      std::make_move_iterator(places_.end()));
  places_.resize(object_places_);
  return things;
}

void RayScene::trace_things_again(const scene::Scene& scene) {
  const std::vector<std::shared_ptr<const void>> last = std::exchange(kept_, {});
  const std::vector<std::unique_ptr<PlacedPart>> before = forget_things();
  trace_things(scene);
  forget_meshes_but_those_placed();
  const std::size_t after = places_.size() - object_places_;
  for (std::size_t i = 0; i < std::max(before.size(), after); ++i) {
    const PlacedPart* was = i < before.size() ? before[i].get() : nullptr;
    const PlacedPart* is = i < after ? places_[object_places_ + i].get() : nullptr;
    if (was && is && stand_alike(*was, *is)) continue;
    for (const PlacedPart* place : {was, is})
      if (place && place->is_traced) moved_.push_back(place->bounds);
  }
}

/// Those that have come. What rooms draw by themselves is numbered behind them and has to be traced again.
void RayScene::add_objects(const scene::Scene& scene) {
  shadows_ = scene.data<scene::SunShadows>(), leaves_ = scene.data<scene::LeafOpenness>();
  forget_things();
  for (std::size_t o = object_count_; o < scene.objects.size(); ++o) {
    const scene::Object& object = scene.objects[o];
    for (std::size_t p = 0; p < object.model->parts.size(); ++p)
      placed_[&object.mesh(p)] += 2;  // never joined
    add_object(object, int(o));
    for (const PlacedPart* part : parts_of(int(o))) moved_.push_back(part->bounds);
  }
  object_places_ = places_.size(), object_count_ = scene.objects.size();
}

bool RayScene::update(const scene::Scene& scene) {
  moved_.clear();
  bool has_changed = scene.objects.size() > object_count_;
  if (has_changed) add_objects(scene);
  std::size_t next = 0;
  for (const scene::Object& object : scene.objects) {
    const std::vector<glm::mat4> pose = object.pose.empty() ? scene::rest_pose(*object.model) : object.pose;
    Bounds before, after;  // of the parts that have moved
    for (std::size_t p = 0; p < object.model->parts.size(); ++p, ++next) {
      const Mesh& mesh = object.mesh(p);
      const PlacedPart& place = *places_[next];
      const bool was_traced = place.is_traced;
      const Bounds last = place.bounds;
      bool has_moved =
          move(next, mesh, object.world_from_model * pose[std::size_t(object.model->parts[p].node)],
               object.is_visible);
      if (&mesh != &object.model->parts[p].mesh && place.is_traced) {
        deform(next);
        has_moved = true;
      }
      if (!has_moved) continue;
      has_changed = true;
      if (was_traced) before.add(last);
      if (place.is_traced) after.add(place.bounds);
    }
    for (const Bounds& box : {before, after})
      if (!box.empty()) moved_.push_back(box);
  }
  if (!scene.traced_kinds.empty()) {
    trace_things_again(scene);
    has_changed |= places_.size() > object_places_;  // they may have moved
  }
  if (has_changed) commit();
  return has_changed;
}

std::vector<const PlacedPart*> RayScene::parts_of(int object) const {
  std::vector<const PlacedPart*> parts;
  for (const std::unique_ptr<PlacedPart>& place : places_)
    if (place->object == object && place->is_traced) parts.push_back(place.get());
  return parts;
}

Bounds RayScene::fixed_bounds(const scene::Scene& scene) const {
  Bounds bounds;
  for (const std::unique_ptr<PlacedPart>& place : places_) {
    const auto object = std::size_t(place->object);
    const bool is_dynamic = object < scene.objects.size() && scene.objects[object].is_dynamic;
    if (place->is_traced && !place->is_backdrop && !is_dynamic)
      bounds.add(transformed(place->world_from_mesh, place->mesh->bounds()));
  }
  return bounds;
}

/// Embree's hierarchies of meshes that no place shows any more, and the textures of their models, which look
/// into these.
void RayScene::forget_meshes_but_those_placed() {
  std::unordered_set<const void*> placed;
  for (const std::unique_ptr<PlacedPart>& place : places_)
    placed.insert(place->mesh), placed.insert(place->textures);
  std::erase_if(textures_, [&](const auto& entry) { return !placed.contains(entry.second.get()); });
  std::erase_if(mesh_scenes_, [&](const auto& entry) {
    if (placed.contains(entry.first.first)) return false;
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
  const std::vector<int> visible = scene::visible_alphas(model);
  for (std::size_t t = 0; t < model.textures.size(); ++t)
    textures->emplace_back(model.textures[t], visible[t]);
  return *textures;
}

void RayScene::add_object(const scene::Object& object, int number) {
  const scene::Model& model = *object.model;
  const bool is_still = !object.is_dynamic && object.deformed_meshes.empty();
  const std::vector<glm::mat4> pose = object.pose.empty() ? scene::rest_pose(model) : object.pose;
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    PlacedPart part = part_of(model, object.materials(), p, object.mesh(p),
                              object.world_from_model * pose[std::size_t(model.parts[p].node)], number);
    part.is_mirror = object.takes_reflection && part.material->is_mirror_like;
    place(part, object.is_visible, is_still && placed_[&object.mesh(p)] == 1);
  }
}

PlacedPart RayScene::part_of(const scene::Model& model, const std::vector<scene::Material>& materials,
                             std::size_t p, const Mesh& mesh, const glm::mat4& world_from_mesh, int number) {
  const scene::Part& source = model.parts[p];
  PlacedPart part{};
  part.mesh = &mesh;
  part.part = int(p);
  part.material = &materials[std::size_t(source.material)];
  part.textures = &textures_of(model);
  part.openness = leaves_.of(model, p);
  part.world_from_mesh = world_from_mesh;
  part.object = number;
  part.casts_shadow = source.casts_shadow && !source.is_backdrop && shadows_.casts(std::size_t(number));
  part.is_painted_shadow = !source.casts_shadow && !source.is_backdrop;
  part.receives_shadow = shadows_.receives(std::size_t(number));
  part.is_backdrop = source.is_backdrop;
  return part;
}

void RayScene::place(const PlacedPart& part, bool is_visible, bool may_join) {
  places_.push_back(std::make_unique<PlacedPart>(part));
  triangle_count_ += part.mesh->triangle_count();
  RTCGeometry instance = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcAttachGeometryByID(top_, instance, instance_of(places_.size() - 1));
  rtcDisableGeometry(instance);
  rtcReleaseGeometry(instance);
  if (may_join && is_visible && !part.mesh->indices.empty() && volume_of(part.world_from_mesh) > 0.0f)
    return join(places_.size() - 1);
  move(places_.size() - 1, *part.mesh, part.world_from_mesh, is_visible);
}

/// Adds the triangles of a part to those in the world. Mirroring transforms have no business there: they
/// exchange front and back.
void RayScene::join(std::size_t place) {
  PlacedPart& part = *places_[place];
  part.world_from_normal = glm::transpose(glm::inverse(glm::mat3(part.world_from_mesh)));
  part.is_joined = part.is_traced = true, part.is_mirrored = false;
  part.bounds = transformed(part.world_from_mesh, part.mesh->bounds());
  part.is_filtered = is_to_be_filtered(part);
  const RTCGeometry geometry = triangles(*part.mesh, part.world_from_mesh, margin_m_, part.is_filtered);
  rtcAttachGeometryByID(joined_, geometry, unsigned(place));
  rtcReleaseGeometry(geometry);
  has_other_joined_ = true;
}

/// Makes a placement that is hidden or moves after all an instance of its own.
void RayScene::leave_joined(std::size_t place) {
  rtcDetachGeometry(joined_, unsigned(place));
  places_[place]->is_joined = places_[place]->is_traced = false;
  has_other_joined_ = true;
}

/// An instance stays, disabled, where nothing of it can be seen. Its mesh gets a hierarchy when it is first
/// seen.
bool RayScene::move(std::size_t number, const Mesh& mesh, const glm::mat4& world_from_mesh, bool is_visible) {
  PlacedPart& part = *places_[number];
  const bool is_seen = is_visible && !mesh.indices.empty() && volume_of(world_from_mesh) != 0.0f;
  const bool is_filtered = is_to_be_filtered(part);  // its material may be another one
  const bool is_same =
      part.world_from_mesh == world_from_mesh && part.mesh == &mesh && part.is_filtered == is_filtered;
  if (is_seen == part.is_traced && (is_same || !is_seen)) return false;
  if (part.is_joined) leave_joined(number);
  const RTCGeometry instance = rtcGetGeometry(top_, instance_of(number));
  part.is_traced = is_seen;
  if (!is_seen) {
    rtcDisableGeometry(instance);
    return true;
  }
  part.mesh = &mesh;
  part.is_filtered = is_filtered;
  part.world_from_mesh = world_from_mesh;
  part.bounds = transformed(world_from_mesh, mesh.bounds());
  part.world_from_normal = glm::transpose(glm::inverse(glm::mat3(world_from_mesh)));
  part.is_mirrored = volume_of(world_from_mesh) < 0.0f;
  rtcSetGeometryInstancedScene(instance, mesh_scene(mesh, world_from_mesh, is_filtered));
  rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, glm::value_ptr(world_from_mesh));
  rtcEnableGeometry(instance);
  rtcCommitGeometry(instance);
  return true;
}

/// The length by which a mesh's triangles are grown in its own frame.
float RayScene::margin_in_mesh(const glm::mat4& world_from_mesh) const {
  return margin_m_ / std::cbrt(std::abs(glm::determinant(glm::mat3(world_from_mesh))));
}

/// Fine rays ask about all triangles.
bool RayScene::is_to_be_filtered(const PlacedPart& part) const {
  return margin_m_ > 0.0f || needs_filter(part);
}

RTCScene RayScene::mesh_scene(const Mesh& mesh, const glm::mat4& world_from_mesh, bool is_filtered) {
  const auto [entry, is_new] = mesh_scenes_.try_emplace({&mesh, is_filtered}, nullptr);
  if (!is_new) return entry->second;
  const RTCGeometry geometry = triangles(mesh, glm::mat4(1.0f), margin_in_mesh(world_from_mesh), is_filtered);
  entry->second = rtcNewScene(device_);
  rtcSetSceneFlags(entry->second, traced_flags);
  rtcAttachGeometry(entry->second, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(entry->second);
  return entry->second;
}

RTCGeometry RayScene::triangles(const Mesh& mesh, const glm::mat4& transform, float margin,
                                bool is_filtered) const {
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  const std::size_t corner_count = margin > 0.0f ? mesh.indices.size() : mesh.positions.size();
  glm::vec3* const corners = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), corner_count));
  set_corners(mesh, transform, margin, corners);
  auto* const indices = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t),
                              mesh.triangle_count()));
  if (margin > 0.0f)
    std::iota(indices, indices + mesh.indices.size(), 0u);  // no triangle shares its grown corners
  else
    std::copy(mesh.indices.begin(), mesh.indices.end(), indices);
  if (margin > 0.0f) {
    rtcSetGeometryVertexAttributeCount(geometry, 1);
    auto* const shares = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX_ATTRIBUTE, 0, RTC_FORMAT_FLOAT, sizeof(float), corner_count));
    set_certain_shares(corners, corner_count, margin, shares);
    rtcSetGeometryUserData(geometry, shares);
  }
  if (is_filtered) {
    rtcSetGeometryIntersectFilterFunction(geometry, filter_seen);
    rtcSetGeometryOccludedFilterFunction(geometry, filter_shadow);
  }
  rtcCommitGeometry(geometry);
  return geometry;
}

/// Sets the corners that Embree gets: those of the mesh, or of each triangle by itself, grown.
void RayScene::set_corners(const Mesh& mesh, const glm::mat4& transform, float margin, glm::vec3* corners) {
  const bool is_moved = transform != glm::mat4(1.0f);
  const auto placed = [&](std::size_t i) {
    return is_moved ? glm::vec3(transform * glm::vec4(mesh.positions[i], 1.0f)) : mesh.positions[i];
  };
  if (margin <= 0.0f) {
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) corners[i] = placed(i);
    return;
  }
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const std::array<glm::vec3, 3> all =
        grown({placed(mesh.indices[i]), placed(mesh.indices[i + 1]), placed(mesh.indices[i + 2])}, margin);
    std::copy(all.begin(), all.end(), corners + i);
  }
}

/// The hierarchy keeps its tree and fits it to the corners as they are deformed now.
void RayScene::deform(std::size_t place) {
  const Mesh& mesh = *places_[place]->mesh;
  const glm::mat4& world_from_mesh = places_[place]->world_from_mesh;
  places_[place]->bounds = transformed(world_from_mesh, mesh.bounds());
  const RTCScene scene = mesh_scene(mesh, world_from_mesh, places_[place]->is_filtered);
  const RTCGeometry geometry = rtcGetGeometry(scene, 0);
  auto* const corners =
      static_cast<glm::vec3*>(rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_VERTEX, 0));
  const float margin = margin_in_mesh(world_from_mesh);
  set_corners(mesh, glm::mat4(1.0f), margin, corners);
  if (void* const shares = rtcGetGeometryUserData(geometry))
    set_certain_shares(corners, mesh.indices.size(), margin, static_cast<float*>(shares));
  rtcUpdateGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0);
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_REFIT);
  rtcCommitGeometry(geometry);
  rtcCommitScene(scene);
  rtcCommitGeometry(rtcGetGeometry(top_, instance_of(place)));
}

}  // namespace parvis::reference
