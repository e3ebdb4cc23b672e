#include <gtest/gtest.h>

#include "common/error.h"
#include "common/techniques/goal.h"

namespace airlight {
namespace {

TEST(Goal, ReadsUnits) {
  EXPECT_DOUBLE_EQ(*goal_of("1%", {}).error, 0.01);
  EXPECT_DOUBLE_EQ(*goal_of("0.5", {}).error, 0.5);
  EXPECT_DOUBLE_EQ(*goal_of("2e-3", {}).error, 2e-3);
  EXPECT_DOUBLE_EQ(*goal_of({}, "30ms").seconds, 0.03);
  EXPECT_DOUBLE_EQ(*goal_of({}, "0.2s").seconds, 0.2);
  EXPECT_FALSE(goal_of("1%", {}).seconds);
  EXPECT_FALSE(goal_of({}, {}));
}

TEST(Goal, RefusesTheRest) {
  for (const char* wrong :
       {"", "-1%", "0", "0%", "x", "1 %", " 1%", "+1%", "1%%", "nan", "inf", "1e400", "%", "1ms", "0x1p-3", "1,5%"})
    EXPECT_THROW(goal_of(wrong, {}), InputError) << wrong;
  for (const char* wrong : {"", "30", "ms", "-1s", "0ms", "1 ms", "1m", "1mss", "1ms ", "infs", "1%", "1e400s"})
    EXPECT_THROW(goal_of({}, wrong), InputError) << wrong;
  EXPECT_THROW(goal_of("1%", "1s"), InputError);
  try {
    goal_of({}, "30");
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "--budget: expected a time such as 30ms or 0.03s, found \"30\"");
  }
}

}  // namespace
}  // namespace airlight
