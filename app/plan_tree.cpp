#include "app/plan_tree.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <type_traits>

#include "common/plan/cost.h"
#include "common/plan/step_skips.h"

namespace airlight {

namespace {

std::string number(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string milliseconds(double seconds) { return number(seconds < 0.01 ? "%.3g ms" : "%.0f ms", 1e3 * seconds); }

std::string size_of(std::uint64_t bytes) {
  const auto n = static_cast<double>(bytes);
  return n < 1e6 ? number("%.3g kB", n / 1e3) : number(n < 1e7 ? "%.2g MB" : "%.0f MB", n / 1e6);
}

// Which step makes each input of each step.
class Inputs {
 public:
  std::vector<StepInput> of(const Step& step, int index) {
    std::vector<StepInput> found;
    std::visit(
        [&](const auto& a) {
          a.fields(a, [&](const Field& field, const auto& value) {
            using Value = std::remove_cvref_t<decltype(value)>;
            if (field.role != Role::input) return;
            if constexpr (std::is_base_of_v<Handle, Value>) {
              if (value) found.push_back({field.name, maker(value)});
            } else if constexpr (std::is_same_v<Value, std::vector<Buffer>>) {
              for (const Buffer& b : value) found.push_back({field.name, maker(b)});
            }
          });
        },
        step.what);
    for (const Image& image : outputs_of(step.what)) makers_[image] = index;
    for (const Buffer& buffer : buffers_made_by(step.what)) makers_[buffer] = index;
    return found;
  }

 private:
  int maker(Handle h) const {
    const auto made = makers_.find(h);
    return made == makers_.end() ? -1 : made->second;
  }
  std::map<Handle, int> makers_;
};

class Tree {
 public:
  Tree(const Stats& stats, bool measured) : steps_(stats.steps), measured_(measured), told_(steps_.size()) {}

  std::string text() {
    std::vector<bool> read(steps_.size());
    for (const StepStats& step : steps_) {
      for (const StepInput& input : step.inputs)
        if (input.step >= 0) read[static_cast<std::size_t>(input.step)] = true;
    }
    for (std::size_t i = steps_.size(); i-- > 0;)
      if (!read[i]) add("", {static_cast<int>(i)}, 1);
    return text_;
  }

 private:
  const StepStats& step(int index) const { return steps_[static_cast<std::size_t>(index)]; }

  std::string cost(const std::vector<int>& which) const {
    double seconds = 0, estimate = 0;
    std::uint64_t items = 0, left = 0, bytes = 0;
    std::size_t kept = 0, not_asked = 0;
    for (const int i : which) {
      const StepStats& s = step(i);
      seconds += s.seconds, items += s.items, bytes += s.bytes;
      if (s.reused) left += s.skipped;
      kept += s.reused && s.asked, not_asked += !s.asked;
      if (!s.reused) estimate += s.estimate;
    }
    std::string text;
    if (kept == which.size()) {
      text = "kept from the last frame";
    } else if (not_asked == which.size()) {
      text = "not run: nothing asks for it";
    } else {
      text = measured_ ? milliseconds(seconds) : "about " + milliseconds(estimate);
      if (which.size() > 1 && kept > 0) text += ", " + std::to_string(kept) + " of them kept from the last frame";
    }
    if (measured_ && items > 0) text += ", " + std::to_string(items) + " items";
    if (measured_ && left > 0) text += ", " + std::to_string(left) + " items skipped";
    if (not_asked != which.size() && bytes > 0) text += ", " + size_of(bytes);
    return measured_ ? text + passed_over(which) : text;
  }

  // What those that ran skipped of their items, and of what else they work through, where that was counted.
  std::string passed_over(const std::vector<int>& which) const {
    std::uint64_t skipped = 0;
    StepParts parts;
    std::string_view why;
    bool counted = false;
    for (const int i : which) {
      const StepStats& s = step(i);
      if (!s.counted) continue;
      counted = true;
      skipped += s.skipped, why = s.why_skipped;
      parts = {parts.all + s.parts.all, parts.skipped + s.parts.skipped, s.parts.name, s.parts.why};
    }
    if (!counted) return "";
    std::string text = skipped > 0 ? "; " + std::to_string(skipped) + " items skipped: " + std::string(why) : "; no item skipped";
    if (parts.name.empty() || parts.all == 0) return text;
    text += "; " + std::to_string(parts.all) + " " + std::string(parts.name) + ", ";
    return text + (parts.skipped > 0 ? std::to_string(parts.skipped) + " skipped: " + std::string(parts.why) : "none skipped");
  }

  // Steps of one name that are read under one name.
  void add(const std::string& reader, const std::vector<int>& which, int depth) {
    const StepStats& first = step(which[0]);
    text_ += std::string(2 * static_cast<std::size_t>(depth), ' ') + reader + first.name;
    if (which.size() > 1) text_ += " of " + std::to_string(which.size());
    if (std::all_of(which.begin(), which.end(), [&](int i) { return told_[static_cast<std::size_t>(i)]; })) {
      text_ += ", above\n";
      return;
    }
    for (const int i : which) told_[static_cast<std::size_t>(i)] = true;
    if (!first.why.empty()) text_ += ": " + std::string(first.why);
    text_ += " (" + cost(which) + ")";
    if (!first.residuals.empty()) {
      text_ += "; " + std::to_string(first.residuals.size()) + " rounds, the last changed " +
               number("%.2g", static_cast<double>(first.residuals.back())) + ", about " +
               number("%.2g", static_cast<double>(first.left_out)) + " are left out";
      if (!first.converged) text_ += ": more than tolerance allows, raise iterations";
    }
    if (!first.note.empty()) text_ += "; " + first.note;
    text_ += "\n";
    add_inputs(which, depth + 1);
  }

  // Under the names of the fields, those together that one step makes, or steps of one name.
  void add_inputs(const std::vector<int>& which, int depth) {
    struct Group {
      std::string names;
      std::vector<int> makers;
    };
    std::vector<Group> groups;
    std::string uploaded;
    const auto join = [](std::string& all, std::string_view name) {
      if (!all.empty() && all.ends_with(name)) return;
      all += (all.empty() ? "" : ", ") + std::string(name);
    };
    for (const StepInput& input : step(which[0]).inputs) {
      if (input.step < 0) {
        join(uploaded, input.name);
        continue;
      }
      const auto same = std::find_if(groups.begin(), groups.end(), [&](const Group& g) {
        return g.makers[0] == input.step || (g.names == input.name && step(g.makers[0]).name == step(input.step).name);
      });
      Group& group = same == groups.end() ? groups.emplace_back() : *same;
      join(group.names, input.name);
      if (std::find(group.makers.begin(), group.makers.end(), input.step) == group.makers.end())
        group.makers.push_back(input.step);
    }
    for (const Group& group : groups) add(group.names + " <- ", group.makers, depth);
    if (!uploaded.empty()) text_ += std::string(2 * static_cast<std::size_t>(depth), ' ') + uploaded + " <- the scene\n";
  }

  const std::vector<StepStats>& steps_;
  bool measured_;
  std::vector<bool> told_;
  std::string text_;
};

}  // namespace

void describe_steps(const Plan& plan, std::vector<StepStats>& steps) {
  Inputs inputs;
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    const Step& from = plan.steps[i];
    StepStats& to = steps[i];
    const StepCost cost = cost_of(from.what);
    to.why = from.why;
    to.inputs = inputs.of(from, static_cast<int>(i));
    to.estimate = cost.seconds;
    to.bytes = cost.bytes;
    const StepSkips in_words = step_skips(from.what);
    to.why_skipped = in_words.items;
    to.parts.name = in_words.parts, to.parts.why = in_words.why_parts;
    if (!to.reused) continue;
    to.skipped = cost.items;
    const std::vector<Image> images = outputs_of(from.what);
    to.asked = !buffers_made_by(from.what).empty() ||
               std::any_of(images.begin(), images.end(), [](const Image& image) { return image.keep; });
  }
}

void add(Stats& all, const Stats& more) {
  all.seconds += more.seconds;
  for (std::size_t i = 0; i < std::min(all.steps.size(), more.steps.size()); ++i) {
    StepStats& sum = all.steps[i];
    const StepStats& step = more.steps[i];
    sum.seconds += step.seconds;
    sum.items += step.items;
    sum.held = std::max(sum.held, step.held);
    if (step.reused) continue;
    sum.counted = sum.counted || step.counted;
    sum.skipped += step.skipped;
    sum.parts.all += step.parts.all, sum.parts.skipped += step.parts.skipped;
  }
}

std::vector<SkipStats> skips_of(const Plan& plan) {
  std::vector<SkipStats> skips;
  for (const Plan::Skip& skip : plan.skips) skips.push_back({std::string(name_of(skip.rule)), skip.what, skip.why});
  return skips;
}

Stats planned_stats(const Plan& plan, const std::vector<bool>& runs) {
  Stats stats;
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    stats.steps.emplace_back();
    stats.steps.back().name = name_of(plan.steps[i].what);
    stats.steps.back().reused = !runs[i];
  }
  describe_steps(plan, stats.steps);
  stats.skips = skips_of(plan);
  return stats;
}

std::string plan_tree(const Stats& stats, bool measured) {
  if (!stats.steps.empty() && std::all_of(stats.steps.begin(), stats.steps.end(), [](const StepStats& s) { return s.reused; })) {
    return "  nothing runs: all is as in the last frame (" + std::string(name_of(Rule::unchanged)) + ")\n" +
           Tree(stats, measured).text();
  }
  return Tree(stats, measured).text();
}

std::string left_out(const Stats& stats) {
  std::string text;
  for (const SkipStats& skip : stats.skips) text += "  " + skip.what + ": " + skip.why + " (" + skip.rule + ")\n";
  return text;
}

}  // namespace airlight
