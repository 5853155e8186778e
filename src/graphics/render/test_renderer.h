// A renderer for the tests of all rooms.
#pragma once

#include <gtest/gtest.h>

#include "graphics/render/light_source.h"
#include "graphics/render/renderer.h"

namespace parvis::render {

/// A renderer without the drawables of rooms; a scene that cannot be drawn fails the test and ends it.
inline std::unique_ptr<Renderer> renderer_of(const scene::Scene& scene, const MakeLight& light) {
  Result<std::unique_ptr<Renderer>> made = Renderer::create(scene, {}, light);
  EXPECT_TRUE(made) << to_string(made.errors());
  return *std::move(made);
}

}  // namespace parvis::render
