#include <cmath>
#include <glm/geometric.hpp>

#include "common/scene/limits.h"
#include "common/scene/parse.h"

namespace airlight {

namespace {

Extent parse_resolution(const Node& node) {
  const std::vector<Node> sides = node.array();
  if (sides.size() != 2) node.fail("expected an array of 2 whole numbers, width and height in pixels");
  return {sides[0].integer(1, limits::most_pixels), sides[1].integer(1, limits::most_pixels)};
}

}  // namespace

Camera parse_camera(const Node& node) {
  static constexpr auto known = keys("position", "look_at", "up", "vertical_fov", "resolution");
  const Object o(node, known);
  Camera c;
  const auto position = o.find("position"), look_at = o.find("look_at"), up = o.find("up");
  if (position) c.position = position->vec3(limits::coordinate);
  if (look_at) c.look_at = look_at->vec3(limits::coordinate);
  if (up) c.up = up->vec3(limits::component);
  if (const auto fov = o.find("vertical_fov")) c.vertical_fov = fov->number(limits::field_of_view);
  if (const auto resolution = o.find("resolution")) c.resolution = parse_resolution(*resolution);

  const glm::dvec3 view = c.look_at - c.position;
  const Node& target = look_at ? *look_at : position ? *position : node;
  if (!(glm::length(view) > 1e-9 * (1 + glm::length(c.position)))) target.fail("the same place as position, expected another");
  if (glm::length(c.up) < 1e-9) (up ? *up : node).fail("a zero vector, expected a direction");
  const double sine = glm::length(glm::cross(glm::normalize(view), glm::normalize(c.up)));
  if (!(sine > 1e-6))
    (up ? *up : target).fail("parallel to the view direction, expected up and look_at - position to span a plane");
  return c;
}

}  // namespace airlight
