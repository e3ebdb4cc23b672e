#include "cpu/network_sweep.h"

#include <algorithm>
#include <cmath>
#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/network_sweep.cpp"
#include <hwy/foreach_target.h>

#include "cpu/simd.h"
//
#include "cpu/network_wide.h"

HWY_BEFORE_NAMESPACE();
namespace airlight::HWY_NAMESPACE {

namespace {

// What light meets in one link of four lists.
struct WideLink {
  Wide got;       // what its ends take
  Wide to_after;  // of that, what the end after it takes: nothing beyond a list's end
};

// Light goes through a link, whose source is the mean of its ends. `number` is the link's, counted from a list's beginning.
HWY_INLINE WideLink pass(const float* shares, const Wide& before, const Wide& after, const Wide& last, int number, Wide& beam) {
  const Wide lost = each_list(shares), given = each_list(shares + lists_abreast), kept = each_list(shares + 2 * lists_abreast);
  WideLink link;
  for (int q = 0; q < wide_vectors; ++q) {
    const Real mean = 0.5 * (before.v[q] + after.v[q]);
    const Real got = fma(given.v[q], beam.v[q], kept.v[q] * mean);
    beam.v[q] = fma(-lost.v[q], beam.v[q], fma(given.v[q], mean, beam.v[q]));
    link.got.v[q] = got;
    link.to_after.v[q] = select(last.v[q] <= static_cast<float>(number), 0.0, 0.5 * got);
  }
  return link;
}

// Along the lists; sends(k) is what end k sends. take(k, what) for particle k of each list but those that the longest does not
// have.
template <class Sends, class Take>
HWY_INLINE void along(const ListBlock& block, const float* shares, const float* sky, Sends&& sends, Take&& take) {
  const Wide last = each_list(block.last);
  Wide before = sends(0), beam = wide_same(sky), waiting = wide_zero();
  for (int k = 0; k < block.links; ++k) {
    const Wide after = sends(k + 1);
    const WideLink link = pass(shares + 12 * k, before, after, last, k, beam);
    if (k == 0) {
      waiting = link.got;
    } else {
      take(k - 1, wide_sum(waiting, wide_difference(link.got, link.to_after)));
      waiting = link.to_after;
    }
    before = after;
  }
}

// Against them.
template <class Sends, class Take>
HWY_INLINE void against(const ListBlock& block, const float* shares, const float* sky, Sends&& sends, Take&& take) {
  const Wide last = each_list(block.last);
  Wide after = sends(block.links), beam = wide_same(sky), waiting = wide_zero();
  for (int k = block.links - 1; k >= 0; --k) {
    const Wide before = sends(k);
    const WideLink link = pass(shares + 12 * k, before, after, last, k, beam);
    if (k == 0) {
      take(0, wide_sum(waiting, link.got));
    } else {
      if (k + 1 < block.links) take(k, wide_sum(waiting, link.to_after));
      waiting = wide_difference(link.got, link.to_after);
    }
    after = before;
  }
}

}  // namespace

static void sweep_both(const LineLists& lists, const float* source, const float* sky, float* scratch, float* taken) {
  float *sent = scratch, *took = scratch + 16 * (lists.most + 1);
  for (const ListBlock& block : lists.blocks) {
    const std::int32_t* ends = lists.ends.data() + block.ends;
    const float* shares = lists.shares.data() + block.shares;
    const Wide area = each_list(block.area);
    const auto send = [&](int k) HWY_ATTR {
      const Wide what = wide_at(source, ends + 4 * k);
      wide_store(what, sent + 16 * k);
      return what;
    };
    along(block, shares, sky, send, [&](int k, const Wide& what) HWY_ATTR { wide_store(what, took + 16 * k); });
    against(
        block, shares, sky + 4, [&](int k) HWY_ATTR { return wide_load(sent + 16 * k); },
        [&](int k, const Wide& what)
            HWY_ATTR { wide_add(wide_sum(wide_load(took + 16 * k), what), area, ends + 4 * (k + 1), taken); });
  }
}

static void sweep_way(const LineLists& lists, bool backward, const float* source, const float* sky, float* taken) {
  for (const ListBlock& block : lists.blocks) {
    const std::int32_t* ends = lists.ends.data() + block.ends;
    const float* shares = lists.shares.data() + block.shares;
    const Wide area = each_list(block.area);
    const auto take = [&](int k, const Wide& what) HWY_ATTR { wide_add(what, area, ends + 4 * (k + 1), taken); };
    const auto send = [&](int k) HWY_ATTR { return wide_at(source, ends + 4 * k); };
    if (backward) {
      against(block, shares, sky, send, take);
    } else {
      along(block, shares, sky, send, take);
    }
  }
}

}  // namespace airlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace airlight {

HWY_EXPORT(sweep_both);
HWY_EXPORT(sweep_way);

LineLists::LineLists(const Links& links, const float* masses, std::size_t particles) {
  struct List {
    std::size_t first, count;
  };
  std::vector<List> lists;
  links.each_list([&](std::size_t at, std::size_t n) { lists.push_back({at, n}); });
  std::sort(lists.begin(), lists.end(),
            [](const List& a, const List& b) { return a.count != b.count ? a.count > b.count : a.first < b.first; });
  ends.reserve(5 * (particles + 2 * lists.size()) / 4);
  shares.reserve(3 * 5 * (particles + lists.size()) / 4);
  for (std::size_t begin = 0; begin < lists.size(); begin += lists_abreast) {
    const std::size_t width = lists[begin].count + 1;
    ListBlock block{ends.size(), shares.size(), static_cast<int>(width), {}, {}};
    most = std::max(most, width);
    ends.resize(ends.size() + lists_abreast * (width + 1), static_cast<std::int32_t>(particles));
    shares.resize(shares.size() + 3 * lists_abreast * width, 0.0F);
    for (std::size_t i = 0; i < lists_abreast && begin + i < lists.size(); ++i) {
      const auto [at, n] = lists[begin + i];
      block.last[i] = static_cast<float>(n);
      block.area[i] = links.area(at, n, masses);
      for (std::size_t k = 0; k < n + 2; ++k) {
        const std::size_t particle = std::clamp<std::size_t>(k, 1, n) - 1;
        ends[block.ends + lists_abreast * k + i] = static_cast<std::int32_t>(links.particle_at(at + particle));
      }
      for (std::size_t k = 0; k <= n; ++k) {
        float* to = shares.data() + block.shares + 3 * lists_abreast * k + i;
        to[0] = links.lost[at + k], to[lists_abreast] = links.given[at + k], to[2 * lists_abreast] = links.kept[at + k];
      }
    }
    blocks.push_back(block);
  }
}

void sweep_both_ways(const LineLists& lists, const float* source, const float* sky, float* scratch, float* taken, Simd simd) {
  entry(HWY_DISPATCH_TABLE(sweep_both), simd)(lists, source, sky, scratch, taken);
}

void sweep_one_way(const LineLists& lists, bool backward, const float* source, const float* sky, float* taken, Simd simd) {
  entry(HWY_DISPATCH_TABLE(sweep_way), simd)(lists, backward, source, sky, taken);
}

}  // namespace airlight
#endif
