#include "common/scene/gaussians_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "common/error.h"
#include "common/scene/cloud_table.h"
#include "common/scene/files.h"
#include "common/scene/limits.h"
#include "common/scene/temporary_file.h"

namespace airlight {

namespace {

constexpr std::uint64_t most_bytes = std::uint64_t{8} << 30U;
constexpr auto columns =
    keys("x", "y", "z", "radius", "extinction", "albedo_r", "albedo_g", "albedo_b", "red", "green", "blue", "emission_r",
         "emission_g", "emission_b", "scale_0", "scale_1", "scale_2", "opacity", "f_dc_0", "f_dc_1", "f_dc_2");

CloudTable table_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  if (extension != ".ply" && extension != ".csv")
    throw InputError(fmt::format("{}: unknown format \"{}\" of Gaussians, expected ply or csv", path, extension));
  std::string bytes = read_file(path, most_bytes);
  return extension == ".ply" ? read_ply_table(path, std::move(bytes), columns) : read_csv_table(path, std::move(bytes), columns);
}

bool are_splats(const CloudTable& t) { return t.find("scale_0") >= 0 && t.find("opacity") >= 0 && t.find("radius") < 0; }

// IEC 61966-2-1. The detour over long double makes the bits independent of the C library, here and below.
double linear_of_srgb(double v) {
  if (v <= 0.04045) return v / 12.92;
  return static_cast<double>(std::pow((static_cast<long double>(v) + 0.055L) / 1.055L, 2.4L));
}

class Reader {
 public:
  explicit Reader(const CloudTable& table) : t_(table) {}

  GaussiansFile read(Progress& progress) {
    out_.splats = are_splats(t_);
    out_.unused_columns = t_.others;
    find(place_, {"x", "y", "z"}, true);
    if (out_.splats) {
      find(scale_, {"scale_0", "scale_1", "scale_2"}, true);
      out_.has_albedo = find(color_, {"f_dc_0", "f_dc_1", "f_dc_2"}, false);
      opacity_ = t_.find("opacity");
    } else {
      radius_ = required("radius");
      extinction_ = required("extinction");
      out_.has_albedo = find(albedo_, {"albedo_r", "albedo_g", "albedo_b"}, false);
      if (!out_.has_albedo) out_.has_albedo = find(color_, {"red", "green", "blue"}, false);
      out_.has_emission = find(emission_, {"emission_r", "emission_g", "emission_b"}, false);
    }
    out_.gaussians.reserve(t_.rows.size());
    for (std::size_t row = 0; row < t_.rows.size(); ++row) {
      if (row % 65536 == 0) {
        progress.check();
        progress.report("loading Gaussians", static_cast<double>(row) / static_cast<double>(t_.rows.size()));
      }
      out_.gaussians.push_back(out_.splats ? splat(row) : gaussian(row));
    }
    return std::move(out_);
  }

 private:
  using Three = std::array<int, 3>;

  int required(std::string_view name) const {
    const int column = t_.find(name);
    if (column >= 0) return column;
    throw InputError(
        fmt::format("{}:{}:1: no column \"{}\", expected x y z radius extinction, or x y z scale_0 scale_1 scale_2 opacity of "
                    "Gaussian splats",
                    t_.path, t_.header_line, name));
  }
  // All three or, unless they must be there, none.
  bool find(Three& found, const std::array<std::string_view, 3>& names, bool must) const {
    for (std::size_t k = 0; k < 3; ++k) found[k] = t_.find(names[k]);
    if (!must && std::all_of(found.begin(), found.end(), [](int c) { return c < 0; })) return false;
    for (const std::string_view name : names) {
      if (t_.find(name) >= 0) continue;
      if (must) required(name);
      throw InputError(fmt::format("{}:{}:1: no column \"{}\", expected {}, {} and {} or none of them", t_.path, t_.header_line,
                                   name, names[0], names[1], names[2]));
    }
    return true;
  }

  double number(std::size_t row, int column, const Range& range) const {
    const double v = t_.at(row, column);
    if (!(v >= range.least && v <= range.most) || (range.open && v == range.least))
      t_.fail(
          row, column,
          fmt::format("{}, expected {} {}..{} {}", v, range.open ? "above" : "a number in", range.least, range.most, range.unit));
    return v;
  }
  glm::dvec3 numbers(std::size_t row, const Three& c, const Range& range) const {
    return {number(row, c[0], range), number(row, c[1], range), number(row, c[2], range)};
  }

