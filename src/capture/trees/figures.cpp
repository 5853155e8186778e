#include "capture/trees/figures.h"

#include <algorithm>
#include <cmath>

#include "base/files.h"
#include "base/image_io.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "capture/trees/judge.h"

namespace parvis::trees {
namespace {

constexpr int iterations = 8, thesis_iterations = 4, grid_levels = 5;
constexpr float thesis_cutoff = 0.94f, pine_cutoff = 0.9f;
constexpr float edge_share = 0.09f;  // of a cell's face that is drawn as its edge
constexpr int gap_px = 4, slice_px = 220;
constexpr int chart_width = 640, chart_height = 360, chart_margin = 56;

/// Shade of a point of a cell's face: by the face, darker at its edges.
float face_shade(glm::vec3 in_cell) {
  const glm::vec3 from_middle = glm::abs(in_cell - 0.5f);
  int axis = 0;
  for (int a = 1; a < 3; ++a)
    if (from_middle[a] > from_middle[axis]) axis = a;
  float to_edge = 0.5f;
  for (int a = 0; a < 3; ++a)
    if (a != axis) to_edge = std::min(to_edge, 0.5f - from_middle[a]);
  const float shade = axis == 2 ? 0.9f : axis == 0 ? 0.6f : 0.42f;
  return to_edge < edge_share ? 0.35f * shade : shade;
}

TreeVolume thesis_volume(const CellGrid& grid, const FigureInput& input, std::span<const Silhouette> masks,
                         float cutoff) {
  OpacityOptions options;
  options.method = OpacityMethod::projection, options.iterations = thesis_iterations, options.cutoff = cutoff;
  return without_transparent_cells(
      coloured(grid, estimate_opacity(grid, input.views, masks, options).extinction_per_m, input.views),
      cutoff);
}

BillboardTree thesis_tree(const TreeVolume& volume, std::span<const TreeView> views) {
  TextureOptions options;
  options.method = TextureMethod::age_importance, options.parent_levels = 0;
  return textured(volume, views, options);
}

Image8 seen(const BillboardTree& tree, const TreeView& from) {
  return over_white(render_billboards(tree, from.camera));
}

/// Writes one figure after the other.
class FigureWriter {
 public:
  FigureWriter(const std::filesystem::path& folder, const FigureInput& input)
      : folder_(folder), input_(input), masks_(silhouettes(input.views)) {}

  Status write_all() {
    std::error_code code;
    std::filesystem::create_directories(folder_, code);
    if (code) return error("{}: the folder cannot be made: {}", folder_.string(), code.message());
    const Result<Bounds> box = hull_box(input_.views, masks_);
    if (!box) return box.errors();
    Progress progress("figures", 5);
    for (const auto& step : {&FigureWriter::grid, &FigureWriter::convergence, &FigureWriter::slices,
                             &FigureWriter::cutoffs, &FigureWriter::new_views}) {
      if (Status status = (this->*step)(*box); !status) return status;
      progress.advance();
    }
    return Ok{};
  }
  std::vector<std::string> lines() const { return lines_; }

 private:
  Status keep(const char* name, const Image8& picture, const std::string& what) {
    lines_.push_back(fmt::format("{}: {}", (folder_ / name).string(), what));
    return write_image(folder_ / name, picture);
  }
  Result<CellGrid> grid_of(const Bounds& box, int level) const {
    GridOptions options;
    options.level = level;
    return hull_grid(input_.views, masks_, box, options);
  }

  Status grid(const Bounds& box) {
    std::vector<Image8> row;
    std::string counts;
    for (int level = 0; level < grid_levels; ++level) {
      const Result<CellGrid> cells = grid_of(box, level);
      if (!cells) return cells.errors();
      row.push_back(over_white(render_cells(*cells, input_.views.front().camera)));
      counts += fmt::format("{}{}", level > 0 ? ", " : "", cells->size());
    }
    return keep("figure-4.5.png", contact_sheet({row}),
                "the first five levels of the grid: " + counts + " cells");
  }

