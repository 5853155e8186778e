#include "viewer/overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "life/vegetation/scene_plant.h"

namespace parvis::viewer {

/// Draws points of the world in the picture.
struct Overlay::Pen {
  ImDrawList* list;
  ImVec2 size;
  float scale;
  glm::mat4 clip_from_world;

  std::optional<ImVec2> at(glm::vec3 p) const {
    const glm::vec4 clip = clip_from_world * glm::vec4(p, 1.0f);
    if (clip.w < 1e-3f) return std::nullopt;
    return ImVec2((0.5f * clip.x / clip.w + 0.5f) * size.x, (0.5f - 0.5f * clip.y / clip.w) * size.y);
  }
  void line(glm::vec3 a, glm::vec3 b, ImU32 colour, float width) const {
    const std::optional<ImVec2> from = at(a), to = at(b);
    if (from && to) list->AddLine(*from, *to, colour, width * scale);
  }
  void dashes(glm::vec3 a, glm::vec3 b, ImU32 colour) const {
    const std::optional<ImVec2> from = at(a), to = at(b);
    if (!from || !to) return;
    const glm::vec2 start(from->x, from->y), way = glm::vec2(to->x, to->y) - start;
    const float step = 9.0f * scale, length = std::min(glm::length(way), 4000.0f);
    if (length < 1.0f) return;
    const glm::vec2 along = glm::normalize(way);
    for (float t = 0.0f; t < length; t += step) {
      const glm::vec2 p = start + t * along, q = start + std::min(t + 0.55f * step, length) * along;
      list->AddLine({p.x, p.y}, {q.x, q.y}, colour, 1.2f * scale);
    }
  }
  /// Text on a dark ground, about its middle.
  void label(ImVec2 middle, const std::string& text) const {
    const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
    const ImVec2 low(middle.x - 0.5f * extent.x, middle.y - 0.5f * extent.y);
    const float margin = 4.0f * scale;
    list->AddRectFilled({low.x - margin, low.y - margin},
                        {low.x + extent.x + margin, low.y + extent.y + margin}, IM_COL32(20, 22, 26, 215),
                        4.0f * scale);
    list->AddText(low, IM_COL32(245, 240, 232, 255), text.c_str());
  }
};

namespace {

constexpr ImU32 chosen_ink = IM_COL32(240, 170, 84, 255), pointed_ink = IM_COL32(255, 255, 255, 210),
                refused = IM_COL32(232, 64, 48, 255), guide = IM_COL32(120, 205, 255, 235),
                shade = IM_COL32(10, 12, 14, 150);

/// The convex hull of points in the picture, in order.
std::vector<ImVec2> hull(std::vector<ImVec2> points) {
  std::ranges::sort(points, [](ImVec2 a, ImVec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  const auto turns_left = [](ImVec2 a, ImVec2 b, ImVec2 c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) > 0.0f;
  };
  std::vector<ImVec2> around;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t start = around.size();
    for (const ImVec2 p : points) {
      while (around.size() >= start + 2 && !turns_left(around[around.size() - 2], around.back(), p))
        around.pop_back();
      around.push_back(p);
    }
    around.pop_back();
    std::ranges::reverse(points);
  }
  return around;
}

void draw_mark(ImDrawList& list, ImVec2 at, planner::SnapKind kind, float scale) {
  const float r = 5.0f * scale, w = 1.8f * scale;
  switch (kind) {
    case planner::SnapKind::end:
      list.AddCircleFilled(at, r, guide);
      break;
    case planner::SnapKind::crossing:
      list.AddLine({at.x - r, at.y - r}, {at.x + r, at.y + r}, guide, w);
      list.AddLine({at.x - r, at.y + r}, {at.x + r, at.y - r}, guide, w);
      break;
    case planner::SnapKind::right_angle:
      list.AddRect({at.x - r, at.y - r}, {at.x + r, at.y + r}, guide, 0.0f, 0, w);
      break;
    case planner::SnapKind::spacing:
      for (const float x : {-r, 0.0f, r}) list.AddLine({at.x + x, at.y - r}, {at.x + x, at.y + r}, guide, w);
      break;
    case planner::SnapKind::line:
      list.AddCircle(at, r, guide, 0, w);
      break;
    case planner::SnapKind::grid:
    case planner::SnapKind::none:
      break;
  }
}

/// A round length that takes about a fifth of the picture.
float scale_bar_m(float metres) {
  const float power = std::pow(10.0f, std::floor(std::log10(metres)));
  for (const float step : {5.0f, 2.0f, 1.0f})
    if (step * power <= metres) return step * power;
  return power;
}

void draw_scale(ImDrawList& list, const Camera& camera, ImVec2 size, float scale, float foot) {
  const float metres_per_unit = camera.parallel->height_m / size.y;
  const float bar_m = scale_bar_m(0.2f * size.x * metres_per_unit), length = bar_m / metres_per_unit;
  const ImVec2 low(64.0f * scale, foot - 16.0f * scale);
  list.AddRectFilled({low.x - 10 * scale, low.y - 26 * scale},
                     {low.x + length + 44 * scale, low.y + 10 * scale}, shade, 4 * scale);
  for (int part = 0; part < 4; ++part) {
    const float x = low.x + 0.25f * length * float(part);
    list.AddRectFilled({x, low.y - 5 * scale}, {x + 0.25f * length, low.y},
                       part % 2 == 0 ? IM_COL32(245, 245, 245, 255) : IM_COL32(60, 62, 66, 255));
  }
  list.AddText({low.x, low.y - 23 * scale}, IM_COL32(245, 245, 245, 255), "0");
  const std::string text = fmt::format("{:g} m", double(bar_m));
  list.AddText({low.x + length - 0.5f * ImGui::CalcTextSize(text.c_str()).x, low.y - 23 * scale},
               IM_COL32(245, 245, 245, 255), text.c_str());
  // North is up.
  const ImVec2 north(low.x + length + 30 * scale, low.y - 9 * scale);
  list.AddTriangleFilled({north.x, north.y - 13 * scale}, {north.x + 5 * scale, north.y + 6 * scale},
                         {north.x - 5 * scale, north.y + 6 * scale}, IM_COL32(245, 245, 245, 255));
  list.AddText({north.x - 4 * scale, north.y + 4 * scale}, IM_COL32(245, 245, 245, 255), "N");
}

}  // namespace

const std::vector<glm::vec3>& Overlay::extremes(const std::shared_ptr<const scene::Model>& model) {
  std::vector<glm::vec3>& points = extremes_[model];
  if (!points.empty()) return points;
  constexpr int directions = 96;  // spread over the sphere along a spiral
  std::vector<glm::vec3> axes, best(directions);
  std::vector<float> reach(directions, -1e30f);
  const std::vector<glm::mat4> pose = scene::rest_pose(*model);
  for (int i = 0; i < directions; ++i) {
    const float z = 1.0f - 2.0f * (float(i) + 0.5f) / directions, r = std::sqrt(1.0f - z * z),
                a = 2.399963f * float(i);
    axes.emplace_back(r * std::cos(a), r * std::sin(a), z);
  }
  for (const scene::Part& part : model->parts)
    for (const glm::vec3& corner : part.mesh.positions) {
      const glm::vec3 p(pose[std::size_t(part.node)] * glm::vec4(corner, 1.0f));
      for (std::size_t i = 0; i < directions; ++i)
        if (const float along = glm::dot(axes[i], p); along > reach[i]) reach[i] = along, best[i] = p;
    }
  return points = std::move(best);
}

void Overlay::draw_outline(const Pen& pen, const scene::Object& object, ImU32 colour, float width) {
  std::vector<ImVec2> points;
  for (const glm::vec3& p : extremes(object.model)) {
    const std::optional<ImVec2> at = pen.at(glm::vec3(object.world_from_model * glm::vec4(p, 1.0f)));
    if (!at) return;
    points.push_back(*at);
  }
  const std::vector<ImVec2> around = hull(std::move(points));
  if (around.size() > 2)
    pen.list->AddPolyline(around.data(), int(around.size()), colour, ImDrawFlags_Closed, width * pen.scale);
}

/// The plan of an object, at its foot and its top.
void Overlay::draw_prism(const Pen& pen, const design::PlacedObject& object, ImU32 colour, float width) {
  const float low = float(object.position.z), high = low + float(object.size_m.z);
  const std::size_t count = object.outline.size();
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec2 a(object.outline[i]), b(object.outline[(i + 1) % count]);
    pen.line(glm::vec3(a, low), glm::vec3(b, low), colour, width);
    if (object.kind == "ground") continue;
    pen.line(glm::vec3(a, high), glm::vec3(b, high), colour, width);
    if (i % std::max<std::size_t>(count / 4, 1) == 0)
      pen.line(glm::vec3(a, low), glm::vec3(a, high), colour, 0.5f * width);
  }
}

