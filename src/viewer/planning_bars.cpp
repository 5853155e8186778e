#include "viewer/planning_bars.h"

#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "base/colour.h"
#include "planning/design/shape_models.h"
#include "viewer/node_rows.h"

namespace parvis::viewer {
namespace {

constexpr float tools_width = 48.0f, bar_height = 30.0f, picture_side = 96.0f;  // at scale 1
constexpr ImGuiWindowFlags bar_flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                       ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                       ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoFocusOnAppearing |
                                       ImGuiWindowFlags_NoBringToFrontOnFocus;

enum Icon {
  arrow_icon,
  plus_icon,
  ruler_icon,
  polygon_icon,
  catalogue_icon,
  undo_icon,
  redo_icon,
  save_icon
};

/// The value that all objects have in common; none: they differ.
template <class Get>
auto shared(const std::vector<design::PlacedObject>& all, Get get)
    -> std::optional<decltype(get(all.front()))> {
  const auto first = get(all.front());
  for (const design::PlacedObject& object : all)
    if (!(get(object) == first)) return std::nullopt;
  return first;
}

std::string joined(const design::Names& names) { return fmt::format("{}", fmt::join(names, ",")); }

}  // namespace

PlanningBars::PlanningBars(const ImguiContext& imgui, Planning& planning, std::filesystem::path pictures)
    : imgui_(imgui),
      planning_(planning),
      pictures_(planning.visit().stage().registries(), planning.visit().scene(), std::move(pictures)),
      commands_(imgui, planning) {}

/// A button of a bar; lit where it says what is so.
bool PlanningBars::button(const std::string& name, const char* key, bool is_lit, float width) {
  if (is_lit) ImGui::PushStyleColor(ImGuiCol_Button, ImVec4(accent.x, accent.y, accent.z, 0.45f));
  const bool is_pressed = ImGui::Button((planning_.word(name) + "##" + name).c_str(), {width, 0.0f});
  if (is_lit) ImGui::PopStyleColor();
  places_[name] = {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()};
  if (ImGui::IsItemHovered() && *key) ImGui::SetTooltip("%s   %s", planning_.word(name).c_str(), key);
  return is_pressed;
}

void PlanningBars::draw_icon(int icon, ImVec2 low, float side, ImU32 colour) const {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const auto at = [&](float x, float y) { return ImVec2(low.x + x * side, low.y + y * side); };
  const float w = 0.075f * side;
  const auto path = [&](std::initializer_list<ImVec2> points, bool closes) {
    std::vector<ImVec2> all(points);
    list.AddPolyline(all.data(), int(all.size()), colour, closes ? ImDrawFlags_Closed : 0, w);
  };
  switch (icon) {
    case arrow_icon:
      path({at(.3f, .15f), at(.3f, .8f), at(.47f, .64f), at(.58f, .88f), at(.68f, .83f), at(.57f, .6f),
            at(.78f, .58f)},
           true);
      break;
    case plus_icon:
      path({at(.5f, .2f), at(.5f, .8f)}, false), path({at(.2f, .5f), at(.8f, .5f)}, false);
      break;
    case ruler_icon:
      path({at(.12f, .38f), at(.88f, .38f), at(.88f, .64f), at(.12f, .64f)}, true);
      for (const float x : {.31f, .5f, .69f}) path({at(x, .38f), at(x, .5f)}, false);
      break;
    case polygon_icon:
      path({at(.2f, .75f), at(.3f, .25f), at(.62f, .2f), at(.85f, .55f), at(.6f, .8f)}, true);
      break;
    case catalogue_icon:
      for (const float x : {.2f, .55f})
        for (const float y : {.2f, .55f})
          list.AddRectFilled(at(x, y), at(x + .25f, y + .25f), colour, 0.05f * side);
      break;
    case undo_icon:
    case redo_icon: {
      const float sign = icon == undo_icon ? 1.0f : -1.0f;
      const auto flipped = [&](float x, float y) { return at(0.5f + sign * (x - 0.5f), y); };
      path({flipped(.22f, .42f), flipped(.6f, .42f), flipped(.76f, .55f), flipped(.7f, .76f),
            flipped(.45f, .8f)},
           false);
      path({flipped(.38f, .24f), flipped(.2f, .42f), flipped(.38f, .6f)}, false);
      break;
    }
    case save_icon:
      path({at(.22f, .2f), at(.66f, .2f), at(.8f, .34f), at(.8f, .8f), at(.22f, .8f)}, true);
      path({at(.36f, .8f), at(.36f, .56f), at(.66f, .56f), at(.66f, .8f)}, false);
      break;
    default:
      break;
  }
}

void PlanningBars::draw_tools(float height) {
  const float width = tools_width * imgui_.scale(), side = 34.0f * imgui_.scale();
  ImGui::SetNextWindowPos({0.0f, 0.5f * height}, ImGuiCond_Always, {0.0f, 0.5f});
  ImGui::SetNextWindowBgAlpha(0.86f);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.5f * (width - side), 6.0f * imgui_.scale()});
  ImGui::Begin("tools", nullptr, bar_flags | ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::PopStyleVar();
  planner::Tool& tool = *planning_.tool();
  const auto place = [&](const char* name, const char* key, Icon icon, bool is_lit) {
    const ImVec2 low = ImGui::GetCursorScreenPos();
    if (is_lit) ImGui::PushStyleColor(ImGuiCol_Button, ImVec4(accent.x, accent.y, accent.z, 0.45f));
    const bool is_pressed = ImGui::Button(fmt::format("##{}", name).c_str(), {side, side});
    if (is_lit) ImGui::PopStyleColor();
    places_[name] = {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()};
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s   %s", planning_.word(name).c_str(), key);
    draw_icon(icon, low, side, is_lit ? IM_COL32(255, 236, 205, 255) : IM_COL32(225, 225, 228, 255));
    return is_pressed;
  };
  using planner::Mode;
  if (place("Select", "V", arrow_icon, tool.mode() == Mode::select)) tool.choose(Mode::select);
  if (place("Catalogue", "K", catalogue_icon, planning_.shows_catalogue))
    planning_.shows_catalogue = !planning_.shows_catalogue;
  if (place("Surface", "U", polygon_icon, tool.mode() == Mode::surface)) tool.choose(Mode::surface);
  if (place("Measure", "M", ruler_icon, tool.mode() == Mode::measure)) tool.choose_measure();
  ImGui::Separator();
  if (place("Undo", "Ctrl+Z", undo_icon, false)) planning_.undo();
  if (place("Redo", "Ctrl+Shift+Z", redo_icon, false)) planning_.redo();
  if (place("Save", "Ctrl+S", save_icon, false)) planning_.save();
  ImGui::End();
}

