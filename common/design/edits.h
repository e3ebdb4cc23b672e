// What can be done to a scene's medium, lights and camera with the design tools (Zhou et al. 2007, section 6), as values: one
// struct an edit. They are lines of edit scripts (edit_script.h) and are carried out by SceneEditor (scene_editor.h).
//
// The paper's Gaussian is c exp(-a^2 |x - b|^2): its amplitude c is our extinction [1/m], its scale a is 1 / radius.
// Places on the screen are (right, up) from the middle of the image in halves of its height, whatever its resolution: the ray of
// (x, y) has the direction (x right + y up) tan(fov / 2) + forward.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace airlight {

// What a tool places.
struct Puff {
  double radius = 0.5;                         // [m]
  double extinction = 1;                       // [1/m]
  std::optional<glm::dvec3> albedo, emission;  // the medium's unless said
};

struct DesignPlane {
  glm::dvec3 point{0, 0, 0};
  glm::dvec3 normal{0, 1, 0};  // of any length but 0
};

// A line drawn by hand: on the screen, projected onto a plane, or given by its points in the world.
struct Stroke {
  std::vector<glm::dvec2> screen;
  std::optional<DesignPlane> plane;  // where there are screen points
  std::vector<glm::dvec3> points;    // where there are none
};

// Paintbrush: Gaussians along a stroke, each moved at random in the plane perpendicular to it.
struct PaintEdit {
  Stroke stroke;
  Puff puff;
  std::optional<double> spacing;  // [m] along the stroke; 0.75 radius unless said
  std::optional<double> scatter;  // [m] centres are moved by less; radius unless said
  std::int64_t seed = 0;
};

// Airbrush: particles that live on, bounce off surfaces and diffuse; where they are when it stops they stay.
struct AirbrushEdit {
  std::vector<glm::dvec3> points;  // where particles come from, evenly along the way in time
  Puff puff;
  double rate = 10;                  // [1/s]
  double seconds = 1;                // that it is held
  glm::dvec3 velocity{0, 0, 0};      // [m/s] at the start
  double spread = 0;                 // [m/s] largest random velocity on top, in any direction
  glm::dvec3 acceleration{0, 0, 0};  // [m/s^2]
  double drag = 0.5;                 // [1/s] velocity lost
  double diffusion = 0.02;           // [m^2/s]: the variance along an axis grows by twice that a second
  double bounce = 0.5;               // 0..1: speed kept
  std::int64_t seed = 0;
};

// Eraser: takes `amount` from the extinction of each Gaussian that it covers; what has none left is removed. With a plane or
// points it is a ball that goes along the stroke; a stroke on the screen alone erases along the view rays, `radius` wide at each
// depth.
struct EraseEdit {
  Stroke stroke;
  double radius = 0.5;  // [m] to the centre of a Gaussian
  double amount = 1;    // [1/m]
};

// Particle emitter: what it has sent out by `time`. Paths are parabolas; radius and extinction fall to 0 over the lifetime.
struct EmitEdit {
  glm::dvec3 position{0, 0, 0};
  Puff puff;
  double rate = 10;                  // [1/s]
  double lifetime = 2;               // [s]
  double time = 2;                   // [s] since it began; those of frames go on from there
  glm::dvec3 velocity{0, 1, 0};      // [m/s] at the start
  double spread = 0;                 // [m/s] largest random velocity on top, in any direction
  glm::dvec3 acceleration{0, 0, 0};  // [m/s^2]
  std::int64_t seed = 0;
};

// Gaussians whose centres are seen within a rectangle, of which these are two opposite corners.
struct ScreenRectangle {
  glm::dvec2 from{0, 0}, to{0, 0};
};

struct CopyEdit {  // to be pasted
  ScreenRectangle rectangle;
};
struct PasteEdit {             // what was copied last
  glm::dvec3 offset{0, 0, 0};  // [m]
};
struct MoveEdit {
  ScreenRectangle rectangle;
  glm::dvec3 offset{0, 0, 0};  // [m]
};

struct LightEdit {
  std::string light;                    // its name, or its number from 0 (environments do not count)
  std::optional<glm::dvec3> position;   // [m] of a point light
  std::optional<glm::dvec3> direction;  // of a directional one
  std::optional<glm::dvec3> power;      // intensity or irradiance
};

// Homogeneous extinction [1/m].
struct FogEdit {
  double extinction = 0;
};

struct CameraEdit {
  std::optional<glm::dvec3> position, look_at, up;
  std::optional<double> vertical_fov;  // [degree]
};

struct TechniqueEdit {
  std::string name;
  std::vector<std::pair<std::string, std::string>> settings;
};

// Of all but copying, camera and technique.
struct UndoEdit {};
struct RedoEdit {};

using Edit = std::variant<PaintEdit, AirbrushEdit, EraseEdit, EmitEdit, CopyEdit, PasteEdit, MoveEdit, LightEdit, FogEdit,
                          CameraEdit, TechniqueEdit, UndoEdit, RedoEdit>;

}  // namespace airlight
