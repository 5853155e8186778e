#include "graphics/render/culling.h"

#include "graphics/render/virtual_vertices.h"

namespace parvis::render {
namespace {

bool is_among(Subjects subjects, Standing standing) {
  switch (subjects) {
    case Subjects::all:
      return true;
    case Subjects::moving:
      return standing.is_dynamic;
    case Subjects::fixed:
      return !standing.is_dynamic;
    case Subjects::staying:
      return !standing.is_dynamic && !standing.is_newcomer;
    case Subjects::newcomers:
      return standing.is_newcomer;
  }
  return true;
}

}  // namespace

bool Culling::shows(int number, Standing standing) const {
  return is_among(view_.subjects, standing) && view_.shows(number);
}

bool Culling::may_see(const Bounds& bounds) const {
  return view_.kind == ViewKind::mirrored ? view_.virtual_vertices->may_show(bounds)
                                          : frustum_.may_see(bounds);
}

}  // namespace parvis::render
