// Compiled shader programs.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "gpu/functions.h"
#include "gpu/shader_text.h"

namespace airlight {

class Program {
 public:
  using Stages = std::vector<std::pair<GLenum, ShaderText>>;
  // Stages, each GL_VERTEX_SHADER and so on. The context must be current, here and in every call. Throws MachineError with the
  // compiler's log, file names and lines in it.
  Program(const GlFunctions&, const Stages& stages);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void use() const { gl_.UseProgram(name_); }
  // A uniform that the compiler has left out is passed over.
  void set(const char* uniform, float);
  void set(const char* uniform, int);
  void set(const char* uniform, glm::vec2);
  void set(const char* uniform, glm::vec3);
  GLuint name() const { return name_; }

 private:
  GLint location(const char* uniform);

  const GlFunctions& gl_;
  GLuint name_ = 0;
  std::map<std::string, GLint, std::less<>> locations_;
};

}  // namespace airlight
