// Rows of a panel: a name on the left, what shows or changes it on the right. Thin over Dear ImGui.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "viewer/node_rows.h"
#include "viewer/theme.h"

namespace parvis::viewer {

/// Where something was drawn, in the window: for those who point at things (tests, a tutor).
struct Place {
  ImVec2 low, high;
};
using Places = std::map<std::string, Place>;

/// Lives longer than a frame: it remembers what a person drags.
class PanelRows {
 public:
  explicit PanelRows(const Fonts& fonts) : fonts_(fonts) {}

  /// Of what was drawn since `forget_places`.
  const Places& places() const { return places_; }
  void forget_places() { places_.clear(); }

  void heading(const char* text);
  /// Small words below or between rows.
  void remark(const std::string& text, const ImVec4& colour = dim_text);

  void value(const std::string& name, const std::string& text);
  /// The chosen one's index, when a person chooses. `current` may be none of them.
  std::optional<std::size_t> choice(const std::string& name, const std::vector<std::string>& choices,
                                    const std::string& current, const std::string& help = "");
  bool flag(const std::string& name, bool& is_on, const std::string& help = "");
  /// One number or three, dragged; or written, after a double click. True when changed.
  bool drag(const std::string& name, double* numbers, int count, const DragStyle& style, double least,
            double most, const std::string& help = "");
  /// A linear colour of any strength: its hue and its strength apart. True when changed.
  bool colour(const std::string& name, std::array<double, 3>& linear, const DragStyle& style,
              const std::string& help = "");
  /// True when a person ends the text with Enter.
  bool text(const std::string& name, std::string& text, const std::string& help = "");

  /// Buttons beside each other over the whole width; the pressed one's index.
  std::optional<std::size_t> buttons(const std::vector<std::string>& names, std::size_t lit);

  /// Notes where the last thing of ImGui was drawn.
  void note_place(const std::string& name);

 private:
  /// Numbers that a person drags or writes just now. The scene learns of them a step later, or when they are
  /// written to the end: until then its own are old.
  struct Held {
    ImGuiID id = 0;
    std::array<double, 3> numbers{};
  };

  void begin(const std::string& name, const std::string& help);
  void take_up(const std::string& name, double* numbers, int count) const;
  bool hold(const std::string& name, const double* numbers, int count, bool changes);

  Places places_;
  const Fonts& fonts_;
  Held held_;
};

}  // namespace parvis::viewer
