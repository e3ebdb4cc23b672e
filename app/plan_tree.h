// The steps of a frame as a tree of text: each with what it reads, why it is there, and what it cost or is about to cost.
#pragma once

#include <string>
#include <vector>

#include "common/plan/plan.h"
#include "common/stats.h"

namespace airlight {

// Tells the statistics of a plan's steps all that the plan knows of them: reasons, inputs, estimates, bytes, and the items of
// steps that do not run.
void describe_steps(const Plan&, std::vector<StepStats>&);
// Adds what another band or sample of a frame took to what those before it took.
void add(Stats& all, const Stats& more);
std::vector<SkipStats> skips_of(const Plan&);
// The statistics of a frame that has not been rendered; `runs` as steps_to_run() tells.
Stats planned_stats(const Plan&, const std::vector<bool>& runs);

// From the images back to the scene; what several steps read stands at the first of them. `measured`: with times and items, else
// with estimates. Many lines, two spaces before each.
std::string plan_tree(const Stats&, bool measured);
// What is left out and by which rule, a line each; empty where nothing is.
std::string left_out(const Stats&);

}  // namespace airlight
