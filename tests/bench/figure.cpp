#include <gtest/gtest.h>

#include <cmath>

#include "bench/pareto/axis.h"
#include "bench/pareto/labels.h"
#include "bench/pareto/plot.h"

namespace airlight {
namespace {

TEST(Axis, IsLogarithmicWithRoomAroundTheValues) {
  const LogAxis axis = axis_over({1, 100, 10}, 50, 450);
  EXPECT_LT(axis.least, 1);
  EXPECT_GT(axis.most, 100);
  EXPECT_NEAR(axis(10), 250, 1e-9);
  EXPECT_NEAR(axis(axis.least), 50, 1e-9);
  EXPECT_NEAR(axis(100) - axis(10), axis(10) - axis(1), 1e-9);
  const LogAxis narrow = axis_over({7}, 0, 1);
  EXPECT_GT(narrow.most / narrow.least, 3);
  EXPECT_LT(narrow.most / narrow.least, 4);
}

TEST(Axis, NumbersAreRoundAndFew) {
  for (const double length : {3.2, 10.0, 50.0, 1e3, 1e7}) {
    const LogAxis axis{0.02, 0.02 * length, 0, 1};
    int numbers = 0;
    for (const Tick& t : ticks(axis)) {
      EXPECT_GE(t.value, axis.least);
      EXPECT_LE(t.value, axis.most);
      EXPECT_LE(t.label.size(), 7U) << t.label;
      numbers += t.label.empty() ? 0 : 1;
    }
    EXPECT_GE(numbers, 3) << length;
    EXPECT_LE(numbers, 12) << length;
  }
}

TEST(Labels, NeverMeetEachOtherAndStayInside) {
  const Box area{0, 0, 300, 200};
  std::vector<Label> labels;
  std::vector<Box> taken;
  for (int i = 0; i < 40; ++i) {
    labels.push_back({150 + 60 * std::sin(i), 100 + 40 * std::cos(2.0 * i), 60, 12});
    taken.push_back({labels.back().x - 4, labels.back().y - 4, 8, 8});
  }
  const std::vector<std::optional<Box>> boxes = placed(labels, taken, area);
  ASSERT_EQ(boxes.size(), labels.size());
  std::size_t there = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (!boxes[i]) continue;
    ++there;
    EXPECT_TRUE(boxes[i]->inside(area));
    for (const Box& t : taken) EXPECT_FALSE(boxes[i]->meets(t));
    for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(boxes[k] && boxes[i]->meets(*boxes[k]));
  }
  EXPECT_GT(there, 5U);
  EXPECT_LT(there, labels.size()) << "too few labels to see that some are dropped";
  EXPECT_FALSE(placed({{5, 5, 400, 12}}, {}, area)[0]) << "wider than the area";
}

TEST(Figure, IsTheSameEachTime) {
  Measurement m;
  m.devices = {{"cpu", "cpu, one"}, {"gl", "gl, two"}};
  for (int i = 0; i < 12; ++i) {
    Point p;
    p.configuration = {i % 2 == 0 ? "a" : "b", i % 3 == 0 ? "gl" : "cpu", {{"steps", std::to_string(i)}}};
    p.ms = i * 3, p.error = {0.1 / (i + 1), 0.1}, p.on_front = i % 4 != 1;
    m.points.push_back(p);
  }
  const Origin origin{"<scene> & more", {8, 6}, {4, 3}, {}, "1", "c", "g++", "m"};
  const Figure first = figure_of(m, origin), second = figure_of(m, origin);
  EXPECT_EQ(first.svg, second.svg);
  EXPECT_EQ(first.png, second.png);
  EXPECT_TRUE(first.svg.starts_with("<?xml"));
  EXPECT_NE(first.svg.find("</svg>"), std::string::npos);
  EXPECT_TRUE(first.png.starts_with("\x89PNG"));
  m.points[3].ms *= 2;
  EXPECT_NE(figure_of(m, origin).svg, first.svg);
  m.points.clear();
  EXPECT_FALSE(figure_of(m, origin).png.empty());
}

}  // namespace
}  // namespace airlight
