// What rooms keep in a scene: one plain value per type, found by the type. A room that needs something in a
// scene declares a struct of its own and touches no other file.
#pragma once

#include <cassert>
#include <concepts>
#include <map>
#include <memory>
#include <string_view>

#include "base/content_hash.h"

namespace parvis::scene {

/// Which pictures of a scene depend on a room's data, beside its objects.
enum class DataRole : std::uint8_t {
  static_content,   ///< all: it is drawn and does not move
  dynamic_content,  ///< those that show what moves
  settings          ///< none: how something is computed, or what objects of the scene show already
};

/// A type that a scene can keep: copyable, with a default that stands for "nobody has set it", a `name` that
/// no other such type has (`room.thing`), a `role`, and `hash`, which adds all of its content.
template <class T>
concept SceneData = std::copyable<T> && std::default_initializable<T> &&
    requires(const T& value, ContentHash& hash) {
  { T::name } -> std::convertible_to<std::string_view>;
  { T::role } -> std::convertible_to<DataRole>;
  value.hash(hash);
};

/// A room's value without its type.
struct RoomData {
  virtual ~RoomData() = default;
  virtual std::unique_ptr<RoomData> clone() const = 0;
  virtual void hash(ContentHash& hash) const = 0;
  /// Equal content to a value that nobody has set.
  virtual bool is_default() const = 0;
  virtual DataRole role() const = 0;
};

template <SceneData T>
struct RoomDataOf final : RoomData {
  T value{};

  std::unique_ptr<RoomData> clone() const override { return std::make_unique<RoomDataOf>(*this); }
  void hash(ContentHash& hash) const override { value.hash(hash); }
  bool is_default() const override {
    ContentHash mine, unset;
    value.hash(mine), T{}.hash(unset);
    return mine.value() == unset.value();
  }
  DataRole role() const override { return T::role; }
};

/// The values of all rooms; copies are deep. References stay valid until the set is assigned to or destroyed.
class RoomDataSet {
 public:
  RoomDataSet() = default;
  RoomDataSet(RoomDataSet&&) = default;
  RoomDataSet& operator=(RoomDataSet&&) = default;
  RoomDataSet(const RoomDataSet& other) {
    for (const auto& [name, value] : other.values_) values_.emplace(name, value->clone());
  }
  RoomDataSet& operator=(const RoomDataSet& other) { return *this = RoomDataSet(other); }
  ~RoomDataSet() = default;

  /// The value, to be changed.
  template <SceneData T>
  T& get() {
    std::unique_ptr<RoomData>& value = values_[T::name];
    if (!value) value = std::make_unique<RoomDataOf<T>>();
    assert(dynamic_cast<RoomDataOf<T>*>(value.get()) && "two types of room data have the same name");
    return static_cast<RoomDataOf<T>&>(*value).value;
  }
  /// The value, or the type's default where nobody has set it.
  template <SceneData T>
  const T& get() const {
    static const T unset{};
    const auto found = values_.find(T::name);
    if (found == values_.end()) return unset;
    assert(dynamic_cast<const RoomDataOf<T>*>(found->second.get()) &&
           "two types of room data have the same name");
    return static_cast<const RoomDataOf<T>&>(*found->second).value;
  }

  /// Adds the content of every value with one of the roles that `counts` accepts. Values that equal their
  /// default do not count, so that reading one changes nothing; the order in which they were set does not
  /// count either.
  template <class Counts>
  void hash(ContentHash& hash, Counts&& counts) const {
    for (const auto& [name, value] : values_) {
      if (!counts(value->role()) || value->is_default()) continue;
      hash.add_text(name);
      value->hash(hash);
    }
  }

 private:
  std::map<std::string_view, std::unique_ptr<RoomData>> values_;
};

}  // namespace parvis::scene
