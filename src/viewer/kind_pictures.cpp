#include "viewer/kind_pictures.h"

#include <cstdlib>

#include "base/content_hash.h"
#include "graphics/render/drawables.h"
#include "planning/design/design_nodes.h"
#include "scene/script/scene_builder.h"
#include "scene/script/script_checker.h"

namespace parvis::viewer {
namespace {

constexpr double apart_m = 60.0;      // between kinds: none is in another's picture
constexpr std::uint64_t version = 2;  // of how kinds are drawn: another one draws all again

std::uint64_t key_of(const design::Kind& kind) {
  ContentHash hash;
  for (const std::string& text : {kind.name, kind.shape, kind.plant, kind.file}) hash.add_text(text);
  hash.add(version), hash.add(kind.size_m), hash.add(kind.colour);
  return hash.value();
}

/// All kinds in a row to the east, each on a pale ground.
Result<scene::Scene> scene_of(const std::vector<design::Kind>& kinds, const scene::Scene& place,
                              const scene::NodeRegistry& registry) {
  std::string script = "design(name=catalogue) {\n";
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const double x = apart_m * double(i);
    script += fmt::format("placed(name=kind_{}, kind=\"{}\", position=\"{} 0 0\", heading_deg=180)\n", i,
                          kinds[i].name, x);
    script += fmt::format(
        "surface(material=plain, colour=\"#B9B4AB\", outline=\"{0} -400, {1} -400, {1} 400, {0} 400\")\n",
        x - 0.5 * apart_m, x + 0.5 * apart_m);
  }
  const Result<scene::Nodes> nodes =
      scene::check_piece(script + "}", "catalogue", scene::top_level, {}, registry, Roots(""));
  if (!nodes) return nodes.errors();
  scene::SceneBuilder builder(registry);
  builder.scene.data<design::Kinds>() = place.data<design::Kinds>();
  builder.build(*nodes);
  if (!builder.errors().empty()) return builder.errors();
  builder.scene.exposure = 0.8f;
  return std::move(builder.scene);
}

}  // namespace

KindPictures::KindPictures(const Registries& registries, const scene::Scene& scene,
                           std::filesystem::path folder)
    : registries_(registries), scene_(scene), kept_(std::move(folder)) {}

KindPictures::~KindPictures() = default;

GLuint KindPictures::of(const std::string& kind) const {
  const auto found = textures_.find(kind);
  return found == textures_.end() ? 0 : found->second.name();
}

Status KindPictures::draw(const design::Kind& kind, Image8& picture) {
  const std::vector<design::Kind> kinds = design::kinds_of(scene_);
  if (!stage_ || shown_kinds_ != kinds.size()) {
    shown_kinds_ = kinds.size();
    Result<scene::Scene> scene = scene_of(kinds, scene_, registries_.get<scene::NodeRegistry>());
    if (!scene) return scene.errors();
    Result<std::unique_ptr<stage::Stage>> stage =
        stage::Stage::create(stage::make_simulation(registries_, *std::move(scene)));
    if (!stage) return stage.errors();
    stage_ = *std::move(stage);
  }
  const auto number = std::ranges::find(kinds, kind.name, &design::Kind::name) - kinds.begin();
  const glm::vec3 foot(float(apart_m) * float(number), 0.0f, 0.0f), half = 0.5f * glm::vec3(kind.size_m);
  const glm::vec3 middle = foot + glm::vec3(0.0f, 0.0f, half.z);
  Camera camera;
  camera.vertical_fov = 0.5f;
  const float away_m = 1.15f * glm::length(half) / std::sin(0.5f * camera.vertical_fov);
  camera.world_from_camera =
      look_at(middle + away_m * glm::normalize(glm::vec3(-0.55f, -1.0f, 0.42f)), middle);
  stage_->draw(camera, size, size);
  picture = stage_->picture();
  return Ok{};
}

bool KindPictures::make_one() {
  for (const design::Kind& kind : design::kinds_of(scene_)) {
    if (textures_.contains(kind.name)) continue;
    Image8 picture(size, size, 4);
    const std::optional<std::string> kept = kept_.find(kind.name, key_of(kind), "the picture is drawn again");
    if (kept && kept->size() == picture.pixels.size()) {
      std::copy(kept->begin(), kept->end(), picture.pixels.begin());
    } else {
      if (const Status status = draw(kind, picture); !status)
        fmt::print(stderr, "warning: {}\n", to_string(status.errors()));
      else if (const Status stored =
                   kept_.keep(kind.name, key_of(kind),
                              {reinterpret_cast<const char*>(picture.pixels.data()), picture.pixels.size()});
               !stored)
        fmt::print(stderr, "warning: {}\n", to_string(stored.errors()));
    }
    gl::Texture texture = gl::texture_2d(GL_RGBA8, size, size);
    glTextureSubImage2D(texture.name(), 0, 0, 0, size, size, GL_RGBA, GL_UNSIGNED_BYTE,
                        picture.pixels.data());
    glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    textures_.emplace(kind.name, std::move(texture));
    return true;
  }
  stage_.reset();  // all are drawn
  return false;
}

}  // namespace parvis::viewer