/// Outlines an object of the design: its models, or, of a plant or a surface, its plan.
void Overlay::draw_named(Planning& planning, const Pen& pen, const std::string& name, ImU32 colour,
                         float width) {
  const scene::LiveScene& live = planning.visit().live();
  const scene::Node* node = live.find(name);
  if (!node || node->schema->type == design::measured_type) return;
  const scene::Scene& scene = planning.visit().scene();
  const design::PlacedObject object = design::placed_object(scene, *node, "");
  const std::vector<int> made = live.objects_of(*node);
  if (node->schema->type == design::placed_type)
    for (const int i : made)
      if (scene.objects[std::size_t(i)].is_visible)
        draw_outline(pen, scene.objects[std::size_t(i)], colour, width);
  if (node->schema->type == design::placed_type && !made.empty()) return;
  draw_prism(pen, object, colour, width);
}

/// Added in green, removed in red, moved in blue with the way, changed in yellow.
void Overlay::draw_differences(const Planning& planning, const Pen& pen) {
  constexpr std::array colours{IM_COL32(96, 210, 110, 255), IM_COL32(235, 72, 60, 255),
                               IM_COL32(96, 170, 255, 255), IM_COL32(240, 210, 90, 255)};
  for (const design::Difference& each : planning.differences()) {
    const ImU32 colour = colours[std::size_t(each.how)];
    draw_prism(pen, each.shown(), colour, 2.0f);
    if (each.how != design::Differs::moved) continue;
    draw_prism(pen, each.before, IM_COL32(96, 170, 255, 120), 1.5f);
    pen.dashes(each.before.position, each.after.position, colour);
  }
}

