#include "base/registries.h"
#include "formats/inventor/inventor_reader.h"
#include "formats/readers/isolated_reader.h"
#include "room_list.h"

namespace parvis::inventor {
namespace {

bool looks_like_inventor(std::string_view front) {
  return front.starts_with("#Inventor V") || front.starts_with("#VRML V");
}

}  // namespace

/// Adds the reader of .iv and .wrl.
void register_room(Registries& registries) {
  registries.get<formats::Readers>().add({".iv", ".wrl"}, formats::isolated<read_inventor>(),
                                         looks_like_inventor);
}

}  // namespace parvis::inventor
