#include "capture/facades/place_figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/image_io.h"
#include "base/median.h"
#include "capture/facades/facade_lookup.h"
#include "capture/facades/item_buffer.h"
#include "capture/facades/layer_colours.h"

namespace parvis::facades {
namespace {

constexpr int panel_width = 640;  ///< pixels of one photograph in a figure
constexpr int gap = 8;
constexpr std::size_t max_rows = 4;
constexpr std::array<std::uint8_t, 3> nobody{200, 40, 30};

/// A white sheet of panels, each a picture of at most panel_width pixels per row.
class Sheet {
 public:
  Sheet(int columns, int rows, double aspect)
      : height_(int(std::lround(panel_width / aspect))),
        image_(columns * (panel_width + gap) - gap, rows * (height_ + gap) - gap, 3, 255) {}

  /// The picture (3 or 4 channels), by the mean of the pixels that each pixel of the panel covers.
  void put(int column, int row, const Image8& picture) {
    const int left = column * (panel_width + gap), top = row * (height_ + gap);
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < panel_width; ++x) {
        const int u0 = x * picture.width / panel_width, v0 = y * picture.height / height_;
        const int u1 = std::max((x + 1) * picture.width / panel_width, u0 + 1),
                  v1 = std::max((y + 1) * picture.height / height_, v0 + 1);
        std::array<int, 3> sum{};
        for (int v = v0; v < v1; ++v)
          for (int u = u0; u < u1; ++u)
            for (std::size_t c = 0; c < 3; ++c) sum[c] += picture.at(u, v)[c];
        for (std::size_t c = 0; c < 3; ++c)
          image_.at(left + x, top + y)[c] = std::uint8_t(sum[c] / ((u1 - u0) * (v1 - v0)));
      }
  }
  Image8 take() { return std::move(image_); }

 private:
  int height_;
  Image8 image_;
};

double aspect_of(const View& view) { return double(view.width) / view.height; }

/// The pattern that editors show where a layer is transparent.
Image8 checkerboard(const View& view) {
  Image8 board(view.width, view.height, 3);
  const int side = std::max(view.width / 80, 2);
  for (int y = 0; y < board.height; ++y)
    for (int x = 0; x < board.width; ++x)
      std::fill_n(board.at(x, y), 3, std::uint8_t((x / side + y / side) % 2 == 0 ? 235 : 200));
  return board;
}

/// Puts a layer's pixels where `shows` says of mask (covered, seen) and source that they are to be shown.
template <class Shows>
void put_layer(const PlaceLayers& place, std::size_t photo, std::size_t layer, const Image8& pixels,
               Shows shows, Image8& board) {
  const PixelBox& box = place.layered[photo].layers[layer].box;
  for (int y = 0; y < box.height; ++y)
    for (int x = 0; x < box.width; ++x) {
      const std::uint8_t* mask = place.layered[photo].masks[layer].at(x, y);
      if (mask[0] != 0 && shows(mask[1] != 0))
        std::copy_n(pixels.at(x, y), 3, board.at(box.x + x, box.y + y));
    }
}

void frame(const PixelBox& box, std::array<std::uint8_t, 3> colour, Image8& image) {
  const int line = std::max(image.width / 320, 1);
  for (int y = std::max(box.y, 0); y < std::min(box.y + box.height, image.height); ++y)
    for (int x = std::max(box.x, 0); x < std::min(box.x + box.width, image.width); ++x) {
      const int inside =
          std::min({x - box.x, y - box.y, box.x + box.width - 1 - x, box.y + box.height - 1 - y});
      if (inside < line) std::ranges::copy(colour, image.at(x, y));
    }
}

/// A view from aside: moved to the right by a part of the median distance of what the photograph sees.
View aside(const PlaceLayers& place, std::size_t photo) {
  View view = place.views[photo];
  const ItemBuffer seen = item_buffer(place.model, view);
  std::vector<float> depths;
  for (std::size_t i = 0; i < seen.depths.size(); i += 97)
    if (const std::uint32_t t = seen.triangles[i];
        t != no_triangle_seen && !place.model.objects[place.model.triangles[t].object].is_backdrop)
      depths.push_back(float(seen.depths[i]));
  if (depths.empty()) return view;
  const glm::dvec3 right = glm::transpose(view.camera_from_world)[0];
  constexpr double part = 0.3;
  view.centre += part * double(median(std::move(depths))) * right;
  return view;
}

/// The three photographs of figure 3.14, and a view from beside the middle one.
std::array<std::size_t, 3> three_of(const PlaceLayers& place) {
  return {0, place.views.size() / 2, place.views.size() - 1};
}
View common_view(const PlaceLayers& place) { return aside(place, three_of(place)[1]); }

/// How many of three photographs see what is behind each pixel of the common view, and how many have it in
/// their layers; -1: no model.
struct Covered {
  std::vector<int> seen, layered;
};

Covered covered(const PlaceLayers& place) {
  constexpr double tolerance = 0.01;  // of the depth
  const View view = common_view(place);
  const ItemBuffer buffer = item_buffer(place.model, view);
  Covered result{std::vector<int>(buffer.triangles.size(), -1), {}};
  for (std::size_t i = 0; i < result.seen.size(); ++i) {
    const std::uint32_t t = buffer.triangles[i];
    if (t != no_triangle_seen && !place.model.objects[place.model.triangles[t].object].is_backdrop)
      result.seen[i] = 0;
  }
  result.layered = result.seen;
  for (const std::size_t photo : three_of(place)) {
    const View& from = place.views[photo];
    const ItemBuffer own = item_buffer(place.model, from);
    const std::vector<std::uint32_t> items = item_of_triangle(place.model, place.visibility[photo].items);
    for (int y = 0; y < view.height; ++y)
      for (int x = 0; x < view.width; ++x) {
        const std::size_t i = buffer.index(x, y);
        if (result.seen[i] < 0 || items[buffer.triangles[i]] == no_item) continue;
        const glm::dvec3 p = from.to_camera(view.to_world({x + 0.5, y + 0.5}, double(buffer.depths[i])));
        if (p.z <= 0.0) continue;
        const glm::dvec2 pixel = from.to_pixel(p);
        if (pixel.x < 0 || pixel.y < 0 || pixel.x >= from.width || pixel.y >= from.height) continue;
        const int u = int(pixel.x), v = int(pixel.y);
        const bool is_seen = p.z <= double(own.depths[own.index(u, v)]) * (1.0 + tolerance);
        result.seen[i] += is_seen;
        const std::uint32_t l = place.layered[photo].layer_of_item[items[buffer.triangles[i]]];
        const PixelBox& box = place.layered[photo].layers[l].box;
        const bool is_held = box.contains(u, v) && *place.filled[photo].sources[l].at(u - box.x, v - box.y) !=
                                                       std::uint8_t(FillSource::none);
        result.layered[i] += is_seen || is_held;
      }
  }
  return result;
}

Image8 coverage_picture(const View& view, const std::vector<int>& counts) {
  Image8 picture(view.width, view.height, 3, 255);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] < 0) continue;
    for (std::size_t c = 0; c < 3; ++c)
      picture.pixels[3 * i + c] = counts[i] == 0 ? nobody[c] : std::uint8_t(70 + 55 * std::min(counts[i], 3));
  }
  return picture;
}

