#include "places/car_bodies/material_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <span>

#include "scene/data/name_pattern.h"

namespace parvis::car_bodies {
namespace {

const char* preset_of(Finish finish) {
  switch (finish) {
    case Finish::paint:
      return "paint";
    case Finish::glass:
      return "glass";
    case Finish::lamp:
      return "lamp";
    case Finish::chrome:
      return "chrome";
    case Finish::rubber:
      return "rubber";
    case Finish::plastic:
      return "plastic";
    case Finish::as_in_file:
      break;
  }
  return "";
}

/// A part, or what a mask has cut out of one, by the names that a target may give.
struct Piece {
  std::size_t part;
  std::string object, node, material;

  bool is_called(const std::string& target) const {  // but for its material
    return scene::matches(target, object) || scene::matches(target, node);
  }
  bool is_meant_by(const std::string& target) const {
    return is_called(target) || scene::matches(target, material);
  }
};

/// Names that together mean some pieces and no others.
struct Targets {
  std::vector<std::string> names;
  bool outlasts_changes = true;         ///< a material's name does not
  std::vector<std::string> unnameable;  ///< objects whose names others have, too
};

class LineWriter {
 public:
  LineWriter(const scene::Model& model, const std::vector<SurfaceSample>& samples)
      : model_(model), samples_(samples) {
    pieces_.reserve(model.parts.size());
    for (std::size_t i = 0; i < model.parts.size(); ++i) {
      const scene::Part& part = model.parts[i];
      pieces_.push_back({i, part.object, model.nodes[std::size_t(part.node)].name,
                         model.materials[std::size_t(part.material)].name});
    }
  }

  void write(const BodySurface& surface) {
    const bool has_masks = !surface.masks.glass.empty() || !surface.masks.lamps.empty();
    const Targets targets = targets_of(surface.parts, has_masks);
    for (const std::string& name : targets.unnameable)
      text_ += fmt::format("  // No target means {} alone: others have its names, too. It stays as it is.\n",
                           in_quotes(name));
    if (targets.outlasts_changes) {
      write_whole(surface, targets);
      write_masks(surface, targets);
    } else if (!write_masks(surface, targets)) {
      write_whole(surface, targets);
    }
  }

  const std::string& text() const { return text_; }

 private:
  /// The material's name where it means these parts alone; with masks it must mean what they leave, not what
  /// they have cut out. Else the parts' own names.
  Targets targets_of(const std::vector<std::size_t>& parts, bool has_masks) const {
    const std::set<std::size_t> wanted(parts.begin(), parts.end());
    const auto count_meant = [&](const std::string& target, bool& means_others) {
      std::size_t count = 0;
      for (const Piece& piece : pieces_) {
        if (!piece.is_meant_by(target)) continue;
        if (!wanted.contains(piece.part)) means_others = true;
        ++count;
      }
      return count;
    };
    if (wanted.size() == model_.parts.size()) return {{"*"}, true, {}};
    const std::string& material = pieces_[parts.front()].material;
    const auto called =
        std::ranges::count_if(parts, [&](std::size_t part) { return pieces_[part].is_called(material); });
    const bool is_clear = !has_masks || called == 0 || std::size_t(called) == parts.size();
    bool means_others = material.empty();
    if (is_clear && count_meant(material, means_others) == wanted.size() && !means_others)
      return {{material}, called > 0, {}};
    Targets targets;
    std::set<std::string> used;
    for (const std::size_t part : parts) {
      const auto is_used = [&](const std::string& name) { return used.contains(name); };
      const Piece& piece = pieces_[part];
      if (is_used(piece.object) || is_used(piece.node)) continue;
      bool is_named = false;
      for (const std::string& name : {piece.object, piece.node}) {
        bool others = name.empty();
        if (!others) count_meant(name, others);
        if (others) continue;
        used.insert(name), targets.names.push_back(name);
        is_named = true;
        break;
      }
      if (!is_named) targets.unnameable.push_back(piece.object);
    }
    return targets;
  }

  void write_whole(const BodySurface& surface, const Targets& targets) {
    const char* const preset = preset_of(surface.finish);
    const bool is_closed = surface.finish == Finish::glass && surface.sees_through;
    if (is_closed && !targets.names.empty())
      text_ += "  // One sees through it in the file; preset=\"clear_glass\" without alpha keeps that.\n";
    for (const std::string& name : targets.names) {
      write_node(name, preset, {}, is_closed ? ", alpha=1" : "");
      for (Piece& piece : pieces_)
        if (piece.is_meant_by(name)) piece.material = preset;
    }
  }

