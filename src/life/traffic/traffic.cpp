#include "life/traffic/traffic.h"

#include <algorithm>
#include <cassert>

#include "base/parallel.h"
#include "life/traffic/signal_masts.h"
#include "scene/data/object_animation.h"

namespace parvis::traffic {

namespace {

constexpr int warm_up_steps = 12 * 60;  // all start at rest: nobody wants to see that

std::vector<VehicleShape> shapes_of(const TrafficDemand& demand) {
  std::vector<VehicleShape> shapes;
  for (const auto& model : demand.models)
    if (model != nullptr && !scene::bounds(*model).empty()) shapes.push_back(vehicle_shape(model));
  return shapes;
}

}  // namespace

Traffic::Traffic(const scene::Scene& scene, std::span<const scene::StreetCrossing> crossings) {
  const TrafficDemand& demand = scene.data<TrafficDemand>();
  const scene::DrivingArea& area = scene.data<scene::DrivingArea>();
  std::vector<VehicleShape> shapes = shapes_of(demand);
  const bool has_models = !shapes.empty();
  constexpr int max_riders = 12;  // others share their bodies
  const int riders = std::min(demand.bicycles, max_riders);
  std::vector<VehicleShape> bicycles(std::size_t(std::max(riders, 0)));
  parallel_for(bicycles.size(), [&](std::size_t i) { bicycles[i] = bicycle_shape(demand.seed * 131u + i); });
  for (VehicleShape& bicycle : bicycles) shapes.push_back(std::move(bicycle));
  simulation_ =
      std::make_unique<Simulation>(scene.roads, std::move(shapes), Area{area.centre, area.radius_m});
  std::vector<SignalJunction> junctions;
  for (const SignalDemand& lights : scene.items<SignalDemand>()) {
    Result<SignalJunction> junction = signals_at(scene.roads, crossings, lights);
    if (!junction || std::ranges::count(junctions, junction->junction, &SignalJunction::junction) > 0)
      continue;
    junctions.push_back(*std::move(junction));
    junction_visible_.push_back(lights.is_visible);
  }
  simulation_->set_signals(Signals(std::move(junctions), scene.roads, crossings.size()));
  const std::size_t motors = has_models ? std::size_t(std::max(demand.vehicles, 0)) : 0;
  if (demand.vehicles <= 0 && bicycles.empty()) return;
  if (demand.vehicles > 0 && !has_models && !scene.roads.empty())
    warnings_.push_back("traffic: no vehicle has a model, so none drives; name at least one model");
  if (scene.roads.empty()) {
    warnings_.push_back("traffic: the scene has no roads, so no vehicle drives; add road(path=...) nodes");
  } else if (motors + bicycles.size() > 0) {
    const std::size_t wanted = motors + std::size_t(std::max(demand.bicycles, 0));
    const std::size_t found =
        simulation_->spread_vehicles(motors, demand.seed, std::size_t(std::max(demand.bicycles, 0)));
    if (found < wanted)
      warnings_.push_back(fmt::format(
          "traffic: room for {} of {} vehicles; more, longer or wider roads that lead on, smaller "
          "vehicles, or a larger radius give more",
          found, wanted));
  }
  add_bus_stops(scene);
  for (int i = 0; i < warm_up_steps; ++i) simulation_->step();
}

void Traffic::add_bus_stops(const scene::Scene& scene) {
  const VehicleShape* longest = nullptr;
  for (const Vehicle& vehicle : simulation_->vehicles())
    if (is_bus(*vehicle.shape) && (!longest || vehicle.length_m() > longest->length_m()))
      longest = vehicle.shape;
  const std::vector<BusStopDemand>& demands = scene.items<BusStopDemand>();
  if (!longest || demands.empty()) return;
  std::vector<BusStop> stops;
  for (const BusStopDemand& demand : demands)
    if (const std::optional<BusStop> stop = bus_stop_at(simulation_->lanes(), demand, longest->length_m())) {
      stops.push_back(*stop);
      stops_->push_back(transit_stop(*stop, *longest));
    } else {
      warnings_.push_back(
          fmt::format("busStop: no bus can halt at {:.1f} {:.1f}: a lane must lead past it, at its "
                      "left, with {:.0f} m of street before it",
                      demand.position.x, demand.position.y, longest->length_m() + 1.0f));
    }
  simulation_->set_bus_stops(std::move(stops), stops_);
}

void Traffic::add_vehicles(scene::Scene& scene) {
  first_object_ = scene.objects.size();
  for (const Vehicle& vehicle : simulation_->vehicles()) {
    scene::Object object;
    object.name = vehicle_name(scene.objects.size() - first_object_);
    object.model = vehicle.shape->model;
    object.pose = vehicle.shape->rest_pose;
    object.is_dynamic = true;
    object.takes_reflection = true;
    if (vehicle.shape->rider) scene::play(object, {}), object.pose = vehicle.shape->rest_pose;
    scene.objects.push_back(std::move(object));
  }
  place(scene, 0.0);
}

void Traffic::add_lamps(scene::Scene& scene) {
  const std::vector<SignalJunction>& junctions = simulation_->signals().junctions();
  const auto add = [&](Lamps lamps, std::shared_ptr<const scene::Model> model) {
    if (model->parts.empty()) return;
    lamps.object = scene.objects.size(), lamps.is_visible = junction_visible_[lamps.junction];
    scene::Object object;
    object.name = "traffic lamps", object.model = std::move(model);
    object.is_dynamic = true, object.is_visible = false;
    scene.objects.push_back(std::move(object));
    lamps_.push_back(lamps);
  };
  for (std::size_t j = 0; j < junctions.size(); ++j) {
    for (int phase = 0; phase < junctions[j].phases; ++phase)
      for (const DriveLight light : {DriveLight::red, DriveLight::yellow, DriveLight::green})
        add({.junction = j, .phase = phase, .drive = light}, lit_drive_lamps(junctions[j], phase, light));
    for (int phase = -1; phase < junctions[j].phases; ++phase) {
      const auto walk = std::ranges::find(junctions[j].walks, phase, &SignalWalk::phase);
      if (walk == junctions[j].walks.end()) continue;
      for (const scene::WalkLight light : {scene::WalkLight::walk, scene::WalkLight::wait})
        add({.junction = j, .phase = phase, .is_for_people = true, .walk = light, .crossing = walk->crossing},
            lit_walk_lamps(junctions[j], phase, light));
    }
  }
  place(scene, 0.0);
}

bool Traffic::is_lit(const Lamps& lamps) const {
  const Signals& signals = simulation_->signals();
  return lamps.is_for_people ? signals.walk_lights()[std::size_t(lamps.crossing)] == lamps.walk
                             : signals.light(lamps.junction, lamps.phase) == lamps.drive;
}

void Traffic::place(scene::Scene& scene, double ahead_s) const {
  const std::vector<Vehicle>& vehicles = simulation_->vehicles();
  const std::vector<DrivingLane>& lanes = simulation_->lanes();
  assert(scene.objects.size() >= first_object_ + vehicles.size());
  const bool is_visible = std::as_const(scene).data<TrafficDemand>().is_visible;
  for (const Lamps& lamps : lamps_)
    scene.objects[lamps.object].is_visible = lamps.is_visible && is_lit(lamps);
  const float missing = 1.0f - std::min(float(ahead_s / double(step_s)), 1.0f);
  for (std::size_t i = 0; i < vehicles.size(); ++i) {
    const Vehicle& vehicle = vehicles[i];
    scene::Object& object = scene.objects[first_object_ + i];
    const float back_m = missing * vehicle.last_move_m;
    object.is_visible = is_visible;
    object.world_from_model =
        vehicle.shape->world_from_model(vehicle.rear_axle(back_m, lanes), vehicle.front_axle(back_m, lanes));
    vehicle.shape->set_pose(vehicle.travelled_m - double(back_m), vehicle.steering(back_m, lanes),
                            object.pose);
    if (vehicle.shape->rider)
      vehicle.shape->rider->ride(vehicle.travelled_m - double(back_m), object.pose, object.deformed_meshes);
  }
}

}  // namespace parvis::traffic
