#include "rooms/test_room/room.h"

#include "base/files.h"
#include "graphics/render/bake_steps.h"
#include "reflections/methods/registry.h"
#include "rooms/test_room/balloons.h"
#include "scene/data/test_scene.h"
#include "scene/script/attribute.h"
#include "scene/script/scene_builder.h"

namespace parvis::test_room {
namespace {

using namespace scene::attribute;
namespace fs = std::filesystem;

scene::NodeSchema balloon_schema() {
  return {.type = "balloon",
          .help = "A mirror ball that rises.",
          .attributes = {text("name", "of the object"),
                         vec3("position", "of its centre").in("m").by_default("0 0 0"),
                         number("radius", "of the ball").in("m").between(0.01, 100).by_default("1")},
          .example = "balloon(name=red, position=\"0 0 5\", radius=0.5)",
          .messages = {{"rise", "at this speed from now on", {number("speed", "").in("m/s").required()}}}};
}

void build_balloon(const scene::Node& node, scene::SceneBuilder& builder) {
  const float radius_m = float(node.number("radius"));
  scene::Material mirror;
  mirror.base_colour = glm::vec3(1.0f);
  mirror.metallic = 1.0f;
  mirror.roughness = 0.0f;
  mirror.is_mirror_like = true;
  scene::Object object;
  object.name = node.text("name");
  object.model = scene::model_of(scene::sphere(glm::vec3(0.0f), radius_m), mirror);
  object.world_from_model = glm::translate(builder.world_from_parent(), node.vec3("position"));
  object.is_dynamic = object.takes_reflection = true;
  object.is_visible = builder.is_visible();
  builder.add(std::move(object));
  builder.add(Balloon{radius_m});
}

class GlowReflections final : public methods::Reflections {
 public:
  explicit GlowReflections(float radiance) : radiance_(radiance) {}
  render::SurfaceSource source() const override {
    return {.reflection = fmt::format("vec3(0.0f, {:.6f}f, 0.0f)", radiance_)};
  }
  void bind(const gl::Program&, int) override {}

 private:
  void update_maps(render::Renderer&, const scene::Scene&,
                   const std::vector<methods::VisibleReflector>&) override {}
  float radiance_;
};

methods::Method glow_method() {
  return {.name = "balloon_glow",
          .help = "mirrors shine green",
          .make = [](const scene::Scene& scene, render::Renderer&,
                     std::unique_ptr<methods::Reflections>) -> Result<std::unique_ptr<methods::Reflections>> {
            return std::unique_ptr<methods::Reflections>(
                std::make_unique<GlowReflections>(methods::own_settings<Glow>(scene).radiance));
          },
          .attributes = {number("glow", "radiance of balloon_glow").between(0, 100).by_default("0.25")},
          .read =
              [](const scene::Node& node, methods::Settings& settings) {
                settings.own.get<Glow>().radiance = float(node.number("glow"));
              }};
}

float volume_m3(const scene::Scene& scene) {
  float sum = 0.0f;
  for (const Balloon& balloon : scene.items<Balloon>())
    sum += 4.18879f * balloon.radius_m * balloon.radius_m * balloon.radius_m;
  return sum;
}

fs::path baked_folder(const scene::Scene& scene) {
  return fs::path(scene.file).replace_extension(".baked") / "balloons";
}

/// Keeps the volume of all balloons in a file named by the hash of their radii.
Result<render::Baked> bake_volume(render::BakeInput& input) {
  ContentHash hash;
  for (const Balloon& balloon : input.scene().items<Balloon>()) balloon.hash(hash);
  const fs::path file = baked_folder(input.scene()) / fmt::format("{:016x}.txt", hash.value());
  std::error_code code;
  fs::create_directories(file.parent_path(), code);
  if (Status status = write_file(file, fmt::format("{:.3f}\n", volume_m3(input.scene()))); !status)
    return status.errors();
  return render::Baked{{file}, fmt::format("balloons: {}", file.string())};
}

void forget_other_volumes(const scene::Scene& scene, const std::set<fs::path>& kept) {
  std::error_code code;
  std::vector<fs::path> others;
  for (const fs::directory_entry& entry : fs::directory_iterator(baked_folder(scene), code))
    if (!kept.contains(entry.path())) others.push_back(entry.path());
  for (const fs::path& other : others) fs::remove(other, code);
}

}  // namespace

void register_room(Registries& registries) {
  registries.get<scene::NodeRegistry>().add(balloon_schema(), build_balloon);
  registries.get<action::Processes>().add([] { return std::make_unique<BalloonProcess>(); });
  registries.get<methods::Registry>().add(glow_method());
  registries.get<render::BakeSteps>().add(
      {.name = "volume of balloons", .run = bake_volume, .forget_others = forget_other_volumes});
}

}  // namespace parvis::test_room