/// The line between the pictures of two designs, with their names.
void Overlay::draw_split(const Planning& planning, const Pen& pen) {
  constexpr ImU32 white = IM_COL32(255, 255, 255, 230);
  const float x = planning.split() * pen.size.x, top = 58.0f * pen.scale;
  pen.list->AddLine({x, 0.0f}, {x, pen.size.y}, white, 2.0f * pen.scale);
  const bool is_slider = planning.compared_view() == ComparedView::slider;
  if (is_slider) {
    const float r = 9.0f * pen.scale, middle = 0.5f * pen.size.y;
    pen.list->AddCircleFilled({x, middle}, 1.6f * r, white);
    for (const float side : {-1.0f, 1.0f})
      pen.list->AddTriangleFilled({x + side * r, middle}, {x + side * 0.35f * r, middle - 0.5f * r},
                                  {x + side * 0.35f * r, middle + 0.5f * r}, IM_COL32(40, 42, 46, 255));
  }
  const std::string before = planning.compared(), after = planning.open_name();
  const float gap = 14.0f * pen.scale;
  pen.label({x - gap - 0.5f * ImGui::CalcTextSize(before.c_str()).x, top}, before);
  pen.label({x + gap + 0.5f * ImGui::CalcTextSize(after.c_str()).x, top}, after);
}

/// Those of the open design as the pointer holds them, and those of other designs that are shown.
void Overlay::draw_measurements(Planning& planning, const Pen& pen) {
  constexpr ImU32 measured = IM_COL32(255, 120, 190, 255);
  const planner::Tool& tool = *planning.tool();
  const design::Session& session = *planning.session();
  std::vector<design::Measurement> all = design::measurements(planning.visit().live(), "", true);
  std::erase_if(all, [&](const design::Measurement& each) { return each.design == session.name(); });
  std::ranges::move(tool.measurements(), std::back_inserter(all));
  for (const design::Measurement& each : all) {
    const bool is_lit =
        each.design == session.name() && !each.name.empty() &&
        (each.name == tool.pointed() || std::ranges::count(session.selected(), each.name) > 0);
    const ImU32 colour = is_lit ? chosen_ink : measured;
    const std::vector<glm::dvec3> line = each.line();
    const bool is_height = each.quantity == design::Quantity::height;
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      if (is_height && i == 0)
        pen.dashes(line[i], line[i + 1], colour);
      else
        pen.line(line[i], line[i + 1], colour, is_lit ? 2.5f : 1.8f);
    for (const glm::dvec3& point : each.points)
      if (const auto at = pen.at(point))
        pen.list->AddCircleFilled(*at, (is_lit ? 5.0f : 3.5f) * pen.scale, colour);
    if (!design::check_measurement(each.quantity, each.points)) continue;  // not all clicked yet
    if (const auto at = pen.at(each.middle())) pen.label(*at, each.text());
  }
}

