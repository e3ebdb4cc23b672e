#pragma once

#include "common/algorithms/field.h"
#include "common/algorithms/view.h"

namespace airlight {

// Floats of the table's head, of a vertex, of a lobe.
constexpr int hidden_head_floats = 4, hidden_vertex_floats = 5, hidden_lobe_floats = 3 * 36;

// What the surfaces hide from each other of an environment's light: known at the vertices (precomputed radiance transfer: Sloan
// et al. 2002; Zhou et al. 2007, 4.3) and linear between them. It is told as what a lobe would have reflected of what is hidden,
// so that nothing changes where nothing is.
struct HiddenEnvironment {
  Image normal, corners;  // as SurfaceVisibility makes them
  Buffer triangles;       // as SurfaceVisibility takes them
  // The number of vertices and three zeros; the lobes of each tabulated reflectance, as brdf_environment() takes them; for each
  // vertex seen from the front, then for each from the back, red, green and blue that Lambert's lobe misses
  // [W/m^2/sr], the number of its lobe or -1, and that of its material's reflectance or -1; the lobes: 36 coefficients a channel
  // of what is hidden, as it is where there is a reflectance, else convolved with the lobe of the vertex's material, as
  // environment_reflection() takes them.
  // common/plan/hidden_environment.h makes it.
  Buffer table;
  View view;
  int brdfs = 0;  // tabulated reflectances in the table

  Image diffuse;   // rgb32f [W/m^2/sr] of a white surface; 0 where nothing is hit
  Image specular;  // rgb32f [W/m^2/sr], optional: the same of the material's lobe about the mirror direction or, where it has
                   // one, of its tabulated reflectance

  static constexpr std::string_view name = "hidden_environment";
  static constexpr Domain domain = Domain::pixel;
  template <class Self, class Visit>
  static void fields(Self& s, Visit&& v) {
    v(in("normal"), s.normal);
    v(in("corners"), s.corners);
    v(in("triangles"), s.triangles);
    v(in("table"), s.table);
    v(knob("view"), s.view);
    v(knob("brdfs"), s.brdfs);
    v(out("diffuse", "W/m^2/sr"), s.diffuse);
    v(out("specular", "W/m^2/sr"), s.specular);
  }
};

}  // namespace airlight
