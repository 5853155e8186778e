#include "capture/facades/shown_colours.h"

#include "base/random.h"

namespace parvis::facades {
namespace {

/// The part of a pixel's colour that counts as none: less than any display shows, and more than rounding
/// errors.
constexpr float no_share = 1e-3f;

View random_view(std::span<const View> cameras, Random& random) {
  constexpr int width = 96, height = 64;
  const auto any = [&] { return std::size_t(random.next() % cameras.size()); };
  const View &a = cameras[any()], &b = cameras[any()], &ahead = cameras[any()];
  View view = ahead;
  view.centre = glm::mix(a.centre, b.centre, double(random.uniform()));
  view.width = width, view.height = height;
  view.fx = view.fy = 0.8 * width, view.cx = 0.5 * width, view.cy = 0.5 * height;
  return view;
}

/// The facade with one colour for corners that have a proposal, and one for those that have none.
PackedFacade with_corners(PackedFacade facade, glm::u8vec3 proposed, glm::u8vec3 without) {
  for (glm::u8vec3& corner : facade.fallback) corner = corner == no_colour ? without : proposed;
  return facade;
}

}  // namespace

// A pixel is a sum of shares of layers and of corners: drawn with black corners, and with red ones where a
// colour is proposed and green ones where none is, it differs by its shares of both.
ShownColours::ShownColours(const PackedFacade& facade)
    : black_corners_(with_corners(facade, {0, 0, 0}, {0, 0, 0})),
      marked_corners_(with_corners(facade, {255, 0, 0}, {0, 255, 0})),
      black_(black_corners_),
      marked_(marked_corners_) {}

std::vector<ColourSource> ShownColours::sources(const View& view) {
  const ItemBuffer seen = item_buffer(black_.model(), view);
  const ImageF black = black_.view(view, seen), marked = marked_.view(view, seen);
  std::vector<ColourSource> sources(seen.triangles.size(), ColourSource::no_model);
  for (std::size_t p = 0; p < sources.size(); ++p) {
    if (seen.triangles[p] == no_triangle_seen) continue;
    const float proposed = marked.pixels[4 * p] - black.pixels[4 * p],
                empty = marked.pixels[4 * p + 1] - black.pixels[4 * p + 1];
    const bool has_colour = empty < no_share && black.pixels[4 * p + 3] > 0.0f;
    sources[p] = !has_colour                  ? ColourSource::none
                 : proposed < 1.0f - no_share ? ColourSource::layers
                                              : ColourSource::proposed;
  }
  return sources;
}

std::vector<View> random_views(std::span<const View> cameras, int count) {
  std::vector<View> views;
  Random random(1);
  for (int i = 0; i < count; ++i) views.push_back(random_view(cameras, random));
  return views;
}

ShownShares shown_shares(const PackedFacade& facade, std::span<const View> views) {
  ShownColours colours(facade);
  std::size_t of_model = 0, filled = 0, layered = 0;
  for (const View& view : views)
    for (const ColourSource source : colours.sources(view)) {
      of_model += source != ColourSource::no_model;
      filled += source == ColourSource::proposed || source == ColourSource::layers;
      layered += source == ColourSource::layers;
    }
  if (of_model == 0) return {};
  return {100.0 * double(filled) / double(of_model), 100.0 * double(layered) / double(of_model)};
}

}  // namespace parvis::facades