  Gaussian gaussian(std::size_t row) const {
    Gaussian g;
    g.center = numbers(row, place_, limits::coordinate);
    g.radius = number(row, radius_, limits::radius);
    g.extinction = number(row, extinction_, limits::extinction);
    if (out_.has_emission) g.emission = numbers(row, emission_, limits::emission);
    if (!out_.has_albedo) return g;
    if (albedo_[0] >= 0) {
      g.albedo = numbers(row, albedo_, limits::fraction);
      return g;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const bool byte = t_.columns[static_cast<std::size_t>(color_[k])].byte;
      const double v = number(row, color_[k], byte ? Range{0, 255, ""} : limits::fraction);
      g.albedo[static_cast<int>(k)] = byte ? linear_of_srgb(v / 255) : v;
    }
    return g;
  }

  Gaussian splat(std::size_t row) const {
    Gaussian g;
    g.center = numbers(row, place_, limits::coordinate);
    long double sum = 0;
    for (const int c : scale_) sum += std::exp(static_cast<long double>(number(row, c, {-20, 14, ""})));
    g.radius = static_cast<double>(std::sqrt(2.0L) * sum / 3);
    const auto logit = static_cast<long double>(number(row, opacity_, {-1e4, 1e4, ""}));
    const long double depth = logit > 0 ? logit + std::log1p(std::exp(-logit)) : std::log1p(std::exp(logit));
    g.extinction = static_cast<double>(depth) / (g.radius * std::sqrt(std::numbers::pi));
    if (!(g.radius >= limits::radius.least && g.radius <= limits::radius.most))
      t_.fail(row, scale_[0],
              fmt::format("a radius of {} m, expected {}..{} m", g.radius, limits::radius.least, limits::radius.most));
    if (!(g.extinction <= limits::extinction.most))
      t_.fail(row, opacity_, fmt::format("an extinction of {} 1/m, expected at most {}", g.extinction, limits::extinction.most));
    if (!out_.has_albedo) return g;
    const double band = 0.5 * std::numbers::inv_sqrtpi;  // the constant spherical harmonic
    for (std::size_t k = 0; k < 3; ++k) {
      const double v = number(row, color_[k], limits::component);
      g.albedo[static_cast<int>(k)] = linear_of_srgb(std::clamp(0.5 + band * v, 0.0, 1.0));
    }
    return g;
  }

  const CloudTable& t_;
  GaussiansFile out_;
  Three place_{}, scale_{}, color_{}, albedo_{-1, -1, -1}, emission_{};
  int radius_ = -1, extinction_ = -1, opacity_ = -1;
};

void add(std::string& bytes, double v) {
  const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(v));
  for (unsigned k = 0; k < 4; ++k) bytes += static_cast<char>(bits >> (8 * k) & 0xffU);
}
void add(std::string& bytes, const glm::dvec3& v) { add(bytes, v.x), add(bytes, v.y), add(bytes, v.z); }

}  // namespace

GaussiansFile read_gaussians_file(const std::string& path, Progress& progress) {
  const CloudTable table = table_of(path);
  return Reader(table).read(progress);
}

bool is_gaussians_ply(const std::string& path) {
  // Only the header matters: a mesh with lists beside its vertices is one, too.
  const std::string bytes = read_file(path, most_bytes);
  const std::string_view header = std::string_view(bytes).substr(0, bytes.find("end_header"));
  const auto has = [&](std::string_view word) {
    return header.find(fmt::format(" {}\n", word)) != header.npos || header.find(fmt::format(" {}\r", word)) != header.npos;
  };
  return (has("radius") && has("extinction")) || (has("scale_0") && has("opacity"));
}

void write_gaussians_file(const std::string& path, const GaussiansFile& file, const std::string& comment) {
  std::string bytes =
      fmt::format("ply\nformat binary_little_endian 1.0\ncomment {}\nelement vertex {}\n", comment, file.gaussians.size());
  const auto name = [&](std::string_view names) {
    for (std::size_t at = 0; at < names.size();) {
      const std::size_t end = std::min(names.find(' ', at), names.size());
      bytes += fmt::format("property float {}\n", names.substr(at, end - at));
      at = end + 1;
    }
  };
  name("x y z radius extinction");
  if (file.has_albedo) name("albedo_r albedo_g albedo_b");
  if (file.has_emission) name("emission_r emission_g emission_b");
  bytes += "end_header\n";
  for (const Gaussian& g : file.gaussians) {
    add(bytes, g.center), add(bytes, g.radius), add(bytes, g.extinction);
    if (file.has_albedo) add(bytes, g.albedo);
    if (file.has_emission) add(bytes, g.emission);
  }
  TemporaryFile out(path);
  out.write(bytes.data(), bytes.size());
  out.rename_to_target();
}

}  // namespace airlight