  /// True if nothing is left outside of the masks.
  bool write_masks(const BodySurface& surface, const Targets& targets) {
    std::size_t left = 0;
    for (const std::string& name : targets.names) {
      std::vector<const SurfaceSample*> meant = samples_meant(surface, name);
      for (const auto& [preset, masks] :
           {std::pair("glass", &surface.masks.glass), std::pair("lamp", &surface.masks.lamps)}) {
        std::vector<PictureMask> useful;
        std::ranges::copy_if(*masks, std::back_inserter(useful), [&](const PictureMask& mask) {
          return std::ranges::any_of(meant, [&](const SurfaceSample* sample) { return mask.holds(*sample); });
        });
        if (useful.empty()) continue;
        write_node(name, preset, useful, "");
        std::set<std::size_t> cut;
        std::erase_if(meant, [&](const SurfaceSample* sample) {
          const bool is_in =
              std::ranges::any_of(useful, [&](const PictureMask& mask) { return mask.holds(*sample); });
          if (is_in) cut.insert(sample->part);
          return is_in;
        });
        for (const std::size_t part : cut)
          pieces_.push_back({part, pieces_[part].object, pieces_[part].node, preset});
      }
      left += meant.size();
    }
    return left == 0;
  }

  std::vector<const SurfaceSample*> samples_meant(const BodySurface& surface, const std::string& name) const {
    std::vector<const SurfaceSample*> meant;
    for (const SurfaceSample& sample : samples_)
      if (std::ranges::binary_search(surface.parts, sample.part) && pieces_[sample.part].is_meant_by(name))
        meant.push_back(&sample);
    return meant;
  }

  void write_node(const std::string& target, const char* preset, std::span<const PictureMask> masks,
                  const char* more) {
    const std::string named = target == "*" ? "" : fmt::format("target={}, ", in_quotes(target));
    text_ += fmt::format("  material({}preset=\"{}\"{}", named, preset, more);
    for (const PictureMask& mask : masks) text_ += fmt::format(",\n      mask=\"{}\"", mask.text());
    text_ += ")\n";
  }

  const scene::Model& model_;
  const std::vector<SurfaceSample>& samples_;
  std::vector<Piece> pieces_;  ///< the parts first, in order
  std::string text_;
};

/// The materials, or where these have no names the objects, that no node changes.
std::string untouched(const scene::Model& model, const std::vector<BodySurface>& surfaces) {
  constexpr std::size_t enough = 10;
  std::set<std::string> names;
  for (const BodySurface& surface : surfaces) {
    if (surface.finish != Finish::as_in_file) continue;
    const std::string& material = model.materials[std::size_t(surface.material)].name;
    const bool is_shared = std::ranges::count(surfaces, surface.material, &BodySurface::material) > 1;
    if (!material.empty() && !is_shared) {
      names.insert(in_quotes(material));
    } else {
      for (const std::size_t part : surface.parts) names.insert(in_quotes(model.parts[part].object));
    }
  }
  if (names.empty()) return "";
  const bool has_more = names.size() > enough;
  while (names.size() > enough) names.erase(std::prev(names.end()));
  return fmt::format("  // As the file has them: {}{}.\n", fmt::join(names, ", "), has_more ? ", ..." : "");
}

}  // namespace

std::string material_lines(const scene::Model& model, const std::vector<BodySurface>& surfaces,
                           const std::vector<SurfaceSample>& samples) {
  LineWriter writer(model, samples);
  bool has_glass = false;
  for (const BodySurface& surface : surfaces) {
    has_glass = has_glass || surface.finish == Finish::glass || !surface.masks.glass.empty();
    if (surface.finish != Finish::paint && surface.finish != Finish::as_in_file) writer.write(surface);
  }
  for (const BodySurface& surface : surfaces)
    if (surface.finish == Finish::paint) writer.write(surface);
  std::string text = writer.text() + untouched(model, surfaces);
  if (!has_glass) text += "  // No panes were found: material(preset=\"glass\", target=... or mask=...).\n";
  return text;
}

std::string in_quotes(const std::string& text) {
  std::string quoted = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') quoted += '\\';
    if (letter == '\n') {
      quoted += "\\n";
    } else {
      quoted += letter == '\r' ? ' ' : letter;
    }
  }
  return quoted + '"';
}

}  // namespace parvis::car_bodies
