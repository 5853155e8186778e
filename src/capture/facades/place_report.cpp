#include "capture/facades/place_report.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "base/files.h"
#include "base/image_io.h"
#include "base/progress.h"
#include "capture/facades/item_buffer.h"
#include "capture/facades/layer_colours.h"

namespace parvis::facades {
namespace fs = std::filesystem;
namespace {

constexpr std::array<std::array<std::uint8_t, 3>, 6> source_colours{
    {{30, 30, 30}, {120, 120, 120}, {70, 130, 220}, {235, 150, 40}, {215, 50, 40}, {160, 70, 200}}};
constexpr const char* source_names[] = {"nothing", "seen",   "other photographs",
                                        "patches", "smooth", "painted"};

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text)
    safe += c == '<'   ? "&lt;"
            : c == '>' ? "&gt;"
            : c == '&' ? "&amp;"
            : c == '"' ? "&quot;"
                       : std::string(1, c);
  return safe;
}

/// Pixels of all layers of a photograph by where they come from.
std::array<std::size_t, 6> source_counts(const Filled& filled) {
  std::array<std::size_t, 6> counts{};
  for (const Image8& sources : filled.sources)
    for (const std::uint8_t source : sources.pixels) ++counts[std::min<std::size_t>(source, 5)];
  return counts;
}

std::string photograph_row(const PlaceLayers& place, std::size_t i, const std::string& stem) {
  const std::array<std::size_t, 6> counts = source_counts(place.filled[i]);
  std::string row = fmt::format("<tr><td>{}<td>{} x {}<td>{}<td>{}<td>{}<td>{}<td>{}",
                                escaped(place.names[i]), place.views[i].width, place.views[i].height,
                                place.visibility[i].layers.size(), place.layered[i].layers.size(),
                                std::ranges::count(place.filled[i].states, Filling::proposal),
                                std::ranges::count(place.filled[i].states, Filling::accepted),
                                std::ranges::count(place.filled[i].states, Filling::refused));
  for (std::size_t s = 1; s < 6; ++s) row += fmt::format("<td>{}", counts[s]);
  return row +
         fmt::format(
             "</tr>\n<tr><td colspan=12><img src=\"{0}-layers.png\"> <img src=\"{0}-coverage.png\"></tr>\n",
             stem);
}

/// A row per surface: how much of its area no photograph shows, and the state of the colours proposed for
/// that.
std::string surface_rows(const PlaceLayers& place, const PackedFacade& facade) {
  std::vector<double> areas(facade.surfaces.size(), 0.0), without_photograph = areas;
  for (std::size_t t = 0; t < facade.triangle_count(); ++t) {
    const glm::vec3* c = facade.corners.data() + 3 * t;
    const double area = 0.5 * double(glm::length(glm::cross(c[1] - c[0], c[2] - c[0])));
    areas[facade.surface_of_triangle[t]] += area;
    if (facade.lists[t].y == 0) without_photograph[facade.surface_of_triangle[t]] += area;
  }
  std::string rows;
  for (std::size_t s = 0; s < facade.surfaces.size(); ++s)
    rows += fmt::format("<tr><td>{}<td>{:.1f} %<td>{}</tr>\n", escaped(facade.surfaces[s]),
                        100.0 * without_photograph[s] / std::max(areas[s], 1e-12),
                        filling_names[std::size_t(place.surfaces[s])]);
  return rows;
}

}  // namespace

Image8 layer_map(const PlaceLayers& place, std::size_t photo) {
  const View& view = place.views[photo];
  const ItemBuffer seen = item_buffer(place.model, view);
  const std::vector<std::uint32_t> item_of = item_of_triangle(place.model, place.visibility[photo].items);
  Image8 map(view.width, view.height, 3, 255);
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) {
      const std::uint32_t triangle = seen.triangles[seen.index(x, y)];
      if (triangle == no_triangle_seen || item_of[triangle] == no_item) continue;
      const std::uint32_t l = place.layered[photo].layer_of_item[item_of[triangle]];
      const PixelBox& box = place.layered[photo].layers[l].box;
      const bool is_seen = place.layered[photo].masks[l].at(x - box.x, y - box.y)[1] != 0;
      const std::array<std::uint8_t, 3> colour = layer_colour(l);
      for (std::size_t c = 0; c < 3; ++c) map.at(x, y)[c] = std::uint8_t(is_seen ? colour[c] : colour[c] / 3);
    }
  return map;
}