Image8 rgb8_on_white(const ImageF& srgb) {
  Image8 bytes(srgb.width, srgb.height, 3, 255);
  for (int y = 0; y < srgb.height; ++y)
    for (int x = 0; x < srgb.width; ++x)
      for (int c = 0; c < 3 && srgb.at(x, y)[3] > 0.0f; ++c)
        bytes.at(x, y)[c] = std::uint8_t(std::lround(255.0f * std::clamp(srgb.at(x, y)[c], 0.0f, 1.0f)));
  return bytes;
}

/// The photograph as its layers have it.
Image8 photograph_of(const PlaceLayers& place, std::size_t photo) {
  Image8 picture(place.views[photo].width, place.views[photo].height, 3, 255);
  for (std::size_t l = place.layered[photo].layers.size(); l-- > 0;)
    put_layer(
        place, photo, l, place.originals[photo][l], [](bool is_seen) { return is_seen; }, picture);
  return picture;
}

}  // namespace

Image8 layers_figure(const PlaceLayers& place, std::size_t photo) {
  const LayeredView& layered = place.layered[photo];
  std::vector<std::size_t> order(layered.layers.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t l) {
    return std::int64_t(layered.layers[l].box.width) * layered.layers[l].box.height;
  });
  order.resize(std::min(order.size(), max_rows));
  std::ranges::sort(order);
  Sheet sheet(2, int(std::max<std::size_t>(order.size(), 1)), aspect_of(place.views[photo]));
  for (std::size_t row = 0; row < order.size(); ++row) {
    const std::size_t l = order[row];
    Image8 before = checkerboard(place.views[photo]), after = before;
    put_layer(
        place, photo, l, place.originals[photo][l], [](bool is_seen) { return is_seen; }, before);
    put_layer(
        place, photo, l, place.filled[photo].pixels[l], [](bool) { return true; }, after);
    sheet.put(0, int(row), before), sheet.put(1, int(row), after);
  }
  return sheet.take();
}

