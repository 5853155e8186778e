// 3.4.1 as written, with these departures:
// - the passes run over the distinct stacks of the pixels instead of frame buffers (item_buffer.h): the same
// sets;
// - items that hide themselves and cycles that remain among faces are divided into triangles and cut, where
// the thesis
//   ends and names Newell's algorithm.
#include "capture/facades/visibility_layers.h"

#include <algorithm>
#include <map>

#include "capture/facades/item_buffer.h"
#include "capture/facades/newell_cut.h"

namespace parvis::facades {
namespace {

/// Rounds of cutting after which a cycle is given up: a round cuts every cycle at least once.
constexpr int max_cut_rounds = 100;

/// The stacks without the items of a layer.
std::vector<Stack> without(const std::vector<Stack>& stacks, const std::vector<bool>& is_out) {
  std::vector<Stack> rest;
  rest.reserve(stacks.size());
  for (const Stack& stack : stacks) {
    Stack left;
    for (const char32_t item : stack)
      if (!is_out[item]) left.push_back(item);
    if (!left.empty()) rest.push_back(std::move(left));
  }
  std::ranges::sort(rest);
  rest.erase(std::unique(rest.begin(), rest.end()), rest.end());
  return rest;
}

/// The items of a layer, by the numbers that the result gives them.
class Collector {
 public:
  explicit Collector(VisibilityLayers& into) : into_(into) {}
  void add_layer(const std::vector<std::uint32_t>& layer, const std::vector<LayerItem>& items) {
    std::vector<std::uint32_t>& added = into_.layers.emplace_back();
    for (const std::uint32_t item : layer) {
      added.push_back(std::uint32_t(into_.items.size()));
      into_.items.push_back(items[item]);
    }
  }

