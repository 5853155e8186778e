#include "base/registries.h"
#include "formats/readers/isolated_reader.h"
#include "formats/readers/plain_account.h"
#include "formats/terrain/terrain.h"
#include "room_list.h"

namespace parvis::terrain {
namespace {

Result<formats::FileContent> read_grid(const std::filesystem::path& file,
                                       const formats::ModelReading& reading, Errors& warnings) {
  scene::FileAccount account("GeoTIFF");
  Result<scene::Model> model =
      scene::read_terrain(file, reading.cell_m, warnings, reading.place_deg, reading.map, &account);
  if (!model) return model.errors();
  formats::count_what_is_shown(*model, account);
  return formats::FileContent{*std::move(model), std::move(account)};
}

/// TIFF and BigTIFF, of either byte order.
bool is_tiff(std::string_view front) {
  using namespace std::string_view_literals;
  return front.starts_with("II*\0"sv) || front.starts_with("MM\0*"sv) || front.starts_with("II+\0"sv) ||
         front.starts_with("MM\0+"sv);
}

}  // namespace

/// Adds the reader of height grids in TIFF.
void register_room(Registries& registries) {
  formats::Readers& readers = registries.get<formats::Readers>();
  readers.add({".tif", ".tiff"}, formats::isolated<read_grid>(), is_tiff);
}

}  // namespace parvis::terrain
