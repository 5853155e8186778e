#include "base/registries.h"
#include "formats/ifc/ifc_reader.h"
#include "formats/readers/content.h"
#include "formats/readers/isolated_reader.h"
#include "formats/readers/plain_account.h"
#include "room_list.h"

namespace parvis::ifc {
namespace {

Result<formats::FileContent> read(const std::filesystem::path& file, const formats::ModelReading& reading,
                                  Errors& warnings) {
  scene::FileAccount account("IFC");
  Result<scene::Model> model = scene::read_ifc(file, warnings, reading.place_deg, reading.map, &account);
  if (!model) return model.errors();
  formats::count_what_is_shown(*model, account);
  return formats::FileContent{*std::move(model), std::move(account)};
}

/// ISO 10303-21, the text form of STEP.
bool looks_like_step(std::string_view front) {
  return formats::without_blanks(front).starts_with("ISO-10303-21");
}

}  // namespace

/// Adds the reader of .ifc.
void register_room(Registries& registries) {
  registries.get<formats::Readers>().add({".ifc"}, formats::isolated<read>(), looks_like_step,
                                         formats::TakesPacked::yes);
}

}  // namespace parvis::ifc
