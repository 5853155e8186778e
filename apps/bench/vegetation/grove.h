// A grove of oaks on a lawn, drawn by the renderer, and what its views draw of them.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "bench/benches.h"
#include "graphics/render/frame_views.h"
#include "graphics/render/renderer.h"
#include "life/vegetation/plant_selection.h"
#include "life/vegetation/scene_plant.h"

namespace parvis::bench {

/// The drawable of all plants, which counts what it draws in each view of a frame: the main one and those of
/// shadow maps.
class CountedPlants final : public render::Drawable {
 public:
  /// Of one view.
  struct View {
    render::ViewKind kind;
    vegetation::PlantStatistics chosen;  ///< what the view is to draw
    float scale;                         ///< below 1 the budget is kept by it: PlantSelection::scale
    std::size_t drawn = 0;               ///< primitives that OpenGL has counted
  };

  explicit CountedPlants(std::unique_ptr<render::Drawable> plants) : plants_drawn_(std::move(plants)) {}

  void update(const scene::Scene& scene) override;
  render::Extents extents() const override { return plants_drawn_->extents(); }
  std::span<render::QualityWish> quality_wishes(const render::View& view,
                                                const render::Culling& culling) override {
    return plants_drawn_->quality_wishes(view, culling);
  }
  void prepare(const render::View& view, const render::Culling& culling) override;
  void draw(const render::View& view, render::Pass pass) override;

  /// Counts from now on.
  void begin() { is_counting_ = true; }
  /// The views since `begin`; counts no more, so that frames which are timed take no time for it.
  std::vector<View> end();

 private:
  std::unique_ptr<render::Drawable> plants_drawn_;
  bool is_counting_ = false;
  std::vector<vegetation::PlacedPlant> plants_;
  vegetation::PlantDetail detail_;
  vegetation::PlantSelection selection_;
  std::vector<View> views_;
};

/// By which the sun turns in a minute.
inline constexpr float minute_of_sun_deg = 0.25f;

/// 200 oaks of a million triangles each, of four shapes, in ten rows.
class Grove {
 public:
  static constexpr int width = 640, height = 360;
  static constexpr int rows = 10, columns = 20;

  /// Fails if the oaks have fewer triangles, or if the renderer does. Needs a current OpenGL context.
  static Result<std::unique_ptr<Grove>> create(const BenchSetup& setup, Report& report);
  Grove(const Grove&) = delete;

  /// Shows the rows of trees that are nearest to the lawn: the real geometry of all takes minutes.
  void show_rows(int shown);
  /// Shows one tree alone, and returns the middle of its crown.
  glm::vec3 show_one();
  /// Whether trees cast shadows, as they do at first.
  void let_cast(bool cast);
  /// About the vertical, so that the next frame draws its shadow maps again.
  void turn_sun(float degrees);

  /// A frame as it ships, or in some detail with `scale` times the pixels of a picture, across and down.
  Status draw(const Camera& camera, const vegetation::PlantDetail& detail = {}, int scale = 1);
  /// The picture of such a frame.
  Result<Image8> picture(const Camera& camera, const vegetation::PlantDetail& detail = {});
  /// The real geometry, whose pixels are the mean of many samples: leaves are smaller than pixels, and the
  /// few samples that a picture has of each show which of them they hit, not what a crown looks like.
  Result<Image8> true_picture(const Camera& camera);
  /// Samples of a true picture over those of a picture, across and down.
  static constexpr int supersample = 4;

  /// What the main view of a camera would draw in some detail; nothing is drawn.
  CountedPlants::View chosen(const Camera& camera, const vegetation::PlantDetail& detail) const;
  /// The detail by which a picture of `camera` shows plants as if its resolution were smaller by `scale`, at
  /// most 1: the largest budget that is kept by no larger a factor.
  vegetation::PlantDetail detail_at(const Camera& camera, float scale) const;
  /// What all views of a frame draw whose shadow maps are drawn again, the sun having moved. Fails where one
  /// of them draws other primitives than it has chosen.
  Result<std::vector<CountedPlants::View>> counted(const Camera& camera);

 private:
  Grove() = default;

  scene::Scene scene_;
  CountedPlants* plants_ = nullptr;  ///< the renderer's
  std::unique_ptr<render::Renderer> renderer_;
};

}  // namespace parvis::bench
