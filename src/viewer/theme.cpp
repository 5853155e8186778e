#include "viewer/theme.h"

#include <array>
#include <filesystem>
#include <initializer_list>

namespace parvis::viewer {
namespace {

constexpr float text_size = 15.0f;  // at scale 1, in points

/// Latin, Greek and Cyrillic, and the punctuation of all: scenes are named in many languages.
constexpr std::array<ImWchar, 7> letters{0x20, 0x52F, 0x2010, 0x205E, 0x20A0, 0x20BF, 0};

ImFont* font(std::initializer_list<const char*> files, float size) {
  ImFontConfig config;
  config.OversampleH = 2;
  for (const char* file : files)
    if (std::error_code unreadable; std::filesystem::is_regular_file(file, unreadable))
      if (ImFont* read = ImGui::GetIO().Fonts->AddFontFromFileTTF(file, size, &config, letters.data()))
        return read;
  config.SizePixels = size;
  return ImGui::GetIO().Fonts->AddFontDefault(&config);
}

ImVec4 grey(float level, float alpha = 1.0f) { return {level, level * 1.015f, level * 1.04f, alpha}; }
ImVec4 ochre(float alpha) { return {accent.x, accent.y, accent.z, alpha}; }

void set_colours(ImVec4* colours) {
  colours[ImGuiCol_Text] = grey(0.91f);
  colours[ImGuiCol_TextDisabled] = dim_text;
  colours[ImGuiCol_WindowBg] = grey(0.105f);
  colours[ImGuiCol_ChildBg] = grey(0.0f, 0.0f);
  colours[ImGuiCol_PopupBg] = grey(0.13f, 0.98f);
  colours[ImGuiCol_Border] = grey(0.22f);
  colours[ImGuiCol_FrameBg] = grey(0.17f);
  colours[ImGuiCol_FrameBgHovered] = grey(0.22f);
  colours[ImGuiCol_FrameBgActive] = grey(0.26f);
  colours[ImGuiCol_Button] = grey(0.20f);
  colours[ImGuiCol_ButtonHovered] = grey(0.27f);
  colours[ImGuiCol_ButtonActive] = grey(0.33f);
  for (const ImGuiCol header : {ImGuiCol_Header, ImGuiCol_TabActive}) colours[header] = ochre(0.28f);
  for (const ImGuiCol hovered : {ImGuiCol_HeaderHovered, ImGuiCol_TabHovered})
    colours[hovered] = ochre(0.20f);
  colours[ImGuiCol_HeaderActive] = ochre(0.36f);
  colours[ImGuiCol_Tab] = grey(0.14f);
  colours[ImGuiCol_CheckMark] = colours[ImGuiCol_SliderGrabActive] = accent;
  colours[ImGuiCol_SliderGrab] = ochre(0.75f);
  colours[ImGuiCol_Separator] = grey(0.20f);
  colours[ImGuiCol_ScrollbarBg] = grey(0.0f, 0.0f);
  colours[ImGuiCol_ScrollbarGrab] = grey(0.26f);
  colours[ImGuiCol_PlotHistogram] = colours[ImGuiCol_PlotLines] = accent;
  colours[ImGuiCol_TextSelectedBg] = ochre(0.35f);
}

}  // namespace

Fonts apply_theme(float scale, float pixels_per_point) {
  ImGuiStyle style;
  ImGui::StyleColorsDark(&style);
  style.WindowPadding = {14, 12};
  style.FramePadding = {8, 4};
  style.ItemSpacing = {8, 6};
  style.ItemInnerSpacing = {6, 4};
  style.IndentSpacing = 14;
  style.ScrollbarSize = 11;
  style.WindowRounding = 0;
  style.FrameRounding = style.GrabRounding = style.PopupRounding = style.TabRounding = 4;
  style.WindowBorderSize = 0;
  style.DisabledAlpha = 0.5f;
  set_colours(style.Colors);
  style.ScaleAllSizes(scale);
  ImGui::GetStyle() = style;

  ImGuiIO& io = ImGui::GetIO();
  io.Fonts->Clear();
  io.FontGlobalScale = 1.0f / pixels_per_point;
  const float size = text_size * scale * pixels_per_point;
  return {font({"/usr/share/fonts/opentype/inter/Inter-Regular.otf",
                "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"},
               size),
          font({"/usr/share/fonts/opentype/inter/Inter-SemiBold.otf",
                "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf"},
               size)};
}

}  // namespace parvis::viewer
