#include "formats/drawings/drawing_account.h"

#include <algorithm>

namespace parvis::formats {

scene::FileAccount account_of(const Drawing& drawing, const std::string& file) {
  scene::FileAccount account("DXF " + drawing.version);
  account.set_file(file);
  std::map<std::string, int> held;
  for (const auto& [layer, types] : drawing.entity_counts)
    for (const auto& [type, count] : types) held[type] += count;
  for (const auto& [type, count] : held) {
    const auto lost = drawing.left_out.find(type);
    const int left_out = lost == drawing.left_out.end() ? 0 : std::min(lost->second, count);
    if (type == "SPLINE")
      account.changed(type, "drawn as chords, eight for each control point", "",
                      std::size_t(count - left_out));
    else
      account.used(type, std::size_t(count - left_out));
    account.left_out(type, "entities of this type are not read, or these are damaged", "",
                     std::size_t(left_out));
  }
  account.left_out("lines, texts or points", "lie more than a million kilometres away", "",
                   std::size_t(drawing.far_away));
  account.left_out("entities in layouts", "paper space is not read", "", std::size_t(drawing.paper_entities));
  for (const DrawingLayer& layer : drawing.layers)
    if (layer.is_shown())
      account.used("layers");
    else
      account.unneeded("layers", "off or frozen; layers= shows them", layer.name);
  return account;
}

}  // namespace parvis::formats
