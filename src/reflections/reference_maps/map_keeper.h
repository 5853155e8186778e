// Keeps maps that were drawn while a window runs, so that its next start reads them.
#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

#include "reflections/reference_maps/map_cache.h"

namespace parvis::reference_maps {

/// Writes maps on a thread of its own: no frame waits for the disk.
class MapKeeper {
 public:
  explicit MapKeeper(MapCache cache);
  MapKeeper(const MapKeeper&) = delete;
  /// Writes what is left.
  ~MapKeeper();

  /// Has a map written, soon. The first that cannot be written is reported on standard error, and no further
  /// ones are written. Where scenes keep nothing (MapCache::folder) nothing happens.
  void keep(MapFile map);

 private:
  void write_all();

  MapCache cache_;
  std::mutex mutex_;  ///< of what follows
  std::condition_variable changed_;
  std::deque<MapFile> maps_;
  bool ends_ = false, has_failed_ = false;
  std::jthread thread_;  ///< last: it uses all of the above
};

}  // namespace parvis::reference_maps
