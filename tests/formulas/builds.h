// The builds of the formulas as what a check asks for: one call over arrays.
#pragma once

#include <string>
#include <vector>

#include "cpu/targets.h"
#include "tests/formulas/checks/check.h"

namespace airlight {

Columns run_double(const Calls&);
Columns run_float(const Calls&);
Columns run_simd(const Calls&, Simd);
// On Mesa's llvmpipe, by OSMesa: there on every machine that the tests run on.
Columns run_glsl(const Calls&);
std::string glsl_renderer();

}  // namespace airlight