  Status convergence(const Bounds& box) {
    Result<CellGrid> cells = grid_of(box, input_.level);
    if (!cells) return cells.errors();
    cells_ = *std::move(cells);
    std::vector<Curve> curves;
    for (const auto& [method, name] :
         {std::pair{OpacityMethod::projection, "projection (the thesis), clamped"},
          std::pair{OpacityMethod::sirt, "sirt"},
          std::pair{OpacityMethod::multiplicative, "multiplicative"}}) {
      OpacityOptions options;
      options.method = method, options.iterations = iterations;
      Opacities found = estimate_opacity(cells_, input_.views, masks_, options);
      curves.push_back({name, found.mean_change});
      estimates_.push_back(std::move(found.extinction_per_m));
    }
    lines_.push_back(fmt::format("{}: mean change of the transparencies, iterations 1 to {}",
                                 (folder_ / "figure-4.8.svg").string(), iterations));
    return write_file(folder_ / "figure-4.8.svg", convergence_chart(curves));
  }

  Status slices(const Bounds&) {
    const std::vector<float> start = initial_extinction(cells_, masks_);
    std::vector<std::vector<Image8>> rows(3);
    for (const float height : {0.3f, 0.5f, 0.7f, 0.85f}) {
      rows[0].push_back(opacity_slice(cells_, start, height));
      rows[1].push_back(opacity_slice(cells_, estimates_.front(), height));
      rows[2].push_back(opacity_slice(cells_, estimates_.back(), height));
    }
    return keep("figure-4.9.png", contact_sheet(rows),
                "slices of opacity at .3, .5, .7 and .85 of the height: at the start, after 8 iterations of "
                "the thesis's projection, of the default");
  }

  Status cutoffs(const Bounds&) {
    std::vector<Image8> row{over_white(input_.held_out.front().picture)};
    std::string counts;
    for (const float cutoff : {1.0f, thesis_cutoff, pine_cutoff}) {
      const TreeVolume volume = thesis_volume(cells_, input_, masks_, cutoff);
      const BillboardTree tree = thesis_tree(volume, input_.views);
      row.push_back(seen(tree, input_.held_out.front()));
      counts += fmt::format("{}{:.2f}: {} cells", counts.empty() ? "" : ", ", cutoff, volume.grid.size());
      if (cutoff == thesis_cutoff) thesis_ = tree, thesis_volume_ = volume;
    }
    return keep("figure-4.15.png", contact_sheet({row}),
                "the truth, and the thesis's method by cutoff, " + counts);
  }

  Status new_views(const Bounds&) {
    ReconstructionOptions options;
    options.grid.level = input_.level;
    const Result<Reconstruction> made = reconstruct(input_.views, options);
    if (!made) return made.errors();
    TextureOptions naive;
    naive.method = TextureMethod::naive, naive.parent_levels = 0;
    const BillboardTree tree = textured(made->volume, input_.views, {}),
                        repeated = textured(thesis_volume_, input_.views, naive);
    const TreeView& first = input_.held_out.front();
    if (Status status = keep("figure-4.10.png",
                             contact_sheet({{over_white(first.picture), seen(tree, first),
                                             seen(thesis_, first), seen(repeated, first)}}),
                             "a view that was left out: truth, default, age and importance, naive");
        !status)
      return status;
    std::vector<std::vector<Image8>> rows(2);
    for (std::size_t i = 0; i < std::min(input_.held_out.size(), std::size_t(4)); ++i) {
      rows[0].push_back(over_white(input_.held_out[i].picture));
      rows[1].push_back(seen(tree, input_.held_out[i]));
    }
    return keep("figure-4.12.png", contact_sheet(rows),
                "views that were left out: truth above, the tree below");
  }

