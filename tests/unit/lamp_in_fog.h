// A small scene of everything that a frame has: a lamp in fog before a triangle.
#pragma once

#include <memory>

#include "common/scene/scene.h"

namespace airlight {

inline Scene lamp_in_fog(double extinction) {
  Scene scene;
  scene.camera.position = {0, 0, 4};
  scene.camera.look_at = {0, 0, 0};
  scene.camera.resolution = {96, 72};
  scene.medium.extinction = extinction;
  LightSource lamp;
  lamp.position = {0.5, 0.5, 0};
  lamp.power = {9, 5, 2};
  scene.lights = {lamp};
  auto mesh = std::make_shared<Mesh>();
  mesh->positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  mesh->normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
  mesh->triangles = {{0, 1, 2}};
  Surface triangle;
  triangle.mesh = mesh;
  scene.surfaces = {triangle};
  return scene;
}

}  // namespace airlight
