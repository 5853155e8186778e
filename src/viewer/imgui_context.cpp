#include "viewer/imgui_context.h"

#include <backends/imgui_impl_opengl3.h>

namespace parvis::viewer {

ImguiContext::ImguiContext(float scale, float pixels_per_point) : scale_(scale) {
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // each visit begins alike
  io.ConfigWindowsMoveFromTitleBarOnly = true;
  fonts_ = apply_theme(scale, pixels_per_point);
  ImGui_ImplOpenGL3_Init("#version 450 core");
}

ImguiContext::~ImguiContext() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext();
}

void ImguiContext::rescale(float scale, float pixels_per_point) {
  scale_ = scale;
  fonts_ = apply_theme(scale, pixels_per_point);
  ImGui_ImplOpenGL3_DestroyFontsTexture();  // rebuilt with the next frame
  ImGui_ImplOpenGL3_CreateFontsTexture();
}

void ImguiContext::begin_frame() {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
}

void ImguiContext::draw() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace parvis::viewer
