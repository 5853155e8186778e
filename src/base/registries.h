// What all rooms bring to a program: node types, processes, drawables, reflection methods, readers, bake
// steps, benches. Each kind of contribution is a registry, a class of the lowest room that knows the kind; a
// room adds to them in its one function `void register_room(Registries&)`, and rooms/rooms.cpp lists those
// functions.
#pragma once

#include <memory>
#include <typeindex>
#include <unordered_map>

namespace parvis {

/// Registries by their type. Owns them; they stay where they are in memory.
class Registries {
 public:
  /// The registry of this type, empty when first asked for. Registry must be default-constructible.
  template <class Registry>
  Registry& get() {
    std::shared_ptr<void>& held = registries_[typeid(Registry)];
    if (!held) held = std::make_shared<Registry>();
    return *static_cast<Registry*>(held.get());
  }

  /// The same to read: an empty one where no room has added anything.
  template <class Registry>
  const Registry& get() const {
    static const Registry empty;
    const auto held = registries_.find(typeid(Registry));
    return held == registries_.end() ? empty : *static_cast<const Registry*>(held->second.get());
  }

 private:
  std::unordered_map<std::type_index, std::shared_ptr<void>> registries_;
};

}  // namespace parvis
