// Files of Gaussians: those of airlight, particles, captured splats.
#pragma once

#include <string>
#include <vector>

#include "common/progress.h"
#include "common/scene/scene.h"

namespace airlight {

struct GaussiansFile {
  std::vector<Gaussian> gaussians;  // metres, in the file's own frame; albedo and emission are 1 and 0 where the file has none
  bool has_albedo = false, has_emission = false;
  bool splats = false;                      // captured ones
  std::vector<std::string> unused_columns;  // that are there, too
};

// Reads a PLY (ascii or binary) or CSV file, by its extension, with columns
//
//   x y z [m]  radius [m]  extinction [1/m]      (common/scene/scene.h: Gaussian)
//   albedo_r albedo_g albedo_b                   or red green blue: the albedo, too; of 8 bits sRGB
//   emission_r emission_g emission_b             [W/m^3/sr]
//
// or those of 3D Gaussian splats (Kerbl et al. 2023): x y z, scale_0..2 (natural logarithms of the standard deviations [m]),
// opacity (before the logistic function), f_dc_0..2. Turned round, for a Gaussian here is: sigma is the mean of the three
// deviations, radius = sqrt(2) sigma; an opacity o = 1 / (1 + exp(-opacity)) of the ray through the centre is an optical depth of
// -ln(1 - o) = ln(1 + exp(opacity)), which is extinction radius sqrt(pi). The colour 1/2 + f_dc / (2 sqrt(pi)), held in 0..1, is
// sRGB and becomes the albedo. Rotation and what depends on direction are left out.
//
// Throws InputError with the line and column, or the byte, of what is wrong; for columns that are missing; for numbers out of
// range.
GaussiansFile read_gaussians_file(const std::string& path, Progress&);

// Whether a PLY file's columns are those of Gaussians or splats (else it may be a mesh). Throws as read_gaussians_file for a file
// that is missing or no PLY.
bool is_gaussians_ply(const std::string& path);

// Writes a binary PLY of floats, of albedo and emission where it has them, under its name only when it is complete. `comment`: a
// line.
void write_gaussians_file(const std::string& path, const GaussiansFile&, const std::string& comment);

}  // namespace airlight