/// The next widget stands behind the last one where it fits a bar over a picture of this width, else below.
void PlanningBars::stay_on_line(float next_width, float gap, float width) const {
  const float end = ImGui::GetItemRectMax().x + gap + next_width + 8.0f * imgui_.scale();
  if (end - ImGui::GetWindowPos().x < width) ImGui::SameLine(0.0f, gap);
}

void PlanningBars::draw_views(float width) {
  ImGui::SetNextWindowPos({0.5f * width, 0.0f}, ImGuiCond_Always, {0.5f, 0.0f});
  ImGui::SetNextWindowBgAlpha(0.86f);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {8.0f * imgui_.scale(), 5.0f * imgui_.scale()});
  ImGui::Begin("views", nullptr, bar_flags | ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::PopStyleVar();
  const float side = 74.0f * imgui_.scale();
  const bool is_plan = planning_.visit().camera().parallel.has_value();
  const float gap = ImGui::GetStyle().ItemSpacing.x, padding = 2.0f * ImGui::GetStyle().FramePadding.x;
  if (button("Plan", "4", is_plan, side)) planning_.look(PlanningView::plan);
  stay_on_line(side, gap, width);
  if (button("Street", "5", !is_plan && !planning_.waits_for_balcony(), side))
    planning_.look(PlanningView::street);
  stay_on_line(side, gap, width);
  if (button("Balcony", "6", planning_.waits_for_balcony(), side)) planning_.look(PlanningView::balcony);
  const std::vector<int> kept = planning_.kept_views();
  const float digit = padding + ImGui::CalcTextSize("8").x;
  for (const int number : kept) {
    stay_on_line(digit, gap, width);
    if (button(fmt::format("{}", number).c_str(), fmt::format("Ctrl+{}", number).c_str(), false, 0.0f))
      planning_.go_to_view(number);
  }
  stay_on_line(digit, gap, width);
  const int next = kept.empty() ? 1 : kept.back() + 1;
  if (next <= 9 && button("+", "Keep this view", false, 0.0f)) planning_.keep_view(next);
  for (const std::string& design : planning_.designs()) {
    stay_on_line(padding + ImGui::CalcTextSize(design.c_str()).x,
                 (design == planning_.designs().front() ? 18.0f : 6.0f) * imgui_.scale(), width);
    const bool is_open = planning_.session() && planning_.session()->name() == design;
    if (is_open) ImGui::PushStyleColor(ImGuiCol_Button, ImVec4(accent.x, accent.y, accent.z, 0.45f));
    const bool is_pressed = ImGui::Button((design + "##design").c_str());
    if (is_open) ImGui::PopStyleColor();
    places_["design " + design] = {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()};
    if (is_pressed && !is_open) planning_.open_design(design);
  }
  if (!planning_.designs().empty() && !planning_.study) {
    stay_on_line(padding + ImGui::CalcTextSize(planning_.word("New").c_str()).x, gap, width);
    if (button("New", planning_.word("begins another design").c_str(), false, 0.0f)) planning_.begin_design();
  }
  ImGui::End();
}