  std::filesystem::path folder_;
  const FigureInput& input_;
  std::vector<Silhouette> masks_;
  CellGrid cells_;
  std::vector<std::vector<float>> estimates_;  // extinctions by method
  BillboardTree thesis_;
  TreeVolume thesis_volume_;
  std::vector<std::string> lines_;
};

}  // namespace

ImageF render_cells(const CellGrid& grid, const Pinhole& camera) {
  ImageF picture(camera.width, camera.height, 4);
  parallel_for(std::size_t(camera.height), [&](std::size_t row) {
    for (int x = 0; x < camera.width; ++x) {
      const ViewRay ray = camera.ray({float(x) + 0.5f, float(row) + 0.5f});
      grid.walk(ray, [&](std::size_t cell, float enter, float) {
        const Bounds box = grid.bounds(cell);
        const float shade = face_shade((ray.origin + enter * ray.direction - box.min) / box.size());
        float* p = picture.at(x, int(row));
        p[0] = 0.55f * shade, p[1] = 0.75f * shade, p[2] = 0.45f * shade, p[3] = 1.0f;
        return false;
      });
    }
  });
  return picture;
}

Image8 opacity_slice(const CellGrid& grid, std::span<const float> extinction_per_m, float height) {
  const int layer = std::clamp(int(height * float(grid.side())), 0, grid.side() - 1);
  const float chord_m = mean_chord_m(grid.cell_size_m());
  Image8 picture(slice_px, slice_px, 3, 255);
  for (int y = 0; y < slice_px; ++y)
    for (int x = 0; x < slice_px; ++x) {
      const int cell =
          grid.cell_at({x * grid.side() / slice_px, (slice_px - 1 - y) * grid.side() / slice_px, layer});
      if (cell == no_cell) continue;
      const float kept = std::exp(-extinction_per_m[std::size_t(cell)] * chord_m);
      std::fill_n(picture.at(x, y), 3, std::uint8_t(std::lround(255.0f * kept)));
    }
  return picture;
}

Image8 contact_sheet(const std::vector<std::vector<Image8>>& rows) {
  int width = 0, height = 0;
  const auto extent = [](const std::vector<Image8>& row) {
    glm::ivec2 size(-gap_px, 0);
    for (const Image8& picture : row)
      size = {size.x + gap_px + picture.width, std::max(size.y, picture.height)};
    return size;
  };
  for (const auto& row : rows)
    width = std::max(width, extent(row).x), height += extent(row).y + (height > 0 ? gap_px : 0);
  Image8 sheet(std::max(width, 1), std::max(height, 1), 3, 255);
  int top = 0;
  for (const auto& row : rows) {
    int left = 0;
    for (const Image8& picture : row) {
      for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) std::copy_n(picture.at(x, y), 3, sheet.at(left + x, top + y));
      left += picture.width + gap_px;
    }
    top += extent(row).y + gap_px;
  }
  return sheet;
}

std::string convergence_chart(std::span<const Curve> curves) {
  constexpr double lowest = 1e-4, highest = 1.0;
  constexpr const char* colours[]{"#b03030", "#3060b0", "#308030", "#806020"};
  std::size_t count = 2;
  for (const Curve& curve : curves) count = std::max(count, curve.values.size());
  const auto across = [&](std::size_t i) {
    return chart_margin + double(chart_width - 2 * chart_margin) * double(i) / double(count - 1);
  };
  const auto up = [&](double value) {
    const double share = std::log(std::clamp(value, lowest, highest) / lowest) / std::log(highest / lowest);
    return chart_height - chart_margin - double(chart_height - 2 * chart_margin) * share;
  };
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{}\" font-family=\"sans-serif\" "
      "font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      chart_width, chart_height);
  for (double value = lowest; value <= 1.001 * highest; value *= 10.0)
    svg += fmt::format(
        "<line x1=\"{0}\" x2=\"{1}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\" stroke=\"#ccc\"/><text x=\"{3}\" "
        "y=\"{4:.1f}\" text-anchor=\"end\">{5:g}</text>\n",
        chart_margin, chart_width - chart_margin, up(value), chart_margin - 6, up(value) + 4.0, value);
  for (std::size_t i = 0; i < count; ++i)
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", across(i),
                       chart_height - chart_margin + 18, i + 1);
  svg += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">iteration</text>\n", chart_width / 2,
                     chart_height - 14);
  for (std::size_t c = 0; c < curves.size(); ++c) {
    std::string points;
    for (std::size_t i = 0; i < curves[c].values.size(); ++i)
      points += fmt::format("{:.1f},{:.1f} ", across(i), up(curves[c].values[i]));
    svg += fmt::format(
        "<polyline points=\"{0}\" fill=\"none\" stroke=\"{1}\" stroke-width=\"2\"/><text x=\"{2}\" y=\"{3}\" "
        "fill=\"{1}\" text-anchor=\"end\">{4}</text>\n",
        points, colours[c % 4], chart_width - chart_margin, 20 + 16 * int(c), curves[c].name);
  }
  return svg + "</svg>\n";
}

Result<std::vector<std::string>> write_figures(const std::filesystem::path& folder,
                                               const FigureInput& input) {
  if (input.held_out.empty()) return error("figures need a view that was left out");
  FigureWriter writer(folder, input);
  if (Status status = writer.write_all(); !status) return status.errors();
  return writer.lines();
}

}  // namespace parvis::trees
