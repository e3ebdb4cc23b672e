// A hostile scene's picture beside the reference.
#pragma once

#include "tests/stability/trial.h"

namespace airlight {

// Some pixels of the frame against the reference: distances, transmittance, and the relative RMSE of beauty off edges against
// what the technique's estimate promises. Fills in the trial.
void hold_to_truth(const Scene&, const Asked&, std::uint32_t number, const TrialOptions&, const Frame&, Trial&);

}  // namespace airlight