 private:
  VisibilityLayers& into_;
};

/// Takes layers off `stacks` until one is empty; returns what remains.
std::vector<Stack> peel(std::vector<Stack> stacks, const std::vector<LayerItem>& items,
                        Collector& collector) {
  const std::uint32_t count = std::uint32_t(items.size());
  while (!stacks.empty()) {
    const std::vector<std::uint32_t> layer = next_layer(stacks, count);
    if (layer.empty()) break;
    collector.add_layer(layer, items);
    std::vector<bool> is_out(count, false);
    for (const std::uint32_t item : layer) is_out[item] = true;
    stacks = without(stacks, is_out);
  }
  return stacks;
}

std::vector<bool> present_in(const std::vector<Stack>& stacks, std::size_t count) {
  std::vector<bool> present(count, false);
  for (const Stack& stack : stacks)
    for (const char32_t item : stack) present[item] = true;
  return present;
}

/// The faces of all triangles for which `belongs` holds, ascending.
template <class Belongs>
std::vector<LayerItem> faces_where(const LayerModel& model, Belongs belongs) {
  std::map<std::uint32_t, std::uint32_t> objects;
  for (const LayerTriangle& triangle : model.triangles)
    if (belongs(triangle)) objects.emplace(triangle.face, triangle.object);
  std::vector<LayerItem> items;
  for (const auto& [face, object] : objects) items.push_back({object, face});
  return items;
}

/// Cuts every cycle of `stacks`, whose items are faces, once. Returns the number of changes.
std::size_t cut_all_cycles(LayerModel& model, const std::vector<Stack>& stacks,
                           const std::vector<LayerItem>& items, glm::dvec3 eye) {
  const auto hides = direct_occlusion(stacks, std::uint32_t(items.size()));
  std::size_t changes = 0;
  for (const std::vector<std::uint32_t>& cycle : cycles(hides)) {
    std::vector<std::uint32_t> faces;
    std::vector<std::vector<std::uint32_t>> within(cycle.size());
    for (std::size_t i = 0; i < cycle.size(); ++i) {
      faces.push_back(std::uint32_t(items[cycle[i]].face));
      for (const std::uint32_t behind : hides[cycle[i]]) {
        const auto at = std::ranges::lower_bound(cycle, behind);
        if (at != cycle.end() && *at == behind) within[i].push_back(std::uint32_t(at - cycle.begin()));
      }
    }
    changes += cut_cycle(model, faces, within, eye);
  }
  return changes;
}

/// A cycle that cannot be cut: its items become layers in the order of the first stack that holds each.
void force_apart(const LayerModel& model, const std::vector<Stack>& stacks,
                 const std::vector<LayerItem>& items, const std::string& name, Collector& collector,
                 Errors& warnings) {
  std::vector<bool> is_done(items.size(), false);
  for (const Stack& stack : stacks)
    for (const char32_t item : stack) {
      if (is_done[item]) continue;
      is_done[item] = true;
      collector.add_layer({std::uint32_t(item)}, items);
      warnings.push_back(
          error("photograph {}: a face of object \"{}\" hides and is hidden by the same faces, and cannot be "
                "cut; it has a layer "
                "of its own",
                name, model.objects[items[item].object].name));
    }
}

/// The stacks without their dense objects, which become layers in the order in which stacks show them.
std::vector<Stack> without_dense(const LayerModel& model, std::vector<Stack> stacks,
                                 const std::vector<LayerItem>& items, Collector& collector) {
  std::vector<bool> is_out(items.size(), false);
  for (const Stack& stack : stacks)
    for (const char32_t item : stack)
      if (model.objects[items[item].object].is_dense && !is_out[item])
        is_out[item] = true, collector.add_layer({std::uint32_t(item)}, items);
  return without(stacks, is_out);
}

}  // namespace

std::vector<std::uint32_t> next_layer(const std::vector<Stack>& stacks, std::uint32_t item_count) {
  std::vector<bool> selected(item_count, false);  // at first the working set
  for (const Stack& stack : stacks)
    for (const char32_t item : stack) selected[item] = true;
  // The inverted depth test leaves the farthest selected item of each pixel in the item buffer, the stencil
  // their number.
  bool is_any_hidden = true;
  while (is_any_hidden) {
    is_any_hidden = false;
    std::vector<std::uint32_t> hidden;
    for (const Stack& stack : stacks) {
      std::size_t count = 0;
      std::uint32_t farthest = no_item;
      for (const char32_t item : stack)
        if (selected[item]) ++count, farthest = item;
      if (count > 1) hidden.push_back(farthest);
    }
    for (const std::uint32_t item : hidden) selected[item] = false, is_any_hidden = true;
  }
  // The comparison with the first pass: what the final pass shows and the first one does not show everywhere
  // is out.
  std::vector<std::uint32_t> wrong;
  for (const Stack& stack : stacks) {
    const auto shown = std::ranges::find_if(stack, [&](char32_t item) { return selected[item]; });
    if (shown != stack.end() && *shown != stack.front()) wrong.push_back(*shown);
  }
  for (const std::uint32_t item : wrong) selected[item] = false;
  std::vector<std::uint32_t> layer;
  for (std::uint32_t item = 0; item < item_count; ++item)
    if (selected[item]) layer.push_back(item);
  return layer;
}

std::vector<std::uint32_t> item_of_triangle(const LayerModel& model, const std::vector<LayerItem>& items) {
  std::vector<std::uint32_t> of_object(model.objects.size(), no_item), of_face(model.face_count, no_item);
  for (std::uint32_t i = 0; i < items.size(); ++i)
    (items[i].face < 0 ? of_object[items[i].object] : of_face[std::size_t(items[i].face)]) = i;
  std::vector<std::uint32_t> result;
  for (const LayerTriangle& triangle : model.triangles)
    result.push_back(of_object[triangle.object] != no_item ? of_object[triangle.object]
                                                           : of_face[triangle.face]);
  return result;
}

VisibilityLayers visibility_layers(LayerModel& model, const View& view, const std::string& name) {
  VisibilityLayers result;
  Collector collector(result);
  if (const int around = object_around(model, view); around >= 0)
    result.warnings.push_back(
        error("photograph {}: its camera lies inside the object \"{}\", whose back faces are not drawn; "
              "check the camera or "
              "the model",
              name, model.objects[std::size_t(around)].name));

  // Objects first.
  std::vector<LayerItem> items;
  for (std::uint32_t object = 0; object < model.objects.size(); ++object) items.push_back({object, -1});
  const auto stacks_of_items = [&] {
    return distinct_stacks(model, view, item_of_triangle(model, items), std::uint32_t(items.size())).distinct;
  };
  std::vector<Stack> rest = stacks_of_items();
  if (rest.empty())
    result.warnings.push_back(
        error("photograph {}: its camera sees nothing of the model; check the camera", name));
  rest = peel(std::move(rest), items, collector);

  // Dense objects are never split: each of those that remain gets a layer, and depth decides what hides what.
  rest = peel(without_dense(model, std::move(rest), items, collector), items, collector);

  // An empty layer: the remaining objects by their faces, cut until there is an order.
  std::vector<bool> is_split = present_in(rest, items.size());
  std::vector<bool> is_done_face(model.face_count, false);
  for (int round = 0; !rest.empty(); ++round) {
    is_done_face.resize(model.face_count, false);
    items = faces_where(model, [&](const LayerTriangle& triangle) {
      return is_split[triangle.object] && !is_done_face[triangle.face];
    });
    const std::size_t before = result.items.size();
    rest = peel(stacks_of_items(), items, collector);
    for (std::size_t i = before; i < result.items.size(); ++i)
      is_done_face[std::size_t(result.items[i].face)] = true;
    if (rest.empty()) break;
    const std::size_t cuts = round < max_cut_rounds ? cut_all_cycles(model, rest, items, view.centre) : 0;
    result.cuts += cuts;
    if (cuts) continue;
    force_apart(model, rest, items, name, collector, result.warnings);
    break;
  }
  return result;
}

std::vector<VisibilityLayers> visibility_layers(LayerModel& model, const std::vector<View>& views,
                                                const std::vector<std::string>& names) {
  std::vector<VisibilityLayers> result(views.size());
  std::vector<std::uint32_t> faces_then(views.size(), ~0u);
  // A cut for a later view changes the faces of an earlier one, whose order stays an order: it is only sorted
  // again.
  for (int pass = 0; pass < 3; ++pass)
    for (std::size_t i = 0; i < views.size(); ++i) {
      if (faces_then[i] == model.face_count) continue;
      const std::size_t cuts_before = result[i].cuts;
      result[i] = visibility_layers(model, views[i], names[i]);
      result[i].cuts += cuts_before;
      faces_then[i] = model.face_count;
    }
  return result;
}

}  // namespace parvis::facades
