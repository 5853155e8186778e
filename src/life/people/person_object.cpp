#include "life/people/person_object.h"

#include <algorithm>

#include "scene/data/object_animation.h"

namespace parvis::people {

Someone someone_of(const PersonRequest& request) {
  const Someone drawn = someone(request.seed);
  return someone(request.seed, request.sex.value_or(drawn.person.sex),
                 request.age.value_or(drawn.person.age));
}

scene::Object person_object(const PersonRequest& request, scene::SceneBuilder& builder) {
  const std::uint64_t seed = request.seed;
  const Someone who = someone_of(request);
  const std::string key = fmt::format("person {} {} {} {} {}", seed, int(who.person.sex), who.head.age,
                                      request.speed_m_s, request.holds_handle);
  scene::Object object;
  object.model = builder.shared_model(key, [&] {
    return make_person(who, colours_of(who, seed), request.speed_m_s, request.holds_handle).model;
  });
  const std::vector<scene::Animation>& animations = object.model->animations;
  const auto found = std::ranges::find(animations, request.does, &scene::Animation::name);
  const int animation = int(found - animations.begin());
  scene::play(object, {animation, request.is_still ? 0.0f : 1.0f, double(seed % 97) * 0.37});
  return object;
}

}  // namespace parvis::people
