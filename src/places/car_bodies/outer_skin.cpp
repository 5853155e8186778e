#include "places/car_bodies/outer_skin.h"

#include <algorithm>
#include <limits>

namespace parvis::car_bodies {
namespace {

constexpr float cell_m = 0.03f;
constexpr float skin_depth_m = 0.05f;  // depth of what counts as the surface: seals, recessed panes

}  // namespace

OuterSkin::OuterSkin(const Body& body) : bounds_(body.bounds()) {
  views_ = {{0, 1.0f, 0, {}}, {0, -1.0f, 0, {}}, {1, 1.0f, 0, {}}, {1, -1.0f, 0, {}}, {2, 1.0f, 0, {}}};
  for (View& view : views_) {
    const int across = view.axis == 0 ? 1 : 0, along = view.axis == 2 ? 1 : 2;
    view.columns = columns(across);
    view.outermost.assign(std::size_t(view.columns) * std::size_t(columns(along)),
                          std::numeric_limits<float>::lowest());
  }
  constexpr float step_m = 0.6f * cell_m;  // leaves no cell of a triangle out
  for (std::size_t part = 0; part < body.model().parts.size(); ++part)
    for (std::size_t i = 0; i < body.model().parts[part].mesh.triangle_count(); ++i)
      visit_points(body.corners(part, i), step_m, [&](glm::vec3 at) {
        for (View& view : views_) {
          float& outermost = view.outermost[cell(view, at)];
          outermost = std::max(outermost, view.sign * at[view.axis]);
        }
      });
}

bool OuterSkin::holds(glm::vec3 point) const {
  return std::ranges::any_of(views_, [&](const View& view) {
    return view.sign * point[view.axis] > view.outermost[cell(view, point)] - skin_depth_m;
  });
}

int OuterSkin::columns(int axis) const { return int(bounds_.size()[axis] / cell_m) + 1; }

std::size_t OuterSkin::cell(const View& view, glm::vec3 point) const {
  const int across = view.axis == 0 ? 1 : 0, along = view.axis == 2 ? 1 : 2;
  const auto step = [&](int axis) {
    return std::clamp(int((point[axis] - bounds_.min[axis]) / cell_m), 0, columns(axis) - 1);
  };
  return std::size_t(step(along)) * std::size_t(view.columns) + std::size_t(step(across));
}

}  // namespace parvis::car_bodies