Image8 coverage_map(const PlaceLayers& place, std::size_t photo) {
  const View& view = place.views[photo];
  Image8 minimum(view.width, view.height, 1, 0);
  for (std::size_t l = 0; l < place.layered[photo].layers.size(); ++l) {
    const PixelBox& box = place.layered[photo].layers[l].box;
    for (int y = 0; y < box.height; ++y)
      for (int x = 0; x < box.width; ++x) {
        const std::uint8_t source = *place.filled[photo].sources[l].at(x, y);
        std::uint8_t& known = *minimum.at(x + box.x, y + box.y);
        known = std::max(known, source);
      }
  }
  Image8 map(view.width, view.height, 3);
  for (std::size_t i = 0; i < minimum.pixels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      map.pixels[3 * i + c] = source_colours[std::min<std::size_t>(minimum.pixels[i], 5)][c];
  return map;
}

Status write_report(const fs::path& folder, const PlaceLayers& place, const PackedFacade& facade) {
  std::string page =
      "<!doctype html><meta charset=utf-8><title>Layers</title><style>body{font:14px sans-serif;margin:2em}"
      "img{width:45%}td,th{padding:2px 10px;text-align:left}</style>\n";
  page += fmt::format(
      "<h1>{} photographs, {} layers</h1><p>{} surfaces, {} triangles. Textures {:.2f} MB, {:.1f} % of the "
      "photographs' RGBA ({:.2f} MB).</p><p>Left: layers, dark where the photograph does not see the "
      "surface. "
      "Right: where the least certain pixel behind each one comes from:",
      place.names.size(), facade.layers.size(), facade.surfaces.size(), facade.triangle_count(),
      1e-6 * double(facade.texture_bytes()),
      100.0 * double(facade.texture_bytes()) / double(std::max<std::size_t>(facade.photograph_bytes(), 1)),
      1e-6 * double(facade.photograph_bytes()));
  for (std::size_t s = 1; s < 6; ++s)
    page += fmt::format(" <b style=\"color:rgb({},{},{})\">{}</b>", source_colours[s][0],
                        source_colours[s][1], source_colours[s][2], source_names[s]);
  page +=
      ".</p><table><tr><th>photograph<th>pixels<th>visibility layers<th>image layers<th>proposals"
      "<th>accepted<th>refused<th>seen<th>from photographs<th>patches<th>smooth<th>painted</tr>\n";
  Progress progress("report", place.names.size());
  for (std::size_t i = 0; i < place.names.size(); ++i) {
    std::string stem = fs::path(place.names[i]).replace_extension().string();
    std::ranges::replace(stem, '/', '_');
    if (Status status = write_image(folder / (stem + "-layers.png"), layer_map(place, i)); !status)
      return status;
    if (Status status = write_image(folder / (stem + "-coverage.png"), coverage_map(place, i)); !status)
      return status;
    page += photograph_row(place, i, stem);
    progress.advance();
  }
  page +=
      "</table><h2>Surfaces</h2><p>What no photograph shows has a proposed colour: of the same surface near "
      "by, "
      "or of surfaces that lie as it does.</p><table><tr><th>surface<th>area in no "
      "photograph<th>colour</tr>\n";
  page += surface_rows(place, facade) + "</table>\n";
  if (!place.warnings.empty())
    page += "<h2>Messages</h2><pre>" + escaped(to_string(place.warnings)) + "</pre>\n";
  return write_file(folder / "index.html", page);
}

}  // namespace parvis::facades
