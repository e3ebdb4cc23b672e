// What an editor reads before a formula file (.clangd in the root): the double build without that file, and its words.
#pragma once

#define AIRLIGHT_EDITOR
#include "common/formulas/double.h"

// Not those of the C library.
#define sqrt airlight::f64::sqrt
#define abs airlight::f64::abs
#define floor airlight::f64::floor
#define fma airlight::f64::fma

using namespace airlight::f64;