/// Returns its height: a long sentence takes several lines.
float PlanningBars::draw_hint(float width) {
  const planner::Tool& tool = *planning_.tool();
  const bool is_refused = !tool.refusal().empty();
  std::string said = planning_.waits_for_balcony()
                         ? planning_.word("Click a window or a balcony to stand there.")
                     : is_refused ? tool.refusal()
                                  : planning_.word(tool.hint());
  if (!tool.typed().empty()) said = tool.typed();
  const float margin = 10.0f * imgui_.scale(), wrapped_at = std::max(width - 2.0f * margin, 1.0f);
  const float height = std::max(bar_height * imgui_.scale(),
                                ImGui::CalcTextSize(said.c_str(), nullptr, false, wrapped_at).y + margin);
  ImGui::SetNextWindowPos({0.0f, ImGui::GetIO().DisplaySize.y - height});
  ImGui::SetNextWindowSize({width, height});
  ImGui::SetNextWindowBgAlpha(0.86f);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {margin, 6.0f * imgui_.scale()});
  ImGui::Begin("hint", nullptr, bar_flags);
  ImGui::PopStyleVar();
  ImGui::PushStyleColor(ImGuiCol_Text, is_refused ? error_text : ImGui::GetStyleColorVec4(ImGuiCol_Text));
  ImGui::PushTextWrapPos(margin + wrapped_at);
  ImGui::TextUnformatted(said.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
  std::string right;
  if (tool.place()) {
    const glm::dvec3 p = *tool.place();
    right = fmt::format("{:.2f}  {:.2f}  {:.2f} m", p.x, p.y, p.z);
    if (const glm::dvec3 origin = planning_.visit().scene().origin; origin != glm::dvec3(0.0))
      right = fmt::format("{:.2f}  {:.2f}   ", origin.x + p.x, origin.y + p.y) + right;
    if (tool.snapped().kind != planner::SnapKind::none)
      right += "   " + planning_.word(planner::name_of(tool.snapped().kind));
  }
  if (!planning_.saved_at().empty())
    right += fmt::format("   {} {}", planning_.word("saved"), planning_.saved_at());
  const float at = width - ImGui::CalcTextSize(right.c_str()).x - 10.0f * imgui_.scale();
  if (at > ImGui::CalcTextSize(said.c_str()).x + 24.0f * imgui_.scale()) {
    ImGui::SameLine(at);
    ImGui::TextColored(dim_text, "%s", right.c_str());
  }
  ImGui::End();
  return height;
}

