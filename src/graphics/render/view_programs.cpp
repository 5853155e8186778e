#include "graphics/render/view_programs.h"

#include "graphics/render/bindings.h"
#include "graphics/render/virtual_vertices.h"

namespace parvis::render {

Result<ViewPrograms> ViewPrograms::create(DrawableShader shader) {
  ViewPrograms programs;
  programs.shader_ = std::move(shader);
  const auto link = [&](gl::Program& program, std::initializer_list<const char*> more) -> Status {
    gl::Defines defines = defines_of(programs.shader_);
    for (const char* define : more) defines.emplace_back(define, "");
    Result<gl::Program> linked =
        gl::Program::create("graphics/render/surface.vert", "graphics/render/surface.frag", defines);
    if (!linked) return linked.errors();
    program = *std::move(linked);
    assign_bindings(program);
    return Ok{};
  };
  for (const Status& status : {link(programs.many_samples_, {}), link(programs.one_sample_, {"ONE_SAMPLE"}),
                               link(programs.depth_, {"ONE_SAMPLE", "WRITES_DEPTH"}),
                               link(programs.picking_, {"ONE_SAMPLE", "WRITES_OBJECT"})})
    if (!status) return status.errors();
  return programs;
}

const gl::Program* ViewPrograms::use(const View& view) const {
  const gl::Program* program = nullptr;
  switch (view.kind) {
    case ViewKind::main:
      program = view.has_one_sample ? &one_sample_ : &many_samples_;
      break;
    case ViewKind::cube_face:
      program = &one_sample_;
      break;
    case ViewKind::mirrored:
      program = view.virtual_vertices->program_of(shader_);
      break;
    case ViewKind::shadow:
      program = &depth_;
      break;
    case ViewKind::mirrors:
      return nullptr;
    case ViewKind::picking:
      program = &picking_;
      break;
  }
  if (!program) return nullptr;
  program->use();
  if (view.kind == ViewKind::mirrored) view.virtual_vertices->bind(*program);
  return program;
}

}  // namespace parvis::render
