#include "formats/readers/plain_account.h"

#include <algorithm>
#include <set>

#include "formats/readers/local_origin.h"

namespace parvis::formats {

void count_what_is_shown(const scene::Model& model, scene::FileAccount& account) {
  std::set<std::string_view> objects;
  for (const scene::Part& part : model.parts) objects.insert(part.object);
  account.used("objects", objects.size());
  account.used("triangles", model.triangle_count());
  const std::size_t counted =  // by the reader, which knows those that a checker stands for
      account.count(scene::Fate::used, "images") + account.count(scene::Fate::left_out, "images");
  account.used("images", model.textures.size() - std::min(counted, model.textures.size()));
  account.used("animations", model.animations.size());
  account.used("roads", model.roads.size());
  note_origin(model.origin, model.map, account);
}

Result<FileContent> with_plain_account(std::string format, Result<scene::Model> model) {
  if (!model) return model.errors();
  scene::FileAccount account(std::move(format));
  count_what_is_shown(*model, account);
  return FileContent{*std::move(model), std::move(account)};
}

}  // namespace parvis::formats
