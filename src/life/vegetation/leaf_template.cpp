#include "life/vegetation/leaf_template.h"

#include <array>
#include <cmath>
#include <span>

namespace parvis::vegetation {
namespace {

/// How a flat outline becomes a leaf: half of it folded up at the midrib, its tip bent down.
struct Bend {
  float fold, droop;
};

Bend bend_of(LeafForm form) {
  switch (form) {
    case LeafForm::ellipse:
      return {0.35f, 0.12f};
    case LeafForm::lobed:
      return {0.22f, 0.15f};
    case LeafForm::palmate:
      return {0.16f, 0.14f};
    case LeafForm::blade:
      return {0.0f, 0.4f};
    case LeafForm::shoot:
    case LeafForm::tuft:
      break;  // needles are straight
  }
  return {0.0f, 0.0f};
}

glm::vec3 bent(glm::vec2 at, Bend bend) {
  return {at.x, at.y, bend.fold * std::abs(at.x) - bend.droop * at.y * at.y};
}

void add_triangle(LeafTemplate& leaf, std::size_t a, std::size_t b, std::size_t c) {
  for (const std::size_t corner : {a, b, c}) leaf.indices.push_back(std::uint16_t(corner));
}

/// Half of the width at a place along the midrib, both in leaf lengths.
struct Station {
  float along, half_width;
};

/// A leaf with a midrib: base, stations of left, middle and right, tip.
LeafTemplate along_midrib(std::span<const Station> stations, Bend bend) {
  LeafTemplate leaf;
  leaf.points.push_back(bent({0.0f, 0.0f}, bend));
  for (const Station& s : stations)
    for (const float side : {-1.0f, 0.0f, 1.0f})
      leaf.points.push_back(bent({side * s.half_width, s.along}, bend));
  leaf.points.push_back(bent({0.0f, 1.0f}, bend));
  const std::size_t last = leaf.points.size() - 1;
  add_triangle(leaf, 0, 2, 1), add_triangle(leaf, 0, 3, 2);
  for (std::size_t k = 1; k + 3 < last; k += 3)
    for (std::size_t half = 0; half < 2; ++half) {
      const std::size_t a = k + half;
      add_triangle(leaf, a, a + 1, a + 4), add_triangle(leaf, a, a + 4, a + 3);
    }
  add_triangle(leaf, last - 3, last - 2, last), add_triangle(leaf, last - 2, last - 1, last);
  return leaf;
}

/// Five lobes about the end of the stalk.
LeafTemplate five_lobes(Bend bend) {
  constexpr std::array<glm::vec2, 7> right{{{0.0f, 0.16f},
                                            {0.34f, 0.02f},
                                            {0.26f, 0.24f},
                                            {0.5f, 0.36f},
                                            {0.5f, 0.56f},
                                            {0.2f, 0.6f},
                                            {0.0f, 1.0f}}};
  LeafTemplate leaf;
  leaf.points.push_back(bent({0.0f, 0.38f}, bend));
  for (const glm::vec2 at : right) leaf.points.push_back(bent(at, bend));
  for (std::size_t i = right.size() - 2; i > 0; --i)
    leaf.points.push_back(bent({-right[i].x, right[i].y}, bend));
  const std::size_t rim = leaf.points.size() - 1;
  for (std::size_t i = 0; i < rim; ++i) add_triangle(leaf, 0, 1 + i, 1 + (i + 1) % rim);
  return leaf;
}

/// A strip that narrows towards its tip.
LeafTemplate strip(Bend bend) {
  LeafTemplate leaf;
  for (const Station& s : {Station{0.0f, 0.02f}, Station{0.35f, 0.022f}, Station{0.7f, 0.014f}})
    for (const float side : {-1.0f, 1.0f}) leaf.points.push_back(bent({side * s.half_width, s.along}, bend));
  leaf.points.push_back(bent({0.0f, 1.0f}, bend));
  for (std::size_t k = 0; k < 4; k += 2)
    add_triangle(leaf, k, k + 1, k + 3), add_triangle(leaf, k, k + 3, k + 2);
  add_triangle(leaf, 4, 5, 6);
  return leaf;
}

/// Pairs of needles along a twig, which point forward and, every other one, up.
LeafTemplate comb_of_needles(int pairs) {
  const float step = 0.8f / float(pairs);  // their feet fill the twig: all needles together keep their area
  constexpr float aside = 0.15f, ahead = 0.12f;
  LeafTemplate leaf;
  for (int k = 0; k <= pairs; ++k) leaf.points.emplace_back(0.0f, step * float(k), 0.0f);
  for (int k = 0; k < pairs; ++k) {
    const float y = step * (float(k) + 1.0f) + ahead;
    for (const float side : {1.0f, -1.0f}) {
      const float up = (k % 2 == 0) == (side > 0.0f) ? 0.09f : 0.03f;
      leaf.points.emplace_back(side * aside * (1.0f - 0.22f * float(k) / float(pairs)), y, up);
    }
    const auto foot = std::size_t(k), right = std::size_t(pairs) + 1 + 2 * foot;
    add_triangle(leaf, foot, right, foot + 1), add_triangle(leaf, foot, foot + 1, right + 1);
  }
  const std::size_t last = leaf.points.size();
  for (const glm::vec3 point :
       {glm::vec3(-0.02f, 0.8f, 0.02f), glm::vec3(0.02f, 0.8f, 0.02f), glm::vec3(0.0f, 1.0f, 0.02f)})
    leaf.points.push_back(point);
  add_triangle(leaf, last, last + 1, last + 2);
  return leaf;
}

/// Needles that spread from one point, ahead, aside and up.
LeafTemplate fan_of_needles(int needles) {
  const float half_width = 0.26f / float(needles);
  constexpr float spread = 1.25f;  // radians to each side
  LeafTemplate leaf;
  for (int k = 0; k < needles; ++k) {
    const float turn = spread * (2.0f * float(k) / float(needles - 1) - 1.0f);
    const float up = 0.12f + 0.7f * float(k * 3 % needles) / float(needles),
                length = 1.0f - 0.2f * float(k % 3) / 2.0f;
    const glm::vec2 along(std::sin(turn), std::cos(turn)), across(along.y, -along.x);
    const std::size_t first = leaf.points.size();
    leaf.points.emplace_back(-half_width * across, 0.0f), leaf.points.emplace_back(half_width * across, 0.0f);
    leaf.points.emplace_back(length * std::cos(up) * along, length * std::sin(up));
    add_triangle(leaf, first, first + 1, first + 2);
  }
  return leaf;
}

void set_normals(LeafTemplate& leaf) {
  leaf.normals.assign(leaf.points.size(), glm::vec3(0.0f));
  for (std::size_t i = 0; i < leaf.indices.size(); i += 3) {
    const auto corner = [&](std::size_t k) { return leaf.points[leaf.indices[i + k]]; };
    const glm::vec3 area = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
    for (std::size_t k = 0; k < 3; ++k) leaf.normals[leaf.indices[i + k]] += area;
  }
  for (glm::vec3& normal : leaf.normals) normal = glm::normalize(normal);
}

LeafTemplate make_full(LeafForm form) {
  constexpr std::array<Station, 3> ellipse{{{0.2f, 0.165f}, {0.5f, 0.225f}, {0.8f, 0.13f}}};
  constexpr std::array<Station, 7> lobed{{{0.15f, 0.07f},
                                          {0.28f, 0.19f},
                                          {0.37f, 0.11f},
                                          {0.52f, 0.27f},
                                          {0.62f, 0.15f},
                                          {0.76f, 0.24f},
                                          {0.9f, 0.13f}}};
  const Bend bend = bend_of(form);
  LeafTemplate leaf = form == LeafForm::ellipse   ? along_midrib(ellipse, bend)
                      : form == LeafForm::lobed   ? along_midrib(lobed, bend)
                      : form == LeafForm::palmate ? five_lobes(bend)
                      : form == LeafForm::shoot   ? comb_of_needles(11)
                      : form == LeafForm::tuft    ? fan_of_needles(13)
                                                  : strip(bend);
  set_normals(leaf);
  return leaf;
}

/// A few wide needles, which have the area of all.
LeafTemplate few_needles(LeafForm form) {
  LeafTemplate leaf = form == LeafForm::shoot ? comb_of_needles(3) : fan_of_needles(5);
  const float area = full_leaf(form).area();
  const std::vector<glm::vec3> narrow = leaf.points;
  float width = 1.0f;
  for (int i = 0; i < 20; ++i) {
    width *= area / leaf.area();
    for (std::size_t k = 0; k < narrow.size(); ++k) leaf.points[k].x = width * narrow[k].x;
  }
  set_normals(leaf);
  return leaf;
}

/// A rhombus, folded and bent as the leaf is, whose width gives it the leaf's area.
LeafTemplate make_simple(LeafForm form) {
  if (is_needles(form)) return few_needles(form);
  const float area = full_leaf(form).area();
  const Bend bend = bend_of(form);
  LeafTemplate leaf;
  const auto shape = [&](float half_width) {
    const glm::vec2 right(half_width, 0.5f);
    leaf.points = {bent({0.0f, 0.0f}, bend), bent(right, bend), bent({0.0f, 1.0f}, bend),
                   bent({-right.x, right.y}, bend)};
  };
  add_triangle(leaf, 0, 1, 3), add_triangle(leaf, 1, 2, 3);  // no width, no area, however bent
  float half_width = area;
  for (int i = 0; i < 20; ++i) {
    shape(half_width);
    half_width *= area / leaf.area();
  }
  shape(half_width);
  set_normals(leaf);
  return leaf;
}

}  // namespace

float LeafTemplate::area() const {
  float sum = 0.0f;
  for (std::size_t i = 0; i < indices.size(); i += 3)
    sum += 0.5f * glm::length(glm::cross(points[indices[i + 1]] - points[indices[i]],
                                         points[indices[i + 2]] - points[indices[i]]));
  return sum;
}

const LeafTemplate& full_leaf(LeafForm form) {
  static const std::array<LeafTemplate, leaf_form_count> leaves{
      make_full(LeafForm::ellipse), make_full(LeafForm::lobed), make_full(LeafForm::palmate),
      make_full(LeafForm::blade),   make_full(LeafForm::shoot), make_full(LeafForm::tuft)};
  return leaves[std::size_t(form)];
}

const LeafTemplate& simple_leaf(LeafForm form) {
  static const std::array<LeafTemplate, leaf_form_count> leaves{
      make_simple(LeafForm::ellipse), make_simple(LeafForm::lobed), make_simple(LeafForm::palmate),
      make_simple(LeafForm::blade),   make_simple(LeafForm::shoot), make_simple(LeafForm::tuft)};
  return leaves[std::size_t(form)];
}

}  // namespace parvis::vegetation
