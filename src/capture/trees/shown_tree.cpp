// The tree is drawn before black and before white: the difference of the two is what it lets through.
#include "capture/trees/shown_tree.h"

#include <algorithm>
#include <glm/gtc/constants.hpp>

#include "capture/trees/tree_drawable.h"
#include "capture/trees/tree_light.h"
#include "graphics/light/sun_and_sky.h"

namespace parvis::trees {
namespace {

constexpr float backdrop_depth = 1e-6f;  // reversed: just before the sky
constexpr int sky_width = 128;           // pixels round the horizon; the sums over a coarser sky are inexact

/// Parvis's camera of a pinhole, whose principal point may lie anywhere.
Camera camera_of(const Pinhole& pinhole) {
  Camera camera;
  camera.world_from_camera = glm::mat4(pinhole.world_from_camera);
  camera.world_from_camera[3] = glm::vec4(pinhole.position_in_world, 1.0f);
  const glm::vec2 size(float(pinhole.width), float(pinhole.height));
  const glm::vec2 low = -pinhole.principal_point / pinhole.focal,
                  high = (size - pinhole.principal_point) / pinhole.focal;
  camera.off_axis = FrustumTangents{low.x, high.x, -high.y, -low.y};
  return camera;
}

}  // namespace

scene::Scene scene_in_light_of(const CapturedLight& light) {
  scene::Scene scene;
  scene.sun.direction_to_sun = light.to_sun;
  scene.sun.irradiance = glm::vec3(glm::pi<float>() * light.sun / mean_albedo);
  scene.sky.picture = ImageF(sky_width, sky_width / 2, 3);
  std::ranges::fill(scene.sky.picture.pixels, light.sky / mean_albedo);
  return scene;
}

/// Drawn behind the main view's opaque surfaces.
class ShownTree::Backdrop final : public render::Drawable {
 public:
  static Result<std::unique_ptr<Backdrop>> create() {
    Result<gl::Program> program =
        gl::Program::create("graphics/render/whole_screen.vert", "capture/trees/backdrop.frag");
    if (!program) return program.errors();
    std::unique_ptr<Backdrop> backdrop(new Backdrop(*std::move(program)));
    backdrop->program_.set("screen_depth", backdrop_depth);
    return backdrop;
  }
  void set(float brightness) { program_.set("brightness", brightness); }

  render::Extents extents() const override { return {}; }
  void prepare(const render::View&, const render::Culling&) override {}
  void draw(const render::View& view, render::Pass pass) override {
    if (view.kind != render::ViewKind::main || pass != render::Pass::opaque) return;
    program_.use();
    glBindVertexArray(no_attributes_.name());
    glDisable(GL_CULL_FACE);
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }

 private:
  explicit Backdrop(gl::Program program) : program_(std::move(program)) {}

  gl::Program program_;
  gl::VertexArray no_attributes_ = gl::VertexArray::create();
};

ShownTree::ShownTree(ShownTree&&) noexcept = default;
ShownTree& ShownTree::operator=(ShownTree&&) noexcept = default;
ShownTree::~ShownTree() = default;

Result<ShownTree> ShownTree::create(std::shared_ptr<const TreeLevels> tree, const scene::Scene& light) {
  auto scene = std::make_unique<scene::Scene>();
  scene->sun = light.sun, scene->sky = light.sky, scene->haze_per_m = light.haze_per_m;
  render::Drawables drawables;
  drawables.add(scene_trees_kind());
  drawables.attach(*scene);
  SceneTree placed;
  placed.tree = std::move(tree);
  if (std::optional<scene::Object> trunk = placed.trunk_object()) scene->objects.push_back(*std::move(trunk));
  scene->data<SceneTrees>().add(std::move(placed), 0);
  return shown(std::move(scene), drawables);
}

Result<ShownTree> ShownTree::of_scene(scene::Scene scene) {
  render::Drawables drawables;
  drawables.attach(scene);
  return shown(std::make_unique<scene::Scene>(std::move(scene)), drawables);
}

Result<ShownTree> ShownTree::shown(std::unique_ptr<scene::Scene> scene, const render::Drawables& drawables) {
  ShownTree shown;
  shown.scene_ = std::move(scene);
  Result<std::unique_ptr<render::Renderer>> renderer =
      render::Renderer::create(*shown.scene_, drawables, light::sun_and_sky);
  if (!renderer) return renderer.errors();
  shown.renderer_ = *std::move(renderer);
  Result<std::unique_ptr<Backdrop>> backdrop = Backdrop::create();
  if (!backdrop) return backdrop.errors();
  shown.backdrop_ = *std::move(backdrop);
  shown.renderer_->add(shown.backdrop_.get());
  return shown;
}

Result<ImageF> ShownTree::before(float backdrop, const render::EyeView& eye) {
  backdrop_->set(backdrop);
  if (Status status = render::draw_frame(*renderer_, *scene_, eye); !status) return status.errors();
  return renderer_->read_radiance();
}

Result<ImageF> ShownTree::picture(const Pinhole& pinhole) {
  const render::EyeView eye{camera_of(pinhole), pinhole.width, pinhole.height};
  Result<ImageF> black = before(0.0f, eye);
  if (!black) return black.errors();
  const Result<ImageF> white = before(1.0f, eye);
  if (!white) return white.errors();
  for (std::size_t i = 0; i < black->pixels.size(); i += 4) {
    float passed = 0.0f;
    for (std::size_t c = 0; c < 3; ++c) passed += (white->pixels[i + c] - black->pixels[i + c]) / 3.0f;
    black->pixels[i + 3] = std::clamp(1.0f - passed, 0.0f, 1.0f);
  }
  return black;
}

}  // namespace parvis::trees
