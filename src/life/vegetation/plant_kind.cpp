#include "life/vegetation/plant_kind.h"

#include "base/colour.h"

namespace parvis::vegetation {
namespace {

glm::vec3 rgb(int r, int g, int b) { return linear_from_srgb8(r, g, b); }

/// Orders: children, first, length share, angle, upward, wander, steps, sides.
std::vector<PlantKind> make_kinds() {
  std::vector<PlantKind> kinds;
  kinds.push_back({.name = "orange",
                   .habit = Habit::tree,
                   .height_m = 3.0f,
                   .min_height_m = 1.0f,
                   .max_height_m = 8.0f,
                   .trunk_share = 0.021f,
                   .orders = {{0, 0.0f, 1.0f, 0.0f, 0.02f, 0.05f, 8, 10},
                              {11, 0.38f, 0.47f, 58.0f, 0.09f, 0.12f, 6, 7},
                              {9, 0.2f, 0.5f, 52.0f, 0.03f, 0.18f, 4, 5},
                              {5, 0.2f, 0.5f, 48.0f, 0.0f, 0.2f, 3, 3}},
                   .leaf = LeafForm::ellipse,
                   .leaf_m = 0.085f,
                   .leaves = 8000.0f,
                   .dark = rgb(0x34, 0x55, 0x26),
                   .light = rgb(0x6E, 0x8E, 0x3C),
                   .translucency = 0.35f,
                   .roughness = 0.42f,
                   .veins = 9.0f,
                   .bark = rgb(0x7D, 0x73, 0x66)});
  kinds.push_back({.name = "oak",
                   .habit = Habit::tree,
                   .height_m = 8.0f,
                   .min_height_m = 2.0f,
                   .max_height_m = 30.0f,
                   .trunk_share = 0.026f,
                   .orders = {{0, 0.0f, 1.0f, 0.0f, 0.01f, 0.08f, 12, 12},
                              {14, 0.26f, 0.56f, 64.0f, 0.09f, 0.14f, 8, 8},
                              {10, 0.22f, 0.44f, 52.0f, 0.02f, 0.2f, 5, 5},
                              {7, 0.2f, 0.5f, 48.0f, -0.02f, 0.22f, 3, 3}},
                   .leaf = LeafForm::lobed,
                   .leaf_m = 0.105f,
                   .leaves = 36000.0f,
                   .dark = rgb(0x47, 0x66, 0x2C),
                   .light = rgb(0x84, 0x9C, 0x46),
                   .translucency = 0.45f,
                   .roughness = 0.55f,
                   .veins = 7.0f,
                   .bark = rgb(0x74, 0x68, 0x5A)});
  kinds.push_back({.name = "plane",
                   .habit = Habit::tree,
                   .height_m = 10.0f,
                   .min_height_m = 3.0f,
                   .max_height_m = 35.0f,
                   .trunk_share = 0.019f,
                   .orders = {{0, 0.0f, 1.0f, 0.0f, 0.015f, 0.05f, 12, 12},
                              {15, 0.32f, 0.46f, 56.0f, 0.1f, 0.11f, 7, 7},
                              {9, 0.24f, 0.46f, 50.0f, 0.03f, 0.17f, 4, 5},
                              {6, 0.2f, 0.52f, 46.0f, -0.02f, 0.2f, 3, 3}},
                   .leaf = LeafForm::palmate,
                   .leaf_m = 0.17f,
                   .leaves = 13000.0f,
                   .dark = rgb(0x5C, 0x7C, 0x34),
                   .light = rgb(0x9A, 0xAE, 0x58),
                   .translucency = 0.55f,
                   .roughness = 0.55f,
                   .veins = 5.0f,
                   .bark = rgb(0xA3, 0x9C, 0x86)});
  kinds.push_back({.name = "hedge",
                   .habit = Habit::hedge,
                   .height_m = 1.2f,
                   .min_height_m = 0.3f,
                   .max_height_m = 6.0f,
                   .trunk_share = 0.012f,
                   .orders = {},
                   .leaf = LeafForm::ellipse,
                   .leaf_m = 0.05f,
                   .leaves = 4200.0f,
                   .dark = rgb(0x3C, 0x5E, 0x2C),
                   .light = rgb(0x74, 0x94, 0x42),
                   .translucency = 0.35f,
                   .roughness = 0.5f,
                   .veins = 8.0f,
                   .bark = rgb(0x6A, 0x5E, 0x50)});
  kinds.push_back({.name = "grass",
                   .habit = Habit::sward,
                   .height_m = 0.12f,
                   .min_height_m = 0.02f,
                   .max_height_m = 1.5f,
                   .trunk_share = 0.0f,
                   .orders = {},
                   .leaf = LeafForm::blade,
                   .leaf_m = 0.0f,
                   .leaves = 2600.0f,
                   .dark = rgb(0x55, 0x74, 0x30),
                   .light = rgb(0x98, 0xA8, 0x54),
                   .translucency = 0.5f,
                   .roughness = 0.6f,
                   .veins = 0.0f,
                   .bark = rgb(0x6A, 0x5E, 0x50)});
  kinds.push_back({.name = "spruce",
                   .habit = Habit::tree,
                   .height_m = 12.0f,
                   .min_height_m = 1.5f,
                   .max_height_m = 40.0f,
                   .trunk_share = 0.015f,
                   .orders = {{0, 0.0f, 1.0f, 0.0f, 0.0f, 0.8f, 14, 10},
                              {6, 0.05f, 0.2f, 98.0f, 0.12f, 0.04f, 6, 5},
                              {24, 0.08f, 0.46f, 52.0f, 0.05f, 0.08f, 3, 3},
                              {6, 0.2f, 0.4f, 48.0f, 0.0f, 0.1f, 2, 3}},
                   .grows_in_whorls = true,
                   .leaf = LeafForm::shoot,
                   .leaf_m = 0.15f,
                   .leaves = 42000.0f,
                   .dark = rgb(0x26, 0x41, 0x28),
                   .light = rgb(0x54, 0x72, 0x44),
                   .translucency = 0.12f,
                   .roughness = 0.5f,
                   .veins = 0.0f,
                   .bark = rgb(0x6E, 0x5C, 0x50)});
  kinds.push_back({.name = "pine",
                   .habit = Habit::tree,
                   .height_m = 12.0f,
                   .min_height_m = 2.0f,
                   .max_height_m = 40.0f,
                   .trunk_share = 0.016f,
                   .orders = {{0, 0.0f, 1.0f, 0.0f, 0.01f, 0.05f, 12, 10},
                              {22, 0.5f, 0.4f, 72.0f, 0.07f, 0.16f, 7, 7},
                              {9, 0.3f, 0.42f, 52.0f, 0.08f, 0.2f, 4, 5},
                              {6, 0.3f, 0.5f, 46.0f, 0.12f, 0.18f, 3, 3}},
                   .leaf = LeafForm::tuft,
                   .leaf_m = 0.15f,
                   .leaves = 26000.0f,
                   .dark = rgb(0x3A, 0x55, 0x3C),
                   .light = rgb(0x6C, 0x86, 0x5A),
                   .translucency = 0.15f,
                   .roughness = 0.5f,
                   .veins = 0.0f,
                   .bark = rgb(0x9A, 0x70, 0x54)});
  return kinds;
}

}  // namespace

const std::vector<PlantKind>& plant_kinds() {
  static const std::vector<PlantKind> kinds = make_kinds();
  return kinds;
}

const PlantKind* find_kind(std::string_view name) {
  for (const PlantKind& kind : plant_kinds())
    if (kind.name == name) return &kind;
  return nullptr;
}

}  // namespace parvis::vegetation
