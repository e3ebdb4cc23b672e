// Every formula file, in order of use. Included by a build of the dialect (README.md), never on its own.
#include "common/formulas/camera.h"
#include "common/formulas/triangle.h"
#include "common/formulas/phase.h"
#include "common/formulas/transmittance.h"
#include "common/formulas/reflection.h"
#include "common/formulas/grid.h"
#include "common/formulas/airlight.h"
#include "common/formulas/surface_airlight.h"