void Overlay::draw_held(Planning& planning, const Pen& pen) {
  const planner::Tool& tool = *planning.tool();
  const ImU32 colour = tool.refusal().empty() ? chosen_ink : refused;
  for (const scene::Object& object : tool.preview().scene().objects)
    if (object.is_visible) draw_outline(pen, object, colour, 2.0f);
  const planner::Snapped& snapped = tool.snapped();
  const auto height = float(tool.snapped_height_m());
  for (const planner::PlanSegment& line : snapped.guides)
    pen.dashes(glm::vec3(glm::vec2(line[0]), height), glm::vec3(glm::vec2(line[1]), height), guide);
  if (snapped.kind == planner::SnapKind::none) return;
  if (const std::optional<ImVec2> at = pen.at(glm::vec3(glm::vec2(snapped.at), height)))
    draw_mark(*pen.list, *at, snapped.kind, pen.scale);
}

void Overlay::draw(Planning& planning, ImVec2 size, float scale) {
  if (!planning.is_on()) return;
  const Camera camera = planning.visit().camera();
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  const Pen pen{list, size, scale, camera.clip_from_camera(size.x / size.y) * camera.camera_from_world()};
  list->PushClipRect({0.0f, 0.0f}, size);
  if (planning.compares_pictures()) draw_split(planning, pen);
  if (planning.compares_pictures() && planning.compared_view() == ComparedView::side_by_side)
    return list->PopClipRect();
  // Left of the slider's line stands the other design: nothing there belongs to this one.
  const float from = planning.compares_pictures() ? planning.split() * size.x : 0.0f;
  list->PushClipRect({from, 0.0f}, size, true);
  const planner::Tool& tool = *planning.tool();
  const bool moves = tool.action() == planner::Action::move || tool.action() == planner::Action::turn ||
                     tool.action() == planner::Action::resize;
  if (!moves)
    for (const std::string& name : planning.session()->selected())
      draw_named(planning, pen, name, chosen_ink, 2.0f);
  if (!tool.pointed().empty() && std::ranges::count(planning.session()->selected(), tool.pointed()) == 0)
    draw_named(planning, pen, tool.pointed(), pointed_ink, 1.5f);
  if (!planning.compares_pictures()) draw_differences(planning, pen);
  draw_measurements(planning, pen);
  draw_held(planning, pen);
  const std::vector<glm::dvec3> corners = tool.corners();
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) pen.line(corners[i], corners[i + 1], chosen_ink, 2.0f);
  if (corners.size() > 2) pen.dashes(corners.back(), corners.front(), chosen_ink);
  for (const planner::Dimension& dimension : tool.dimensions()) {
    pen.line(dimension.from, dimension.to, guide, 1.5f);
    if (const auto at = pen.at(0.5 * (dimension.from + dimension.to)))
      pen.label(*at, fmt::format("{:.2f} m", dimension.length_m()));
  }
  if (const auto box = tool.box()) {
    const float unit = ImGui::GetIO().DisplayFramebufferScale.x;
    const ImVec2 a(float((*box)[0].x) / unit, float((*box)[0].y) / unit),
        b(float((*box)[1].x) / unit, float((*box)[1].y) / unit);
    const ImVec2 low(std::min(a.x, b.x), std::min(a.y, b.y)), high(std::max(a.x, b.x), std::max(a.y, b.y));
    list->AddRectFilled(low, high, IM_COL32(240, 170, 84, 40));
    list->AddRect(low, high, chosen_ink, 0.0f, 0, scale);
  }
  list->PopClipRect();
  if (camera.parallel) draw_scale(*list, camera, size, scale, size.y - 40.0f * scale);
  list->PopClipRect();
}

}  // namespace parvis::viewer
