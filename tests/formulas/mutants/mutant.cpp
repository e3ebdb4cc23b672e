// The checks of the formulas on formulas that may be damaged: common/formulas comes with one text replaced from the include path.
//   mutant            every check must hold
//   mutant NAME...    every named check must fail: a test that misses the damage proves nothing
#include <algorithm>
#include <cstdio>

#include "tests/formulas/checks/check.h"
#include "tests/tolerances.h"

#define f64 damaged  // a namespace of its own beside the true one, which oracles and tables use
#include "common/formulas/double.h"

#define FORMULA inline
#define OUT(type) type&
#define INPUTS const real* a
#define RESULTS real* r
namespace airlight::damaged {
#include "tests/formulas/calls.h"
}

namespace {

airlight::Columns run(const airlight::Calls& calls) {
  using namespace airlight;
  const std::size_t n = calls.inputs[0].size();
  Columns results(most_results, std::vector<double>(n));
  for (std::size_t i = 0; i < n; ++i) {
    double a[most_inputs] = {}, r[most_results] = {};
    for (std::size_t k = 0; k < calls.inputs.size(); ++k) a[k] = calls.inputs[k][i];
    damaged::call_formula(static_cast<int>(calls.formula), calls.table.data(), static_cast<int>(calls.phase.kind), calls.phase.g,
                          a, r);
    for (std::size_t k = 0; k < most_results; ++k) results[k][i] = r[k];
  }
  return results;
}

}  // namespace

int main(int count, char** arguments) {
  const std::vector<std::string> names(arguments + 1, arguments + count);
  std::size_t wrong = 0, seen = 0;
  for (const airlight::Check& check : airlight::all_checks()) {
    if (!names.empty() && std::find(names.begin(), names.end(), check.name) == names.end()) continue;
    ++seen;
    const airlight::Measured m = check.measure(run);
    const bool holds = m.error <= airlight::tolerance(check.double_bound);
    std::printf("%s: %s, largest error %.3g (allowed %.3g), %s\n", check.name.c_str(), holds ? "holds" : "fails", m.error,
                airlight::tolerance(check.double_bound), m.where.c_str());
    if (holds != names.empty()) ++wrong;
  }
  if (seen == 0 || seen < names.size()) {
    std::printf("no such check\n");
    return 2;
  }
  return wrong == 0 ? 0 : 1;
}
