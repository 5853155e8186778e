#include "planning/plan_drawing/text_outlines.h"

#include "planning/plan_drawing/cairo_module.h"

namespace parvis::plan_drawing {

Status letters_known() {
  const Result<const CairoFunctions*> functions = cairo.functions();
  return functions ? Status(Ok{}) : functions.errors();
}

TextOutlines text_outlines(const formats::DrawingText& text) {
  const Result<const CairoFunctions*> functions = cairo.functions();
  return functions ? (*functions)->text_outlines(text) : TextOutlines();
}

}  // namespace parvis::plan_drawing