/// `foot`: the height of what stands below it. Returns its own.
float PlanningBars::draw_catalogue(float width, float foot) {
  // A picture takes as long as a frame or more: none is made while a hand is at work.
  constexpr int rest_frames = 8;
  const ImGuiIO& io = ImGui::GetIO();
  const bool is_at_work = io.MouseDelta.x != 0.0f || io.MouseDelta.y != 0.0f || ImGui::IsAnyMouseDown() ||
                          ImGui::IsMouseReleased(ImGuiMouseButton_Left);
  resting_frames_ = is_at_work ? 0 : resting_frames_ + 1;
  if (resting_frames_ > rest_frames) pictures_.make_one();
  const float side = picture_side * imgui_.scale();
  const float height = side + 114.0f * imgui_.scale();
  ImGui::SetNextWindowPos({tools_width * imgui_.scale(), ImGui::GetIO().DisplaySize.y - foot - height});
  ImGui::SetNextWindowSize({width - tools_width * imgui_.scale(), height});
  ImGui::SetNextWindowBgAlpha(0.93f);
  ImGui::Begin("catalogue", nullptr, bar_flags);
  for (const char* tab : {"all", "seats", "shade", "green", "street", "people", "own"}) {
    if (button(tab, "", tab_ == tab, 0.0f)) tab_ = tab;
    ImGui::SameLine();
  }
  ImGui::SetNextItemWidth(160.0f * imgui_.scale());
  ImGui::InputTextWithHint("##search", planning_.word("search").c_str(), &search_);
  places_["search"] = {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()};
  ImGui::BeginChild("kinds", {0.0f, 0.0f}, false, ImGuiWindowFlags_HorizontalScrollbar);
  const bool is_french = planning_.word("Width") != "Width";
  bool is_first = true;
  // Kinds keep their places while their pictures are drawn.
  const ImVec2 padding = ImGui::GetStyle().FramePadding;
  const ImVec2 with_frame(side + 2.0f * padding.x, side + 2.0f * padding.y);
  for (const design::Kind& kind : design::kinds_of(planning_.visit().scene())) {
    const std::string& label = is_french ? kind.label_fr : kind.label;
    if (tab_ != "all" && kind.tab != tab_) continue;
    if (!search_.empty() && lower(label + " " + kind.name).find(lower(search_)) == std::string::npos)
      continue;
    if (!is_first) ImGui::SameLine();
    is_first = false;
    ImGui::BeginGroup();
    const bool is_chosen = planning_.tool()->kind() == kind.name;
    if (is_chosen) ImGui::PushStyleColor(ImGuiCol_Button, ImVec4(accent.x, accent.y, accent.z, 0.6f));
    ImGui::PushID(kind.name.c_str());
    // ImGui takes names of textures as pointers. NOLINTNEXTLINE(performance-no-int-to-ptr)
    const auto texture = reinterpret_cast<ImTextureID>(std::uintptr_t(pictures_.of(kind.name)));
    const bool is_pressed =
        texture ? ImGui::ImageButton(texture, {side, side}) : ImGui::Button("...", with_frame);
    places_["kind " + kind.name] = {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()};
    if (ImGui::IsItemHovered())
      ImGui::SetTooltip("%s   %g x %g x %g m", label.c_str(), kind.size_m.x, kind.size_m.y, kind.size_m.z);
    ImGui::PopID();
    if (is_chosen) ImGui::PopStyleColor();
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + with_frame.x);
    ImGui::TextColored(is_chosen ? accent : dim_text, "%s", label.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndGroup();
    if (is_pressed) planning_.tool()->choose_kind(kind.name);
  }
  ImGui::EndChild();
  ImGui::End();
  return height;
}

