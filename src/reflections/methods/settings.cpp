#include "reflections/methods/settings.h"

namespace parvis::methods {

void Settings::hash(ContentHash& hash) const {
  hash.add_text(method);
  for (const int value : {resolution, int(uses_level_of_detail), bounces}) hash.add(value);
  hash.add(budget_ms);
  own.hash(hash, [](scene::DataRole) { return true; });
}

bool operator==(const Settings& a, const Settings& b) {
  ContentHash hash_a, hash_b;
  a.hash(hash_a), b.hash(hash_b);
  return hash_a.value() == hash_b.value();
}

}  // namespace parvis::methods
