// The text of --explain.
#pragma once

#include <functional>
#include <string>

#include "app/airlight.h"
#include "common/techniques/technique.h"

namespace airlight {

using MakePlan = std::function<Plan(const Technique&, const Scene&, const FrameRequest&)>;
using Held = std::function<bool(Handle, std::uint64_t key)>;

// Technique, knobs, the steps of the plan as a tree with those that what is held spares, and what is left out. Throws InputError
// as rendering would.
std::string explained(const Scene&, const RenderSettings& asked, const RendererOptions&, const MakePlan&, const Held&);

}  // namespace airlight
