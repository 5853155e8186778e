// Data that rooms keep in a scene: one plain value per type, looked up by the type. A room that needs data in
// a scene declares a struct of its own and changes no other file.
#pragma once

#include <algorithm>
#include <cassert>
#include <concepts>
#include <map>
#include <memory>
#include <numeric>
#include <span>
#include <string_view>
#include <vector>

#include "base/content_hash.h"

namespace parvis::scene {

/// Which rendered images of a scene depend on a room's data, beside its objects.
enum class DataRole : std::uint8_t {
  static_content,   ///< all images: the data is rendered and static
  dynamic_content,  ///< images that show dynamic objects
  settings          ///< none: parameters of an algorithm, or data whose result is among the objects
};

/// A type that a scene can keep: copyable, with a default that means "not set", a unique `name`
/// (`room.thing`), a `role`, and `hash`, which adds all of its content.
template <class T>
concept SceneData = std::copyable<T> && std::default_initializable<T> &&
    requires(const T& value, ContentHash& hash) {
  { T::name } -> std::convertible_to<std::string_view>;
  { T::role } -> std::convertible_to<DataRole>;
  value.hash(hash);
};

/// The nodes numbered from `first` to `last`: those of a node and of all nodes inside it
/// (`NodeFrame::number`).
struct NodeRange {
  int first = 0, last = -1;
};

/// Type-erased value of a room.
struct RoomData {
  virtual ~RoomData() = default;
  virtual std::unique_ptr<RoomData> clone() const = 0;  ///< a deep copy
  virtual void hash(ContentHash& hash) const = 0;       ///< adds all content
  /// True if the content equals the type's default.
  virtual bool is_default() const = 0;
  virtual DataRole role() const = 0;  ///< T::role of the value
  /// Moves the items that these nodes have made into a value of their own. Null: there were none, or the
  /// value has no items.
  virtual std::unique_ptr<RoomData> take_made_by(const NodeRange& nodes) = 0;
  /// Puts back what `take_made_by` has removed from a value of the same type.
  virtual void put_back(RoomData& taken) = 0;
  /// Nodes have other numbers now: the node of number n has `numbers[n]`. Items follow the order of their
  /// nodes.
  virtual void renumber(std::span<const int> numbers) = 0;
};

/// A type of which nodes make any number of items in a scene: as SceneData, with a hash of one item.
template <class T>
concept SceneItem = SceneData<T>;

/// The items of one type, in the order of the nodes that made them.
template <SceneItem T>
struct ItemsOf {
  static constexpr std::string_view name = T::name;
  static constexpr DataRole role = T::role;
  std::vector<T> items;
  std::vector<int> makers;  ///< of each item: the number of its node; ascending

  /// Adds the items' content, but not who made them.
  void hash(ContentHash& hash) const {
    for (const T& item : items) item.hash(hash);
  }

  /// Inserts after the items of the same node and of the nodes before it.
  void add(T item, int maker) {
    const auto place = std::upper_bound(makers.begin(), makers.end(), maker) - makers.begin();
    items.insert(items.begin() + place, std::move(item));
    makers.insert(makers.begin() + place, maker);
  }

  /// Removes and returns the items that these nodes have made.
  ItemsOf take(const NodeRange& nodes) {
    const auto first = std::lower_bound(makers.begin(), makers.end(), nodes.first) - makers.begin();
    const auto last = std::upper_bound(makers.begin(), makers.end(), nodes.last) - makers.begin();
    ItemsOf taken;
    std::move(items.begin() + first, items.begin() + last, std::back_inserter(taken.items));
    taken.makers.assign(makers.begin() + first, makers.begin() + last);
    items.erase(items.begin() + first, items.begin() + last);
    makers.erase(makers.begin() + first, makers.begin() + last);
    return taken;
  }

  /// See RoomData::renumber. Makers below 0, and those that `numbers` does not know, keep their number.
  void renumber(std::span<const int> numbers) {
    for (int& maker : makers)
      if (maker >= 0 && std::size_t(maker) < numbers.size()) maker = numbers[std::size_t(maker)];
    if (std::ranges::is_sorted(makers)) return;
    std::vector<std::size_t> order(makers.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return makers[i]; });
    ItemsOf sorted;
    sorted.items.reserve(order.size()), sorted.makers.reserve(order.size());
    for (const std::size_t i : order)
      sorted.items.push_back(std::move(items[i])), sorted.makers.push_back(makers[i]);
    *this = std::move(sorted);
  }
};

/// True for ItemsOf.
template <class T>
inline constexpr bool is_items = false;
template <class T>
inline constexpr bool is_items<ItemsOf<T>> = true;

/// The value of type T behind the type-erased interface.
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
  std::unique_ptr<RoomData> take_made_by([[maybe_unused]] const NodeRange& nodes) override {
    if constexpr (is_items<T>) {
      auto taken = std::make_unique<RoomDataOf>();
      taken->value = value.take(nodes);
      if (!taken->value.items.empty()) return taken;
    }
    return nullptr;
  }
  void put_back([[maybe_unused]] RoomData& taken) override {
    if constexpr (is_items<T>) {
      T& others = static_cast<RoomDataOf&>(taken).value;
      for (std::size_t i = 0; i < others.items.size(); ++i)
        value.add(std::move(others.items[i]), others.makers[i]);
    }
  }
  void renumber([[maybe_unused]] std::span<const int> numbers) override {
    if constexpr (requires { value.renumber(numbers); }) value.renumber(numbers);
  }
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

  /// Moves the items that these nodes made into a set of their own: they are about to be rebuilt.
  RoomDataSet take_made_by(const NodeRange& nodes) {
    RoomDataSet taken;
    for (auto& [name, value] : values_)
      if (std::unique_ptr<RoomData> items = value->take_made_by(nodes))
        taken.values_.emplace(name, std::move(items));
    return taken;
  }
  /// Puts them back: they could not be rebuilt.
  void put_back(RoomDataSet taken) {
    for (auto& [name, items] : taken.values_) values_.at(name)->put_back(*items);
  }
  /// Nodes have other numbers now; see RoomData::renumber.
  void renumber(std::span<const int> numbers) {
    for (auto& [name, value] : values_) value->renumber(numbers);
  }

 private:
  std::map<std::string_view, std::unique_ptr<RoomData>> values_;
};

}  // namespace parvis::scene