void PlanningBars::draw_lengths(PanelRows& rows, const design::PlacedObject& first) {
  const std::string names = joined(planning_.session()->selected());
  const design::Kind* kind = design::find_kind(planning_.visit().scene(), first.kind);
  constexpr std::array axes{"Width", "Depth", "Height"};
  constexpr std::array attributes{"width", "depth", "height"};
  constexpr std::array changes{design::Changeable::width, design::Changeable::depth,
                               design::Changeable::height};
  for (std::size_t axis = 0; axis < axes.size(); ++axis) {
    double length = first.size_m[int(axis)];
    const std::string name = planning_.word(axes[axis]);
    if (!kind || !kind->may_change(changes[axis])) {
      rows.value(name, fmt::format("{:.2f} m", length));
      continue;
    }
    rows.drag(name, &length, 1, {0.01f, "%.3f m"}, kind->min_m[int(axis)], kind->max_m[int(axis)]);
    if (ImGui::IsItemDeactivatedAfterEdit())
      planning_.run(fmt::format("resize {} {} {:.4f}", names, attributes[axis], length));
  }
}

/// A row of usual colours, and any other one as #RRGGBB.
void PlanningBars::draw_colours(PanelRows& rows, const design::PlacedObject& first,
                                const std::string& names) {
  constexpr std::array<const char*, 9> usual{"#EADFC8", "#F4F2EC", "#BF6A45", "#8E2F2A", "#C9A23E",
                                             "#2E4A3A", "#4F7FA8", "#8E6945", "#2C3130"};
  const auto paint = [&](const std::string& code) {
    planning_.run(fmt::format("colour {} {}", names, code));
  };
  const glm::vec3 srgb = srgb_from_linear(first.colour);
  const auto byte = [&](int channel) {
    return int(std::lround(255.0f * std::clamp(srgb[channel], 0.0f, 1.0f)));
  };
  std::string code = fmt::format("#{:02X}{:02X}{:02X}", byte(0), byte(1), byte(2));
  if (rows.text(planning_.word("Colour"), code)) paint(code);
  const float side = ImGui::GetFrameHeight();
  for (const char* const each : usual) {
    unsigned rgb = 0;
    std::sscanf(each, "#%x", &rgb);
    const ImVec4 colour(float(rgb >> 16) / 255.0f, float(rgb >> 8 & 255u) / 255.0f,
                        float(rgb & 255u) / 255.0f, 1.0f);
    if (each != usual.front()) ImGui::SameLine(0.0f, 4.0f * imgui_.scale());
    if (ImGui::ColorButton(each, colour, ImGuiColorEditFlags_NoTooltip, {side, side})) paint(each);
    rows.note_place(std::string("colour ") + each);
  }
}

/// How several objects stand to each other.
void PlanningBars::draw_arrangement(PanelRows& rows, const std::vector<design::PlacedObject>& chosen) {
  const std::string names = joined(planning_.session()->selected());
  rows.heading(planning_.word("Together").c_str());
  const auto aligned =
      rows.buttons({planning_.word("Align x"), planning_.word("Align y"), planning_.word("Same heading")}, 3);
  constexpr std::array axes{"x", "y", "heading"};
  if (aligned) planning_.run(fmt::format("align {} {}", names, axes[*aligned]));
  const auto group = shared(chosen, [](const auto& each) { return each.group; });
  const bool is_group = group && !group->empty();
  const auto arranged =
      rows.buttons({planning_.word("Space evenly"), planning_.word(is_group ? "Ungroup" : "Group")}, 2);
  if (arranged == 0u) planning_.run("space " + names);
  if (arranged == 1u && is_group) planning_.run("ungroup " + names);
  if (arranged == 1u && !is_group) planning_.group_selected();
}

