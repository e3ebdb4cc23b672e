#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <stdexcept>

#include "gpu/context.h"
#include "gpu/shader.h"
#include "tests/formulas/builds.h"

namespace airlight {

namespace {

constexpr std::string_view caller = R"(#include "gpu/dialect.glsl"
#define INPUTS real a[14]
#define RESULTS out real r[3]
#include "tests/formulas/calls.h"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Inputs { float inputs[]; };
layout(std430, binding = 1) writeonly buffer Results { float results[]; };
uniform int count;
uniform int kind;
uniform float g;

void main() {
  int i = int(gl_GlobalInvocationID.x);
  if (i >= count) return;
  real a[14];
  for (int k = 0; k < 14; ++k) a[k] = k < INPUT_COUNT ? inputs[k * count + i] : 0.0;
  real r[3];
  for (int k = 0; k < 3; ++k) r[k] = 0.0;
  call_formula(WHICH, 0, kind, g, a, r);
  for (int k = 0; k < 3; ++k) results[k * count + i] = r[k];
}
)";

// The shader's text, from the files built in and two of the tests.
std::optional<std::string_view> shader_file(std::string_view name) {
  if (name == "caller") return caller;
  if (name == "tests/formulas/calls.h") {
    static const std::string text = [] {
      std::ifstream file(AIRLIGHT_TEST_DATA "/../formulas/calls.h");
      if (!file) throw std::runtime_error("cannot read tests/formulas/calls.h");
      return std::string(std::istreambuf_iterator<char>(file), {});
    }();
    return text;
  }
  return embedded_shader_file(name);
}

class StorageBuffer {
 public:
  StorageBuffer(const GlFunctions& gl, GLuint binding, std::size_t size, const float* data) : gl_(gl) {
    gl_.CreateBuffers(1, &name_);
    gl_.NamedBufferData(name_, static_cast<GLsizeiptr>(size * sizeof(float)), data, GL_STATIC_DRAW);
    gl_.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, name_);
  }
  ~StorageBuffer() { gl_.DeleteBuffers(1, &name_); }
  StorageBuffer(const StorageBuffer&) = delete;
  StorageBuffer& operator=(const StorageBuffer&) = delete;
  std::vector<float> read(std::size_t size) const {
    std::vector<float> values(size);
    gl_.GetNamedBufferSubData(name_, 0, static_cast<GLsizeiptr>(size * sizeof(float)), values.data());
    return values;
  }

 private:
  const GlFunctions& gl_;
  GLuint name_ = 0;
};

struct Caller {
  std::unique_ptr<GlContext> context = make_context({.context = "osmesa"});
  std::map<Formula, std::unique_ptr<Program>> programs;

  ~Caller() {
    const GlContext::Current current(*context);
    programs.clear();
  }

  Columns operator()(const Calls& calls) {
    const GlContext::Current current(*context);
    const GlFunctions& gl = context->gl();
    std::unique_ptr<Program>& program = programs[calls.formula];
    if (!program) {
      const std::vector<std::string> defines{"WHICH " + std::to_string(static_cast<int>(calls.formula)),
                                             "INPUT_COUNT " + std::to_string(calls.inputs.size())};
      program = std::make_unique<Program>(gl, Program::Stages{{GL_COMPUTE_SHADER, shader_text("caller", defines, shader_file)}});
    }
    const std::size_t n = calls.inputs[0].size();
    std::vector<float> values;
    for (const std::vector<double>& column : calls.inputs) values.insert(values.end(), column.begin(), column.end());
    const StorageBuffer inputs(gl, 0, values.size(), values.data());
    const StorageBuffer results(gl, 1, most_results * n, nullptr);
    const std::vector<float> table =
        calls.table.empty() ? std::vector<float>(1) : std::vector(calls.table.begin(), calls.table.end());
    const StorageBuffer tables(gl, 7, table.size(), table.data());
    program->set("count", static_cast<int>(n));
    program->set("kind", static_cast<int>(calls.phase.kind));
    program->set("g", static_cast<float>(calls.phase.g));
    program->use();
    gl.DispatchCompute(static_cast<GLuint>((n + 63) / 64), 1, 1);
    gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    const std::vector<float> found = results.read(most_results * n);
    check_gl(gl, "a formula");
    Columns columns;
    for (std::size_t k = 0; k < most_results; ++k) {
      const auto first = found.begin() + static_cast<std::ptrdiff_t>(k * n);
      columns.emplace_back(first, first + static_cast<std::ptrdiff_t>(n));
    }
    return columns;
  }
};

Caller& glsl() {
  static Caller only;
  return only;
}

}  // namespace

Columns run_glsl(const Calls& calls) { return glsl()(calls); }
std::string glsl_renderer() { return glsl().context->describe(); }

}  // namespace airlight
