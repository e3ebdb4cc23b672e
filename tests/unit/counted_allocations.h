// Counts what operator new is asked for, in the whole test program.
#pragma once

namespace airlight {

// Calls by any thread so far. What malloc is asked for otherwise is not counted: oneTBB's own tasks, from pools of its own.
long allocations();

}  // namespace airlight
