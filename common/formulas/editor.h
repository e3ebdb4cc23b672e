// What an editor reads before a formula file (.clangd in the root): the double build without that file.
#pragma once

#include "common/formulas/double.h"

#define FORMULA inline
#define OUT(type) type&
#define IN_LIST(name, count) const real* name
#define OUT_LIST(name, count) real* name
#define IN_OUT_LIST(name, count) real* name
#define EXACT
// Not those of the C library.
#define sqrt airlight::f64::sqrt
#define abs airlight::f64::abs
#define floor airlight::f64::floor
#define fma airlight::f64::fma

using namespace airlight::f64;