void PlanningBars::draw_inspector(PanelRows& rows) {
  design::Session* session = planning_.session();
  if (!session) return;
  std::vector<design::PlacedObject> chosen;
  for (const design::PlacedObject& object : session->objects())
    if (std::ranges::count(session->selected(), object.name) > 0) chosen.push_back(object);
  const std::string names = joined(session->selected());
  for (const design::Measurement& each : session->measurements()) {
    if (std::ranges::count(session->selected(), each.name) == 0) continue;
    rows.heading(each.name.c_str());
    rows.value(planning_.word("Measured"), each.text());
  }
  if (chosen.empty() && !session->selected().empty()) {
    if (rows.buttons({planning_.word("Delete")}, 1) == 0u) planning_.run("delete " + names);
  } else if (chosen.empty()) {
    rows.heading(planning_.word("nothing selected").c_str());
    rows.remark(planning_.word(planning_.tool()->hint()));
  } else {
    const design::PlacedObject& first = chosen.front();
    const auto kind = shared(chosen, [](const auto& each) { return each.kind; });
    rows.heading(chosen.size() == 1 ? first.name.c_str()
                                    : fmt::format("{} {}", chosen.size(), planning_.word("objects")).c_str());
    std::vector<std::string> kinds, labels;
    for (const design::Kind& each : design::kinds_of(planning_.visit().scene())) {
      kinds.push_back(each.name);
      labels.push_back(planning_.word("Width") == "Width" ? each.label : each.label_fr);
    }
    const auto known = std::ranges::find(kinds, kind.value_or(""));
    const std::string now = !kind                  ? planning_.word("mixed")
                            : known == kinds.end() ? first.label
                                                   : labels[std::size_t(known - kinds.begin())];
    if (const auto wanted = rows.choice(planning_.word("Kind"), labels, now))
      planning_.run(fmt::format("swap {} for {}", names, kinds[*wanted]));
    if (chosen.size() == 1) {
      glm::dvec3 position = first.position;
      rows.drag(planning_.word("Position"), &position.x, 3, {0.01f, "%.3f"}, -1e5, 1e5);
      if (ImGui::IsItemDeactivatedAfterEdit())
        planning_.run(
            fmt::format("move {} to {:.4f},{:.4f},{:.4f}", names, position.x, position.y, position.z));
    }
    double heading = first.heading_deg;
    rows.drag(planning_.word("Heading"), &heading, 1, {1.0f, "%.1f°"}, -360.0, 360.0);
    if (ImGui::IsItemDeactivatedAfterEdit()) planning_.run(fmt::format("turn {} to {:.3f}", names, heading));
    if (kind) draw_lengths(rows, first);
    draw_colours(rows, first, names);
    const std::vector<std::string> materials = design::material_names();
    if (const auto wanted = rows.choice(planning_.word("Material"), materials, first.material))
      planning_.run(fmt::format("material {} {}", names, materials[*wanted]));
    const auto locked = shared(chosen, [](const auto& each) { return each.is_locked; });
    bool is_locked = locked.value_or(false);
    if (rows.flag(planning_.word("Locked"), is_locked))
      planning_.run((is_locked ? "lock " : "unlock ") + names);
    const auto pressed = rows.buttons({planning_.word("Duplicate"), planning_.word("Delete")}, 2);
    if (pressed == 0u) planning_.run(fmt::format("duplicate {} by 1,0", names));
    if (pressed == 1u) planning_.run("delete " + names);
    if (chosen.size() > 1) draw_arrangement(rows, chosen);
    if (rows.buttons({planning_.word("All like this")}, 1) == 0u) planning_.run("select like " + first.name);
  }
  rows.heading(planning_.word("Steps").c_str());
  const std::vector<design::Step>& done = session->done();
  for (std::size_t i = done.size(); i-- > (done.size() > 12 ? done.size() - 12 : 0);)
    rows.remark(done[i].sentence);
  if (done.empty()) rows.remark("-");
}

void PlanningBars::draw(float picture_width) {
  places_.clear();
  height_below_ = 0.0f;
  if (!planning_.is_on()) return;
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  overlay_.draw(planning_, {picture_width, window.y}, imgui_.scale());
  draw_tools(window.y);
  draw_views(picture_width);
  height_below_ = draw_hint(picture_width);
  if (planning_.shows_catalogue) height_below_ += draw_catalogue(picture_width, height_below_);
  height_below_ += commands_.draw(picture_width, window.y - height_below_, places_);
}

}  // namespace parvis::viewer
