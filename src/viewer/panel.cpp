#include "viewer/panel.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string_view>
#include <utility>

#include "graphics/gl/context.h"
#include "graphics/light/day_light_time.h"
#include "reflections/methods/registry.h"
#include "reflections/methods/settings.h"
#include "scene/data/realism.h"
#include "viewer/keys.h"

namespace parvis::viewer {
namespace {

constexpr float panel_width = 350.0f;  // at scale 1
constexpr float largest_share = 0.5f;  // of a narrow window
constexpr double last_hour = 23.99;    // dayLight takes hours below 24
constexpr ImGuiWindowFlags fixed_window = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                          ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings;

/// Names of the scene's tours, those inside groups too.
void add_tours(const scene::Nodes& nodes, std::vector<std::string>& names) {
  for (const scene::Node& node : nodes) {
    if (node.schema->type == "tour") names.push_back(node.text("name"));
    add_tours(node.children, names);
  }
}

/// The name of a method, for people.
std::string with_spaces(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

std::string title_of(const scene::Node& scenario) {
  const std::string title = scenario.text("title");
  return title.empty() ? scenario.text("name") : title;
}

}  // namespace

Panel::Panel(const ImguiContext& imgui, std::string title, design::Language language)
    : imgui_(imgui),
      title_(std::move(title)),
      driver_(gl::driver_name()),
      draws_on_processor_(gl::is_software()),
      rows_(imgui.fonts(), language) {}

float Panel::width() const {
  return is_open ? std::min(panel_width * imgui_.scale(), largest_share * ImGui::GetIO().DisplaySize.x)
                 : 0.0f;
}

void Panel::draw(Visit& visit, const FrameStatistics& statistics, Hearing* hearing) {
  rows_.forget_places();
  if (is_open) draw_panel(visit, statistics, hearing);
  if (shows_keys) draw_keys();
  draw_notices(visit);
}

void Panel::draw_panel(Visit& visit, const FrameStatistics& statistics, Hearing* hearing) {
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({window.x - width(), 0.0f});
  ImGui::SetNextWindowSize({width(), window.y});
  ImGui::Begin("panel", nullptr, fixed_window | ImGuiWindowFlags_NoBringToFrontOnFocus);
  ImGui::PushFont(imgui_.fonts().heading);
  ImGui::TextUnformatted(title_.c_str());
  ImGui::PopFont();

  const float footer = ImGui::GetFrameHeightWithSpacing() + ImGui::GetStyle().ItemSpacing.y;
  ImGui::BeginChild("page", {0.0f, -footer});
  if (ImGui::BeginTabBar("pages")) {
    const char* const turns_to = std::exchange(turns_to_, nullptr);
    const auto page = [&](const char* name, const auto& draw_page) {
      const bool turns_here = turns_to && std::string_view(name) == turns_to;
      const bool is_shown = ImGui::BeginTabItem((rows_.word(name) + "###" + name).c_str(), nullptr,
                                                turns_here ? ImGuiTabItemFlags_SetSelected : 0);
      rows_.note_place(name);
      if (!is_shown) return;
      draw_page();
      ImGui::EndTabItem();
    };
    if (design_page) page(page_of_design, [&] { design_page(rows_); });
    if (!shows_design_alone) {
      page("Visit", [&] {
        draw_visit(visit);
        draw_scenarios(visit);
        draw_light(visit);
        draw_processes(visit);
        if (hearing && hearing->is_on()) draw_sound(*hearing);
      });
      page(page_of_nodes, [&] { nodes_.draw(visit, rows_); });
      page("Statistics", [&] { draw_statistics(visit, statistics); });
    }
    ImGui::EndTabBar();
  }
  ImGui::EndChild();

  ImGui::Separator();
  const std::optional<std::size_t> pressed = rows_.buttons({"Picture  P", "Keys  F1", "Close  F2"}, 3);
  if (pressed == 0u) visit.take_picture();
  if (pressed == 1u) shows_keys = !shows_keys;
  if (pressed == 2u) is_open = false;
  ImGui::End();
}

void Panel::choose(const scene::LiveScene& live, const scene::Node& node) {
  nodes_.choose(live, node);
  turns_to_ = page_of_nodes;
}

void Panel::draw_visit(Visit& visit) {
  rows_.heading("Moving");
  const std::optional<std::size_t> mode = rows_.buttons({"Walk", "Fly", "Follow"}, std::size_t(visit.mode()));
  if (mode == std::size_t(Mode::follow) && visit.followed() < 0)
    visit.follow_next_vehicle();
  else if (mode)
    visit.set_mode(Mode(*mode));

  const scene::Scene& scene = visit.scene();
  const std::vector<int> vehicles = visit.vehicles();
  const auto name_of = [&](int object) { return scene.objects[std::size_t(object)].name; };
  std::vector<std::string> names(vehicles.size());
  std::transform(vehicles.begin(), vehicles.end(), names.begin(), name_of);
  const std::string followed = visit.followed() < 0 ? "none" : name_of(visit.followed());
  ImGui::BeginDisabled(names.empty());
  if (const auto chosen = rows_.choice("Vehicle", names, names.empty() ? "nothing moves here" : followed))
    visit.follow(vehicles[*chosen]);
  ImGui::EndDisabled();

  names.resize(scene.cameras.size());
  std::transform(scene.cameras.begin(), scene.cameras.end(), names.begin(),
                 [](const scene::NamedCamera& camera) { return camera.name; });
  ImGui::BeginDisabled(names.empty());
  if (const auto chosen = rows_.choice("Camera", names, names.empty() ? "the scene names none" : "go to ..."))
    visit.look_from(names[*chosen]);
  ImGui::EndDisabled();

  names.clear();
  add_tours(visit.live().nodes(), names);
  ImGui::BeginDisabled(names.empty());
  if (const auto chosen = rows_.choice("Tour", names, names.empty() ? "the scene has none" : "start ..."))
    visit.start_tour(names[*chosen]);
  ImGui::EndDisabled();
}

void Panel::draw_scenarios(Visit& visit) {
  const std::vector<const scene::Node*> scenarios = visit.live().scenarios();
  rows_.heading("Scenarios");
  if (scenarios.empty()) return rows_.remark("The scene has none.");
  const std::string now = visit.live().scenario();
  if (ImGui::RadioButton((rows_.word("As it is") + "###base").c_str(), now.empty())) visit.show_scenario("");
  rows_.note_place("scenario base");
  for (const scene::Node* scenario : scenarios) {
    const std::string name = scenario->text("name");
    if (ImGui::RadioButton((title_of(*scenario) + "##" + name).c_str(), now == name))
      visit.show_scenario(name);
    rows_.note_place("scenario " + name);
  }
}

void Panel::draw_sun(Visit& visit) {
  const glm::vec2 sun = azimuth_and_elevation_deg(visit.scene().sun.direction_to_sun);
  double azimuth = double(sun.x), elevation = double(sun.y);
  bool turns = rows_.drag("Sun from", &azimuth, 1, {0.5f, "%.1f°"}, -360, 720,
                          "compass direction of the sun: 0 north, 90 east");
  turns |= rows_.drag("Sun's height", &elevation, 1, {0.25f, "%.1f°"}, -90, 90, "above the horizon");
  if (turns) visit.set_sun(float(azimuth), std::clamp(float(elevation), -90.0f, 90.0f));
}

void Panel::draw_hour(Visit& visit, const scene::Node& day_light) {
  const int days = light::days_in_year(int(day_light.integer("year")));
  double day = double(day_light.integer("julianDay")), hour = day_light.number("timeOfDay");
  if (rows_.drag("Day", &day, 1, {0.25f, "%.0f"}, 1, days, "of the year: 80 is about the spring equinox"))
    visit.set_day(std::clamp(int(std::lround(day)), 1, days));
  if (rows_.drag("Hour", &hour, 1, {0.02f, "%.2f"}, 0, last_hour, "by the clock: 14.25 is 14:15"))
    visit.set_hour(std::clamp(hour, 0.0, last_hour));
}

void Panel::draw_light(Visit& visit) {
  rows_.heading("Light");
  const scene::Scene& scene = visit.scene();
  if (const scene::Node* day = visit.day_light())
    draw_hour(visit, *day);
  else
    draw_sun(visit);
  double exposure = visit.exposure();
  if (rows_.drag("Exposure", &exposure, 1, {0.005f, "%.3f"}, 0.01, 100, "how bright the picture is"))
    visit.set_exposure(exposure);

  double realism = double(scene.data<scene::Realism>().level);
  if (rows_.drag("Realism", &realism, 1, {0.005f, "%.2f"}, 0, 1,
                 "0 sketch, 0.25 white model, 0.5 plain colours, 0.75 materials, 1 everything"))
    visit.set_realism(realism);

  const methods::Registry& registry = visit.stage().registries().get<methods::Registry>();
  std::vector<std::string> names = registry.names();
  names.insert(names.begin(), methods::automatic);
  std::vector<std::string> shown(names.size());
  std::ranges::transform(names, shown.begin(), with_spaces);
  const std::string& named = methods::settings(scene).method;
  const std::string current = with_spaces(named.empty() ? methods::automatic : named);
  const std::string help =
      fmt::format("how mirror-like parts of moving things see their surroundings; this scene has {}",
                  with_spaces(registry.name_of(scene)));
  if (const auto method = rows_.choice("Reflections", shown, current, help))
    visit.set_reflection(names[std::size_t(*method)]);
}

void Panel::draw_processes(Visit& visit) {
  const bool is_halted = visit.is_halted();
  const std::vector<action::Process*> processes = visit.processes();
  for (const action::Process* process : processes) {
    std::string name = process->name();
    name[0] = char(std::toupper(static_cast<unsigned char>(name[0])));
    rows_.heading(name.c_str());
    rows_.remark(fmt::format("{}{}", process->status(), is_halted ? ", halted" : ""));
  }
  if (processes.empty()) return;
  const auto pressed = rows_.buttons({is_halted ? "Go on" : "Halt", "Step 0.1 s"}, is_halted ? 0 : 2);
  if (pressed == 0u) visit.halt(!is_halted);
  if (pressed == 1u) visit.step_halted();
}

void Panel::draw_sound(Hearing& hearing) {
  rows_.heading("Sound");
  rows_.value("Sources", fmt::format("{}", hearing.sounds()));
  if (const auto [core_fraction, voices] = hearing.cost(); voices > 0)
    rows_.value("Mixing", fmt::format("{:.1f} % of a core, {:.2f} ms per second and voice",
                                      100.0 * core_fraction, 1e3 * core_fraction / double(voices)));
  bool is_muted = hearing.is_muted();
  if (rows_.flag("Muted", is_muted, "the key M does the same")) hearing.mute(is_muted);
}

void Panel::draw_statistics(Visit& visit, const FrameStatistics& statistics) {
  rows_.heading("Frames");
  const std::vector<float> frames_ms = statistics.frames_ms();
  const double mean_ms = statistics.mean_ms();
  rows_.value("Mean", fmt::format("{:.1f} ms, {}", mean_ms, frame_rate(mean_ms)));
  rows_.value("Longest", fmt::format("{:.1f} ms of the last {}", statistics.worst_ms(), frames_ms.size()));
  ImGui::PlotHistogram("##frames", frames_ms.data(), int(frames_ms.size()), 0, nullptr, 0.0f,
                       float(1.2 * std::max(statistics.worst_ms(), 1.0)),
                       {ImGui::GetContentRegionAvail().x, 4.0f * ImGui::GetFrameHeight()});

  rows_.heading("Passes on the GPU");
  double longest_s = 1e-6;
  for (const gl::PassTime& pass : statistics.passes()) longest_s = std::max(longest_s, pass.seconds);
  for (const gl::PassTime& pass : statistics.passes()) {
    rows_.value(pass.name, fmt::format("{:.2f} ms", 1000.0 * pass.seconds));
    ImGui::ProgressBar(float(pass.seconds / longest_s), {-FLT_MIN, 3.0f * imgui_.scale()}, "");
  }
  if (statistics.passes().empty()) rows_.remark("None has been timed yet.");
  if (draws_on_processor_) rows_.remark("Software driver: of one frame in sixteen, by the clock.");

  if (!statistics.passes_on_processor().empty()) rows_.heading("On the CPU");
  for (const gl::PassTime& pass : statistics.passes_on_processor())
    rows_.value(pass.name, fmt::format("{:.2f} ms", 1000.0 * pass.seconds));

  const stage::SharedBudget& budget = visit.stage().shared_budget();
  rows_.heading("Lowered to hold the rate, in this order");
  rows_.value("Pixels", fmt::format("{:.0f} % drawn", 100.0 * visit.stage().drawn_share()));
  for (const auto& [name, what] : {std::pair{"Reflections", stage::Lowered::reflections},
                                   {"People", stage::Lowered::people},
                                   {"Sound", stage::Lowered::sound}})
    rows_.value(name, fmt::format("{:.0f} %", 100.0 * budget.share(what)));

  const render::DrawStatistics& drawn = visit.stage().renderer().statistics();
  rows_.heading("Main view");
  rows_.value("Triangles", fmt::format("{}", drawn.triangles));
  rows_.value("Draws", fmt::format("{}", drawn.draws));
  rows_.value("Parts",
              fmt::format("{} in view, {} of them hidden", drawn.items_in_frustum, drawn.items_hidden));
  rows_.value("Reflections", fmt::format("{} faces drawn", visit.stage().reflections().faces_drawn()));
  rows_.heading("Driver");
  rows_.remark(driver_);
}

void Panel::draw_keys() const {
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * (window.x - width()), 0.5f * window.y}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowBgAlpha(0.92f);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 8.0f * imgui_.scale());
  ImGui::Begin("keys", nullptr, fixed_window | ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::PopStyleVar();
  ImGui::PushFont(imgui_.fonts().heading);
  ImGui::TextUnformatted(rows_.word("Keys").c_str());
  ImGui::PopFont();
  ImGui::Spacing();
  const float column = 90.0f * imgui_.scale();
  for (const KeyHelp& help : key_help) {
    ImGui::TextColored(accent, "%s", help.keys);
    ImGui::SameLine(column);
    ImGui::TextUnformatted(rows_.word(help.does).c_str());
  }
  ImGui::Spacing();
  ImGui::TextDisabled("%s", rows_.word("Keys that the scene itself waits for go to the scene.").c_str());
  ImGui::End();
}

/// Draws the notices at the foot of the picture, the latest lowest.
void Panel::draw_notices(const Visit& visit) const {
  const float margin = 14.0f * imgui_.scale();
  const float max_width = ImGui::GetIO().DisplaySize.x - width() - 2.0f * margin;
  float foot = ImGui::GetIO().DisplaySize.y - notices_foot - margin;
  for (std::size_t i = visit.notices().size(); i-- > 0;) {
    const Notice& notice = visit.notices()[i];
    ImGui::SetNextWindowPos({margin, foot}, ImGuiCond_Always, {0.0f, 1.0f});
    ImGui::SetNextWindowSizeConstraints({0.0f, 0.0f}, {max_width, FLT_MAX});
    ImGui::SetNextWindowBgAlpha(0.85f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 6.0f * imgui_.scale());
    ImGui::Begin(fmt::format("notice {}", i).c_str(), nullptr,
                 fixed_window | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs |
                     ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::PopStyleVar();
    ImGui::PushTextWrapPos(max_width - margin);
    ImGui::PushStyleColor(ImGuiCol_Text,
                          notice.is_error ? error_text : ImGui::GetStyleColorVec4(ImGuiCol_Text));
    ImGui::TextUnformatted(rows_.word(notice.text).c_str());
    ImGui::PopStyleColor();
    ImGui::PopTextWrapPos();
    foot -= ImGui::GetWindowSize().y + 0.5f * margin;
    ImGui::End();
  }
}

}  // namespace parvis::viewer
