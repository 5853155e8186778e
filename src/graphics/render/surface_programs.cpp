#include "graphics/render/surface_programs.h"

#include "graphics/gl/context.h"
#include "graphics/render/bindings.h"

namespace parvis::render {
namespace {

gl::Defines defines_of(std::uint16_t features) {
  gl::Defines defines;
  if (features & surface_has_normal_map) defines.emplace_back("HAS_NORMAL_MAP", "");
  if (features & surface_has_relief) defines.emplace_back("HAS_RELIEF", "");
  if (features & surface_has_surface_map) defines.emplace_back("HAS_SURFACE_MAP", "");
  if (features & surface_has_emission_map) defines.emplace_back("HAS_EMISSION_MAP", "");
  if (features & surface_has_coat) defines.emplace_back("HAS_COAT", "");
  if (features & surface_has_backs) defines.emplace_back("HAS_BACKS", "");
  if (features & surface_has_holes) defines.emplace_back("HAS_HOLES", "");
  if (features & surface_is_leaf) defines.emplace_back("IS_LEAF", "");
  if (features & surface_has_vertex_light) defines.emplace_back("HAS_VERTEX_LIGHT", "");
  if (features & surface_has_own_mappings) defines.emplace_back("HAS_OWN_MAPPINGS", "");
  if (features & surface_has_colours) defines.emplace_back("HAS_COLOURS", "");
  if (features & surface_has_occlusion_map) defines.emplace_back("HAS_OCCLUSION_MAP", "");
  if (features & surface_is_glass) defines.emplace_back("IS_GLASS", "");
  if (!has_fast_anisotropy()) defines.emplace_back("ANISOTROPY_BY_TAPS", "");
  return defines;
}

Status link(gl::Program& program, const SurfaceSource& source, const gl::Defines& defines) {
  if (program.name()) return Ok{};
  Result<gl::Program> linked = gl::Program::create(source.vertex, source.fragment, defines, source.includes);
  if (!linked) return linked.errors();
  program = *std::move(linked);
  assign_bindings(program);
  return Ok{};
}

}  // namespace

Result<SurfacePrograms> SurfacePrograms::create(const SurfaceSource& source,
                                                const std::vector<GpuMaterial>& materials) {
  SurfacePrograms made;
  made.source_ = source;
  made.source_.defines.emplace_back("REFLECTION_OVERLAY(radiance, roughness)", source.reflection);
  made.source_.defines.emplace_back("TRANSMISSION_OVERLAY(radiance)", source.transmission);
  for (const GpuMaterial& material : materials) {
    if (Status status = made.link_of(material.features, false); !status) return status.errors();
    if (!(material.features & surface_has_holes)) continue;
    if (Status status = made.link_of(material.features, true); !status) return status.errors();
  }
  return made;
}

Status SurfacePrograms::link_of(std::uint16_t features, bool discards) const {
  gl::Program& program = (discards ? one_sample_ : programs_)[features];
  if (program.name()) return Ok{};
  gl::Defines defines = defines_of(features);
  defines.insert(defines.end(), source_.defines.begin(), source_.defines.end());
  defines.insert(defines.end(), source_.mesh_defines.begin(), source_.mesh_defines.end());
  if (discards) defines.emplace_back("ONE_SAMPLE", "");
  if (Status status = link(program, source_, defines); !status) return status;
  for (const auto& [uniform, value] : uniforms_) program.set(uniform.c_str(), value);
  return Ok{};
}

/// A material has come that has other features than those before it.
const gl::Program& SurfacePrograms::linked(std::uint16_t features, bool discards) const {
  if (const Status status = link_of(features, discards); !status)
    fmt::print(stderr, "{}\n", to_string(status.errors()));
  return (discards ? one_sample_ : programs_)[features];
}

void SurfacePrograms::set(const char* uniform, int value) {
  uniforms_.emplace_back(uniform, value);
  for (const Variants* variants : {&programs_, &one_sample_})
    for (const auto& [features, program] : *variants)
      if (program.name()) program.set(uniform, value);
}

const gl::Program* SurfacePrograms::of(const DrawableShader& shader) {
  const auto [entry, is_new] = of_rooms_.try_emplace({shader.vertex_path, shader.surface_path});
  gl::Program& program = entry->second;
  if (is_new) {
    gl::Defines defines = defines_of(shader);
    defines.insert(defines.end(), source_.defines.begin(), source_.defines.end());
    if (const Status status = link(program, source_, defines); !status)
      fmt::print(stderr, "{}\n", to_string(status.errors()));
  }
  return program.name() ? &program : nullptr;
}

}  // namespace parvis::render
