#include "render/surface_programs.h"

#include "gl/context.h"
#include "render/bindings.h"

namespace parvis::render {
namespace {

gl::Defines defines_of(std::uint8_t features) {
  gl::Defines defines;
  if (features & surface_has_normal_map) defines.emplace_back("HAS_NORMAL_MAP", "");
  if (features & surface_has_surface_map) defines.emplace_back("HAS_SURFACE_MAP", "");
  if (features & surface_has_emission_map) defines.emplace_back("HAS_EMISSION_MAP", "");
  if (features & surface_has_coat) defines.emplace_back("HAS_COAT", "");
  if (features & surface_has_holes) defines.emplace_back("HAS_HOLES", "");
  if (features & surface_has_backs) defines.emplace_back("HAS_BACKS", "");
  if (!has_fast_anisotropy()) defines.emplace_back("ANISOTROPY_BY_TAPS", "");
  return defines;
}

}  // namespace

Result<SurfacePrograms> SurfacePrograms::create(const std::string& fragment_path,
                                                const std::vector<GpuMaterial>& materials) {
  SurfacePrograms made;
  for (const GpuMaterial& material : materials) {
    gl::Program& program = made.programs_[material.features];
    if (program.name()) continue;
    Result<gl::Program> linked =
        gl::Program::create("render/surface.vert", fragment_path, defines_of(material.features));
    if (!linked) return linked.errors();
    program = *std::move(linked);
    assign_bindings(program);
  }
  return made;
}

}  // namespace parvis::render
