#include "reflections/reference_maps/map_keeper.h"

#include <fmt/format.h>

#include <utility>

namespace parvis::reference_maps {

MapKeeper::MapKeeper(MapCache cache) : cache_(std::move(cache)), thread_([this] { write_all(); }) {}

MapKeeper::~MapKeeper() {
  {
    const std::scoped_lock lock(mutex_);
    ends_ = true;
  }
  changed_.notify_one();
}

void MapKeeper::keep(MapFile map) {
  if (cache_.folder().empty()) return;
  {
    const std::scoped_lock lock(mutex_);
    if (has_failed_) return;
    maps_.push_back(std::move(map));
  }
  changed_.notify_one();
}

void MapKeeper::write_all() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [&] { return ends_ || !maps_.empty(); });
    if (maps_.empty()) return;
    MapFile map = std::move(maps_.front());
    maps_.pop_front();
    lock.unlock();
    const Status written = cache_.write(std::move(map));
    if (!written)
      fmt::print(stderr, "warning: {}; reference maps are not kept, and the next start draws them again\n",
                 written.errors().front().message);
    lock.lock();
    if (written) continue;
    has_failed_ = true;
    maps_.clear();
  }
}

}  // namespace parvis::reference_maps
