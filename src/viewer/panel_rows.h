// Rows of a panel: label on the left, value or widget on the right. A thin layer over Dear ImGui.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planning/design/words.h"
#include "viewer/node_rows.h"
#include "viewer/theme.h"

namespace parvis::viewer {

/// Rectangle in the window where a widget was drawn; for tests and tutorials that point at it.
struct Place {
  ImVec2 low, high;
};
/// Widgets by name.
using Places = std::map<std::string, Place>;

/// Draws rows. Lives longer than a frame: it keeps the number that is being dragged.
class PanelRows {
 public:
  /// `fonts` must outlive the rows. Names, headings, remarks and help are given in English and shown in
  /// `language`; places keep the English names.
  explicit PanelRows(const Fonts& fonts, design::Language language = design::Language::english)
      : fonts_(fonts), language_(language) {}

  /// An English word or sentence in the language of the panel.
  std::string word(std::string_view english) const { return design::in_language(english, language_); }

  /// Rectangles of the widgets drawn since `forget_places`.
  const Places& places() const { return places_; }
  /// Call at the start of a frame.
  void forget_places() { places_.clear(); }

  /// A section heading.
  void heading(const char* text);
  /// Small text below or between rows.
  void remark(const std::string& text, const ImVec4& colour = dim_text);

  /// A read-only value; a tooltip shows it in full if it is cut off.
  void value(const std::string& name, const std::string& text);
  /// A drop-down list. Returns the index when the user chooses; `current` need not be among the choices.
  std::optional<std::size_t> choice(const std::string& name, const std::vector<std::string>& choices,
                                    const std::string& current, const std::string& help = "");
  /// A check box. Returns true when the user changes it.
  bool flag(const std::string& name, bool& is_on, const std::string& help = "");
  /// One number or three, edited by dragging, or by typing after a double click. Returns true when changed.
  bool drag(const std::string& name, double* numbers, int count, const DragStyle& style, double min,
            double max, const std::string& help = "");
  /// A linear colour of any intensity: hue and intensity are edited separately. Returns true when changed.
  bool colour(const std::string& name, std::array<double, 3>& linear, const DragStyle& style,
              const std::string& help = "");
  /// A text field. Returns true when the user presses Enter.
  bool text(const std::string& name, std::string& text, const std::string& help = "");

  /// A row of buttons over the whole width; returns the index of the one pressed.
  std::optional<std::size_t> buttons(const std::vector<std::string>& names, std::size_t lit);

  /// Records the rectangle of ImGui's last item.
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
  design::Language language_;
  Held held_;
};

}  // namespace parvis::viewer