Image8 merging_figure(const PlaceLayers& place, std::size_t photo) {
  const LayeredView& layered = place.layered[photo];
  std::vector<std::size_t> counts(place.visibility[photo].layers.size() + 1, 0);
  for (const ImageLayer& layer : layered.layers) ++counts[layer.visibility];
  const auto fullest = std::uint32_t(std::ranges::max_element(counts) - counts.begin());
  Image8 before = checkerboard(place.views[photo]), after = before;
  PixelBox whole;
  for (std::size_t l = 0; l < layered.layers.size(); ++l) {
    if (layered.layers[l].visibility != fullest) continue;
    whole = united(whole, layered.layers[l].box);
    for (Image8* board : {&before, &after})
      put_layer(
          place, photo, l, place.originals[photo][l], [](bool) { return true; }, *board);
  }
  const auto texture = [](const PixelBox& box) {
    return PixelBox{box.x, box.y, power_of_two_side(box.width), power_of_two_side(box.height)};
  };
  frame(texture(whole), nobody, before);
  for (std::size_t l = 0; l < layered.layers.size(); ++l)
    if (layered.layers[l].visibility == fullest)
      frame(texture(layered.layers[l].box), layer_colour(l), after);
  Sheet sheet(2, 1, aspect_of(place.views[photo]));
  sheet.put(0, 0, before), sheet.put(1, 0, after);
  return sheet.take();
}

Image8 projection_figure(const PlaceLayers& place, const PackedFacade& facade, std::size_t photo) {
  const View view = aside(place, photo);
  const ItemBuffer seen = item_buffer(place.model, view);
  const std::vector<std::uint32_t> items = item_of_triangle(place.model, place.visibility[photo].items);
  std::vector<glm::dmat4> textures;
  for (const ImageLayer& layer : place.layered[photo].layers)
    textures.push_back(texture_from_world(place.views[photo], layer.box));
  Image8 colours(view.width, view.height, 3, 255);
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) {
      const std::uint32_t t = seen.triangles[seen.index(x, y)];
      if (t == no_triangle_seen || items[t] == no_item) continue;
      const std::uint32_t l = place.layered[photo].layer_of_item[items[t]];
      const PixelBox& box = place.layered[photo].layers[l].box;
      const glm::dvec3 point = view.to_world({x + 0.5, y + 0.5}, double(seen.depths[seen.index(x, y)]));
      const glm::dvec4 at = textures[l] * glm::dvec4(point, 1.0);
      const glm::dvec2 in_texture = glm::dvec2(at) / at.w;
      if (!(at.w > 0.0 && std::min(in_texture.x, in_texture.y) >= 0.0 &&
            std::max(in_texture.x, in_texture.y) < 1.0))
        continue;
      const int u = int(in_texture.x * box.width), v = int(in_texture.y * box.height);
      const bool is_seen = place.layered[photo].masks[l].at(u, v)[1] != 0;
      const std::array<std::uint8_t, 3> tint = layer_colour(l);
      const std::uint8_t* own = place.filled[photo].pixels[l].at(u, v);
      for (std::size_t c = 0; c < 3; ++c)
        colours.at(x, y)[c] = std::uint8_t((own[c] + 2 * tint[c]) / (is_seen ? 3 : 8));
    }
  Sheet sheet(2, 1, aspect_of(view));
  sheet.put(0, 0, rgb8_on_white(view_of_facade(facade, FacadeTexels(facade), view))),
      sheet.put(1, 0, colours);
  return sheet.take();
}

Image8 coverage_figure(const PlaceLayers& place) {
  const View view = common_view(place);
  const Covered counts = covered(place);
  Sheet sheet(3, 2, aspect_of(view));
  int column = 0;
  for (const std::size_t photo : three_of(place)) sheet.put(column++, 0, photograph_of(place, photo));
  sheet.put(0, 1, coverage_picture(view, counts.seen));
  sheet.put(1, 1, coverage_picture(view, counts.layered));
  return sheet.take();
}

Coverage coverage_of(const PlaceLayers& place) {
  const Covered counts = covered(place);
  const auto percent = [](const std::vector<int>& list) {
    const auto model = std::ranges::count_if(list, [](int n) { return n >= 0; });
    return model == 0
               ? 0.0
               : 100.0 * double(std::ranges::count_if(list, [](int n) { return n > 0; })) / double(model);
  };
  return {percent(counts.seen), percent(counts.layered)};
}

std::size_t richest_photograph(const PlaceLayers& place) {
  return std::size_t(std::ranges::max_element(place.layered, {},
                                              [](const LayeredView& view) { return view.layers.size(); }) -
                     place.layered.begin());
}

Status write_figures(const std::filesystem::path& folder, const PlaceLayers& place,
                     const PackedFacade& facade, std::size_t photo) {
  const auto write = [&](const char* name, const Image8& picture) {
    return write_image(folder / name, picture);
  };
  if (Status status = write("figure_3_2.png", layers_figure(place, photo)); !status) return status;
  if (Status status = write("figure_3_3.png", projection_figure(place, facade, photo)); !status)
    return status;
  if (Status status = write("figure_3_8.png", merging_figure(place, photo)); !status) return status;
  return write("figure_3_14.png", coverage_figure(place));
}

}  // namespace parvis::facades
