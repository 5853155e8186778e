#include "places/paper_city/car_shape.h"

namespace parvis::city {
namespace {

constexpr auto car_glass = CarSurface::glass, black_trim = CarSurface::black, chrome = CarSurface::chrome;
constexpr auto lamp = CarSurface::lamp, tail = CarSurface::tail_lamp, indicator = CarSurface::indicator;

/// A window with its seal: black, then glass inside.
void add_window(std::vector<BodyRegion>& regions, float u0, float u1, float v0, float v1) {
  const float seal_u = 0.05f, seal_v = 0.05f;
  regions.push_back({u0, u1, v0, v1, black_trim});
  regions.push_back({u0 + seal_u, u1 - seal_u, v0 + seal_v, v1 >= 8.0f ? v1 : v1 - seal_v, car_glass});
}

/// A gap between two panels.
void add_gap(std::vector<BodyRegion>& regions, float u, float v0, float v1) {
  regions.push_back({u - 0.008f, u + 0.008f, v0, v1, black_trim});
}

}  // namespace

CarShape saloon_shape() {
  CarShape car;
  car.name = "saloon";
  car.sections = {
      // x, belt, top      half widths        sill  should. belt  edge  top
      {2.27f, 2.21f, 2.13f, 0.00f, 0.00f, 0.00f, 0.22f, 0.60f, 0.66f, 0.71f, 0.74f},
      {2.25f, 2.18f, 2.07f, 0.46f, 0.42f, 0.30f, 0.22f, 0.60f, 0.67f, 0.735f, 0.765f},
      {2.11f, 2.04f, 1.92f, 0.82f, 0.75f, 0.52f, 0.21f, 0.62f, 0.70f, 0.78f, 0.81f},
      {1.86f, 1.82f, 1.74f, 0.885f, 0.80f, 0.60f, 0.20f, 0.68f, 0.77f, 0.83f, 0.86f},
      {1.55f, 1.53f, 1.48f, 0.90f, 0.82f, 0.62f, 0.19f, 0.74f, 0.83f, 0.88f, 0.905f},
      {1.20f, 1.20f, 1.20f, 0.905f, 0.83f, 0.64f, 0.19f, 0.80f, 0.88f, 0.915f, 0.935f},
      {0.85f, 0.90f, 0.95f, 0.905f, 0.83f, 0.66f, 0.19f, 0.84f, 0.915f, 0.945f, 0.96f},
      {0.45f, 0.50f, 0.18f, 0.905f, 0.82f, 0.60f, 0.19f, 0.87f, 0.94f, 1.36f, 1.42f},
      {-0.05f, -0.03f, -0.24f, 0.905f, 0.82f, 0.60f, 0.19f, 0.88f, 0.95f, 1.41f, 1.47f},
      {-0.55f, -0.52f, -0.64f, 0.905f, 0.82f, 0.595f, 0.19f, 0.885f, 0.955f, 1.41f, 1.47f},
      {-1.00f, -0.98f, -1.08f, 0.905f, 0.82f, 0.58f, 0.19f, 0.89f, 0.96f, 1.36f, 1.42f},
      {-1.40f, -1.48f, -1.66f, 0.90f, 0.81f, 0.60f, 0.20f, 0.895f, 0.97f, 1.02f, 1.05f},
      {-1.72f, -1.78f, -1.85f, 0.895f, 0.81f, 0.62f, 0.20f, 0.89f, 0.965f, 1.00f, 1.02f},
      {-1.98f, -2.00f, -2.03f, 0.87f, 0.78f, 0.60f, 0.22f, 0.87f, 0.95f, 0.99f, 1.005f},
      {-2.19f, -2.17f, -2.12f, 0.79f, 0.70f, 0.50f, 0.24f, 0.85f, 0.93f, 0.975f, 0.99f},
      {-2.29f, -2.25f, -2.16f, 0.43f, 0.38f, 0.28f, 0.26f, 0.85f, 0.92f, 0.965f, 0.98f},
      {-2.30f, -2.26f, -2.17f, 0.00f, 0.00f, 0.00f, 0.26f, 0.85f, 0.92f, 0.965f, 0.98f},
  };
  car.regions = {{0.0f, 16.0f, 0.0f, 0.75f, black_trim},  {0.0f, 1.15f, 1.15f, 2.1f, black_trim},
                 {0.0f, 0.72f, 3.05f, 4.35f, chrome},     {0.0f, 0.66f, 3.15f, 4.25f, black_trim},
                 {1.3f, 2.75f, 3.75f, 4.75f, black_trim}, {1.36f, 2.66f, 3.85f, 4.65f, lamp},
                 {13.55f, 14.9f, 3.45f, 4.75f, tail},     {13.55f, 14.3f, 4.3f, 4.5f, indicator}};
  add_window(car.regions, 6.2f, 7.2f, 6.15f, 8.0f);
  add_window(car.regions, 10.15f, 11.1f, 6.15f, 8.0f);
  add_window(car.regions, 6.72f, 8.42f, 5.2f, 5.88f);
  add_window(car.regions, 8.5f, 10.35f, 5.2f, 5.88f);
  for (const float u : {6.85f, 8.46f, 10.2f}) add_gap(car.regions, u, 0.9f, 5.2f);
  car.regions.push_back({0.9f, 6.15f, 5.05f, 5.065f, black_trim});    // bonnet
  car.regions.push_back({11.25f, 14.9f, 5.15f, 5.165f, black_trim});  // boot
  add_gap(car.regions, 14.92f, 2.9f, 5.165f);
  for (const float u : {8.25f, 9.95f}) car.regions.push_back({u - 0.2f, u, 4.25f, 4.4f, chrome});  // handles
  car.front_axle_x = 1.38f, car.rear_axle_x = -1.36f;
  car.mirror = {0.60f, 0.945f, 0.985f};
  car.plate_height = 0.36f;
  return car;
}

CarShape hatchback_shape() {
  CarShape car = saloon_shape();
  car.name = "hatchback";
  car.sections = {
      {1.98f, 1.93f, 1.86f, 0.00f, 0.00f, 0.00f, 0.22f, 0.64f, 0.71f, 0.77f, 0.80f},
      {1.96f, 1.90f, 1.80f, 0.46f, 0.42f, 0.30f, 0.22f, 0.64f, 0.72f, 0.795f, 0.825f},
      {1.83f, 1.77f, 1.66f, 0.80f, 0.73f, 0.52f, 0.21f, 0.66f, 0.75f, 0.84f, 0.87f},
      {1.60f, 1.56f, 1.50f, 0.86f, 0.78f, 0.60f, 0.20f, 0.72f, 0.82f, 0.89f, 0.915f},
      {1.35f, 1.33f, 1.30f, 0.875f, 0.80f, 0.62f, 0.19f, 0.78f, 0.88f, 0.935f, 0.955f},
      {1.10f, 1.10f, 1.12f, 0.88f, 0.81f, 0.64f, 0.19f, 0.83f, 0.92f, 0.965f, 0.985f},
      {0.80f, 0.86f, 0.94f, 0.88f, 0.81f, 0.65f, 0.19f, 0.86f, 0.945f, 0.985f, 1.00f},
      {0.42f, 0.46f, 0.22f, 0.88f, 0.80f, 0.60f, 0.19f, 0.89f, 0.965f, 1.40f, 1.46f},
      {-0.05f, -0.03f, -0.20f, 0.88f, 0.80f, 0.60f, 0.19f, 0.90f, 0.975f, 1.46f, 1.52f},
      {-0.50f, -0.48f, -0.58f, 0.88f, 0.80f, 0.60f, 0.19f, 0.91f, 0.985f, 1.47f, 1.53f},
      {-0.90f, -0.88f, -0.98f, 0.88f, 0.80f, 0.59f, 0.19f, 0.92f, 1.00f, 1.46f, 1.52f},
      {-1.25f, -1.25f, -1.36f, 0.88f, 0.79f, 0.57f, 0.20f, 0.93f, 1.02f, 1.43f, 1.49f},
      {-1.52f, -1.54f, -1.62f, 0.87f, 0.78f, 0.55f, 0.21f, 0.93f, 1.03f, 1.36f, 1.42f},
      {-1.72f, -1.74f, -1.74f, 0.84f, 0.75f, 0.52f, 0.22f, 0.93f, 1.03f, 1.26f, 1.31f},
      {-1.87f, -1.86f, -1.80f, 0.76f, 0.68f, 0.46f, 0.24f, 0.92f, 1.02f, 1.18f, 1.22f},
      {-1.94f, -1.93f, -1.85f, 0.42f, 0.38f, 0.27f, 0.26f, 0.92f, 1.01f, 1.14f, 1.18f},
      {-1.95f, -1.94f, -1.86f, 0.00f, 0.00f, 0.00f, 0.26f, 0.92f, 1.01f, 1.13f, 1.17f},
  };
  car.regions = {{0.0f, 16.0f, 0.0f, 0.85f, black_trim}, {0.0f, 1.2f, 1.15f, 2.3f, black_trim},
                 {0.0f, 0.8f, 3.3f, 4.2f, black_trim},   {1.25f, 2.85f, 3.75f, 4.85f, black_trim},
                 {1.31f, 2.76f, 3.85f, 4.75f, lamp},     {13.3f, 14.6f, 3.5f, 5.0f, tail},
                 {13.3f, 14.6f, 4.0f, 4.3f, indicator}};
  add_window(car.regions, 6.2f, 7.2f, 6.15f, 8.0f);
  add_window(car.regions, 13.0f, 15.0f, 5.6f, 8.0f);
  add_window(car.regions, 6.72f, 8.6f, 5.2f, 5.88f);
  add_window(car.regions, 8.68f, 11.2f, 5.2f, 5.88f);
  for (const float u : {6.85f, 8.64f, 10.3f}) add_gap(car.regions, u, 0.9f, 5.2f);
  car.regions.push_back({0.9f, 6.15f, 5.05f, 5.065f, black_trim});  // bonnet
  add_gap(car.regions, 14.7f, 1.7f, 5.55f);                         // tailgate
  for (const float u : {8.45f, 10.1f}) car.regions.push_back({u - 0.2f, u, 4.25f, 4.4f, black_trim});
  car.front_axle_x = 1.22f, car.rear_axle_x = -1.24f;
  car.wheel_radius = 0.31f, car.arch_radius = 0.37f, car.half_track = 0.745f;
  car.mirror = {0.58f, 0.93f, 1.02f};
  return car;
}

CarShape van_shape() {
  CarShape car;
  car.name = "van";
  car.sections = {
      {2.50f, 2.42f, 2.30f, 0.00f, 0.00f, 0.00f, 0.26f, 0.80f, 0.92f, 1.00f, 1.04f},
      {2.48f, 2.39f, 2.24f, 0.52f, 0.48f, 0.36f, 0.26f, 0.80f, 0.93f, 1.02f, 1.06f},
      {2.33f, 2.25f, 2.10f, 0.89f, 0.83f, 0.62f, 0.25f, 0.83f, 0.96f, 1.07f, 1.11f},
      {2.08f, 2.02f, 1.95f, 0.955f, 0.88f, 0.68f, 0.25f, 0.88f, 1.02f, 1.12f, 1.16f},
      {1.80f, 1.78f, 1.78f, 0.97f, 0.90f, 0.72f, 0.24f, 0.94f, 1.08f, 1.17f, 1.20f},
      {1.45f, 1.45f, 1.12f, 0.975f, 0.91f, 0.74f, 0.24f, 0.98f, 1.12f, 1.72f, 1.78f},
      {1.10f, 1.10f, 0.78f, 0.975f, 0.915f, 0.77f, 0.24f, 1.00f, 1.14f, 1.88f, 1.95f},
      {0.60f, 0.60f, 0.50f, 0.975f, 0.92f, 0.79f, 0.24f, 1.00f, 1.14f, 1.90f, 1.98f},
      {0.10f, 0.10f, 0.08f, 0.975f, 0.925f, 0.80f, 0.24f, 1.00f, 1.14f, 1.90f, 1.98f},
      {-0.40f, -0.40f, -0.40f, 0.975f, 0.93f, 0.81f, 0.24f, 1.00f, 1.14f, 1.90f, 1.98f},
      {-0.90f, -0.90f, -0.90f, 0.975f, 0.93f, 0.81f, 0.24f, 1.00f, 1.14f, 1.90f, 1.98f},
      {-1.40f, -1.40f, -1.40f, 0.975f, 0.93f, 0.81f, 0.24f, 1.00f, 1.14f, 1.90f, 1.98f},
      {-1.85f, -1.85f, -1.84f, 0.975f, 0.93f, 0.81f, 0.24f, 1.00f, 1.14f, 1.90f, 1.98f},
      {-2.20f, -2.20f, -2.15f, 0.965f, 0.92f, 0.80f, 0.25f, 1.00f, 1.14f, 1.88f, 1.96f},
      {-2.38f, -2.37f, -2.28f, 0.90f, 0.86f, 0.72f, 0.27f, 1.00f, 1.14f, 1.86f, 1.94f},
      {-2.42f, -2.41f, -2.32f, 0.46f, 0.44f, 0.36f, 0.28f, 1.00f, 1.14f, 1.85f, 1.93f},
      {-2.42f, -2.41f, -2.32f, 0.00f, 0.00f, 0.00f, 0.28f, 1.00f, 1.14f, 1.85f, 1.93f},
  };
  car.regions = {{0.0f, 16.0f, 0.0f, 0.9f, black_trim}, {0.0f, 1.9f, 0.9f, 1.7f, black_trim},
                 {0.0f, 1.1f, 2.6f, 4.1f, black_trim},  {1.2f, 2.8f, 3.55f, 4.85f, black_trim},
                 {1.27f, 2.7f, 3.65f, 4.75f, lamp},     {13.35f, 14.2f, 2.9f, 5.3f, tail},
                 {13.35f, 14.2f, 3.9f, 4.3f, indicator}};
  add_window(car.regions, 4.15f, 5.5f, 6.15f, 8.0f);
  add_window(car.regions, 4.85f, 7.1f, 5.15f, 5.88f);
  add_window(car.regions, 14.75f, 15.9f, 5.2f, 5.85f);
  for (const float u : {4.75f, 7.2f, 10.2f, 15.95f}) add_gap(car.regions, u, 1.0f, 5.95f);
  for (const float u : {7.0f, 7.65f}) car.regions.push_back({u - 0.25f, u, 4.2f, 4.35f, black_trim});
  car.front_axle_x = 1.62f, car.rear_axle_x = -1.42f;
  car.wheel_radius = 0.34f, car.arch_radius = 0.41f, car.half_track = 0.83f, car.wheel_width = 0.22f;
  car.mirror = {1.22f, 1.06f, 1.24f}, car.mirror_radii = {0.09f, 0.12f, 0.15f};
  car.plate_height = 0.5f;
  return car;
}

CarShape bus_shape() {
  CarShape car;
  car.name = "bus";
  // A small city bus: a long one would need both lanes of these streets to turn.
  constexpr float shortened = 0.74f;
  const auto section = [](float x, float top_inset, float half, float top_half) {
    BodySection s;
    s.x = s.x_belt = shortened * x, s.x_top = s.x - top_inset;
    s.half_width = half, s.half_belt = half, s.half_top = top_half;
    s.sill = 0.28f, s.shoulder = 0.9f, s.belt = 1.2f, s.edge = 2.98f, s.top = 3.08f;
    return s;
  };
  car.sections = {section(5.75f, 0.22f, 0.0f, 0.0f), section(5.73f, 0.22f, 0.75f, 0.66f),
                  section(5.58f, 0.2f, 1.2f, 1.06f)};
  for (const float x : {5.2f, 4.5f, 3.6f, 2.5f, 1.3f, 0.1f, -1.1f, -2.3f, -3.4f, -4.3f, -5.0f})
    car.sections.push_back(section(x, 0.0f, 1.26f, 1.17f));
  car.sections.push_back(section(-5.42f, -0.06f, 1.2f, 1.06f));
  car.sections.push_back(section(-5.5f, -0.08f, 0.75f, 0.66f));
  car.sections.push_back(section(-5.5f, -0.08f, 0.0f, 0.0f));
  car.regions = {{0.0f, 16.0f, 0.0f, 0.7f, black_trim}, {0.0f, 1.2f, 1.0f, 2.0f, black_trim},
                 {1.3f, 2.3f, 2.2f, 3.2f, black_trim},  {1.36f, 2.2f, 2.3f, 3.1f, lamp},
                 {14.15f, 14.75f, 2.0f, 4.0f, tail},    {14.15f, 14.75f, 2.8f, 3.2f, indicator},
                 {0.0f, 2.1f, 6.0f, 6.35f, black_trim}};  // the destination board
  add_window(car.regions, 0.0f, 2.5f, 4.75f, 5.95f);
  add_window(car.regions, 14.6f, 16.0f, 5.2f, 5.9f);
  for (int i = 0; i < 11; ++i) {
    const float u = 2.75f + float(i);
    add_window(car.regions, u, u + 0.96f, 5.0f, 5.85f);
  }
  for (const float u : {3.2f, 7.4f}) {
    add_gap(car.regions, u, 0.8f, 5.9f);
    add_gap(car.regions, u + 0.9f, 0.8f, 5.9f);
  }
  car.front_axle_x = 2.35f, car.rear_axle_x = -2.1f;
  car.wheel_radius = 0.48f, car.arch_radius = 0.56f, car.half_track = 1.08f, car.wheel_width = 0.28f;
  car.mirror = {4.12f, 1.36f, 2.2f}, car.mirror_radii = {0.07f, 0.1f, 0.2f};
  car.plate_height = 0.55f;
  return car;
}

}  // namespace parvis::city
