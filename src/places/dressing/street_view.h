// Where a person would stand to see a place: on a street, with houses on both sides and a long view.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "land/heights/place_heights.h"

namespace parvis::dressing {

/// A place to look from, in the world.
struct View {
  glm::vec3 eye, target;
};

/// The view from eye height on the carriageways of `roads`, or without roads from open ground, that shows
/// most: long, with buildings on both sides, not against a sun in the south-west. From outside where
/// everything is built.
View street_view(const scene::Scene& scene, const scene::PlaceHeights& place,
                 std::span<const scene::Road> roads);

/// A view of a house or a thing that stands alone, from its sunny side, so far away that it is seen whole.
View outside_view(const scene::Scene& scene, const scene::PlaceHeights& place);

/// A view of land on which nothing stands, from so high above its sunny side that all of it is seen.
View land_view(const scene::Scene& scene);

/// A view of that land as a person sees it who stands on it, in its sunny half.
View view_on_land(const scene::Scene& scene, const scene::PlaceHeights& place);

/// A view from above the surroundings of `street` (130 m around), or the whole place where it is smaller,
/// from its foot to its top.
View overview(const scene::Scene& scene, const scene::PlaceHeights& place, const View& street);

/// Carriageways that a model has as surfaces ("Road"), as centre lines; empty where it has none.
std::vector<scene::Road> road_surfaces(const scene::Model& model);

}  // namespace parvis::dressing
