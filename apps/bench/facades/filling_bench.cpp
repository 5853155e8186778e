#include "bench/facades/filling_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "bench/facades/hidden_texture.h"
#include "bench/scratch_folder.h"
#include "capture/facades/item_buffer.h"
#include "capture/facades/place_layers.h"

namespace parvis::bench {
namespace {
namespace fs = std::filesystem;
using facades::FillSource;
using facades::PlaceLayers;

/// Squared differences from the truth over hidden pixels.
struct HiddenError {
  double squared = 0.0, values = 0.0;
  void add(const std::uint8_t* filled, const std::uint8_t* truth) {
    for (int c = 0; c < 3; ++c) squared += std::pow(double(filled[c]) - double(truth[c]), 2), ++values;
  }
  double psnr_db() const { return 10.0 * std::log10(255.0 * 255.0 * values / std::max(squared, 1e-9)); }
};

/// The same pixels, filled by different means.
struct HiddenErrors {
  HiddenError filled;         ///< by all steps, with the other photographs
  HiddenError alone;          ///< by all steps, without them
  HiddenError plain;          ///< by plain inpainting
  HiddenError unfilled;       ///< the photograph's own: the board. Filling that does nothing
  HiddenError of_wrong_view;  ///< filled by all steps, the truth being the next photograph's
  double from_photographs = 0.0;
};

/// Calls `visit(layer, x, y)`, with the place in the layer's box, for pixels of the front that the board
/// hides from photograph `i`. (Panes that reflect are filled as well, but were never hidden.)
template <class Visit>
void for_each_hidden(const PlaceLayers& place, std::size_t i, Visit&& visit) {
  const facades::LayeredView& layered = place.layered[i];
  const facades::ItemBuffer seen = facades::item_buffer(place.model, place.views[i]);
  const auto object_at = [&](int x, int y) {
    const std::uint32_t triangle = seen.triangles[seen.index(x, y)];
    return triangle == facades::no_triangle_seen
               ? std::string()
               : place.model.objects[place.model.triangles[triangle].object].name;
  };
  for (std::size_t l = 0; l < layered.layers.size(); ++l) {
    const bool is_front = std::ranges::any_of(layered.layers[l].items, [&](std::uint32_t item) {
      return place.model.objects[place.visibility[i].items[item].object].name == hidden_surface;
    });
    const Image8& mask = layered.masks[l];
    for (int y = 0; is_front && y < mask.height; ++y)
      for (int x = 0; x < mask.width; ++x)
        if (mask.at(x, y)[0] &&
            object_at(x + layered.layers[l].box.x, y + layered.layers[l].box.y) == "board")
          visit(l, x, y);
  }
}

Status add_house(const PhotographedHouse& house, HiddenErrors& errors) {
  const Result<PlaceLayers> filled = facades::place_layers(house.photographs, house.meshes),
                            plain =
                                facades::place_layers(house.photographs, house.meshes, {true, true, false});
  if (!filled) return filled.errors();
  if (!plain) return plain.errors();
  for (std::size_t i = 0; i < house.photographs.size(); ++i) {
    const Result<PlaceLayers> alone = facades::place_layers({house.photographs[i]}, house.meshes);
    if (!alone) return alone.errors();
    const Image8 &truth = house.truths[i], &wrong = house.truths[(i + 1) % house.truths.size()];
    for_each_hidden(*filled, i, [&](std::size_t l, int x, int y) {
      const facades::PixelBox& box = filled->layered[i].layers[l].box;
      const std::uint8_t* right = truth.at(x + box.x, y + box.y);
      const std::uint8_t* found = filled->filled[i].pixels[l].at(x, y);
      errors.filled.add(found, right), errors.of_wrong_view.add(found, wrong.at(x + box.x, y + box.y));
      errors.plain.add(plain->filled[i].pixels[l].at(x, y), right);
      errors.alone.add(alone->filled[0].pixels[l].at(x, y), right);
      errors.unfilled.add(filled->originals[i][l].at(x, y), right);
      errors.from_photographs +=
          *filled->filled[i].sources[l].at(x, y) == std::uint8_t(FillSource::photographs);
    });
  }
  return Done{};
}

}  // namespace

Status measure_filling(bool is_quick, Report& report) {
  const ScratchFolder folder;
  std::error_code code;
  fs::create_directories(folder.path, code);
  if (code) return error("{}: {}", folder.path.string(), code.message());
  const Result<std::vector<PhotographedHouse>> houses = photographed_houses(is_quick ? 2 : 6, folder.path);
  if (!houses) return houses.errors();
  HiddenErrors errors;
  for (const PhotographedHouse& house : *houses)
    if (Status status = add_house(house, errors); !status) return status.errors();
  const double plain = errors.plain.psnr_db(), pixels = errors.filled.values / 3.0;
  report.note(fmt::format("{:.0f} hidden pixels of {} photographs, {:.1f} % of them filled from others",
                          pixels, 5 * houses->size(),
                          100.0 * errors.from_photographs / std::max(pixels, 1.0)));
  constexpr double wanted_gain_db = 3.0;  // over plain inpainting
  const Target wanted{plain + wanted_gain_db, true};
  report.add("fill_psnr_hidden_db", errors.filled.psnr_db(), wanted);
  report.add("fill_psnr_hidden_db_one_photograph", errors.alone.psnr_db());
  report.add("fill_psnr_hidden_db_plain_inpainting", plain);
  report.add_control("fill_psnr_hidden_db_control_unfilled", errors.unfilled.psnr_db(), wanted);
  report.add_control("fill_psnr_hidden_db_control_wrong_truth", errors.of_wrong_view.psnr_db(), wanted);
  return Done{};
}

}  // namespace parvis::bench
