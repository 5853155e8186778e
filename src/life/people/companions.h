// What accompanies somebody: a pram that is pushed, a wheelchair that is sat in, a dog on a leash.
#pragma once

#include "life/people/gait.h"
#include "scene/data/model.h"

namespace parvis::people {

enum class Companion : std::uint8_t { none, pram, wheelchair, dog };

/// Height of a wheelchair's footrests, by which who sits in one is lifted, metres.
inline constexpr float footrest_m = 0.08f;

/// The model of what accompanies a person of this body, in the person's frame (x forward, y left, the ground
/// at z = 0), rigid; wheels are nodes whose names hold "wheel". `number`: another one, other colours. Null
/// for `none`.
std::shared_ptr<const scene::Model> companion_model(Companion companion, const BodyField& body,
                                                    std::uint64_t number);

}  // namespace parvis::people
