#include "gpu/shader.h"

#include <string>

#include "common/error.h"

namespace airlight {

namespace {

template <class GetSize, class GetLog>
std::string log_of(GLuint name, GetSize get_size, GetLog get_log) {
  GLint size = 0;
  get_size(name, GL_INFO_LOG_LENGTH, &size);
  std::string log(static_cast<std::size_t>(size > 0 ? size : 0), '\0');
  GLsizei written = 0;
  if (size > 0) get_log(name, size, &written, log.data());
  log.resize(static_cast<std::size_t>(written));
  return log;
}

// What a compiler says, in the one line that an error has.
std::string one_line(std::string log) {
  while (!log.empty() && (log.back() == '\n' || log.back() == '\0')) log.pop_back();
  for (std::size_t at = log.find('\n'); at != log.npos; at = log.find('\n', at)) log.replace(at, 1, "; ");
  return log;
}

// A shader object for as long as its program is linked.
struct Stage {
  const GlFunctions& gl;
  GLuint name;
  Stage(const GlFunctions& functions, GLenum kind, const ShaderText& source) : gl(functions), name(gl.CreateShader(kind)) {
    const char* text = source.text.c_str();
    gl.ShaderSource(name, 1, &text, nullptr);
    gl.CompileShader(name);
    GLint good = 0;
    gl.GetShaderiv(name, GL_COMPILE_STATUS, &good);
    if (good != 0) return;
    const std::string log = one_line(with_file_names(log_of(name, gl.GetShaderiv, gl.GetShaderInfoLog), source.files));
    gl.DeleteShader(name);
    throw MachineError("this OpenGL does not compile a shader: " + log);
  }
  ~Stage() { gl.DeleteShader(name); }
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;
};

}  // namespace

Program::Program(const GlFunctions& gl, const Stages& stages) : gl_(gl), name_(gl.CreateProgram()) {
  try {
    for (const auto& [kind, source] : stages) {
      const Stage stage(gl_, kind, source);
      gl_.AttachShader(name_, stage.name);  // keeps it until the program is linked and it is detached
    }
    gl_.LinkProgram(name_);
    GLint good = 0;
    gl_.GetProgramiv(name_, GL_LINK_STATUS, &good);
    if (good == 0) {
      throw MachineError("this OpenGL does not link " + stages.back().second.files.front() + ": " +
                         one_line(log_of(name_, gl_.GetProgramiv, gl_.GetProgramInfoLog)));
    }
  } catch (...) {
    gl_.DeleteProgram(name_);
    throw;
  }
}

Program::~Program() { gl_.DeleteProgram(name_); }

GLint Program::location(const char* uniform) {
  const auto found = locations_.find(uniform);
  if (found != locations_.end()) return found->second;
  return locations_[uniform] = gl_.GetUniformLocation(name_, uniform);
}

void Program::set(const char* uniform, float v) { gl_.ProgramUniform1f(name_, location(uniform), v); }
void Program::set(const char* uniform, int v) { gl_.ProgramUniform1i(name_, location(uniform), v); }
void Program::set(const char* uniform, glm::vec2 v) { gl_.ProgramUniform2f(name_, location(uniform), v.x, v.y); }
void Program::set(const char* uniform, glm::vec3 v) { gl_.ProgramUniform3f(name_, location(uniform), v.x, v.y, v.z); }

}  // namespace airlight
