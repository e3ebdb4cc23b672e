// What bench/erf.cpp measures: error functions, and optical depths of Gaussians along rays, each for one instruction set.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace airlight {

struct ErfFunction {
  std::string name, target;                              // target: scalar, AVX2, AVX-512
  void (*run)(const float* x, float* y, std::size_t n);  // n is a multiple of 16
};

struct LineGaussian {
  float x, y, z;  // centre [m], from where the rays begin
  float inverse;  // of its radius [1/m]
  float whole;    // optical depth of the line through its centre
};

// Unit vectors and lengths [m]; n is a multiple of 16.
struct LineRays {
  const float *x, *y, *z, *length;
  std::size_t n;
};

struct LineIntegral {
  std::string name, target;
  // Sums of the optical depths of all Gaussians, a ray each.
  void (*run)(const LineRays&, std::span<const LineGaussian>, float* depth);
};

// How many results a second and core a chain-free stream of one operation gives [1/s].
struct PortLimit {
  std::string name, target;
  std::size_t (*run)(float* keep);  // returns how many results; keeps something of them, so that they are computed
};

struct ErfCandidates {
  std::vector<ErfFunction> erf;
  std::vector<LineIntegral> lines;
  std::vector<PortLimit> limits;
};

// The kernels' own, on every target of this machine (bench/erf_ours.cpp).
void add_ours(ErfCandidates&);

// Of libraries and compilers, each built for one instruction set: call only where the machine has it (bench/erf_others.cpp,
// erf_plain.cpp).
void add_others_avx2(ErfCandidates&);
void add_others_avx512(ErfCandidates&);
void add_plain_avx2(ErfCandidates&);
void add_plain_avx512(ErfCandidates&);

}  // namespace airlight
