// A libOSMesa.so.8 that hands everything on to Mesa's, but for what AIRLIGHT_GL_FAULT names.
#include <GL/glcorearb.h>
#include <dlfcn.h>

#include <cstdlib>
#include <cstring>

namespace {

void* entry(const char* name) {
  static void* const mesa = dlopen("libOSMesa.so.8.0.0", RTLD_LAZY | RTLD_LOCAL);
  return mesa != nullptr ? dlsym(mesa, name) : nullptr;
}

template <class F>
F mesas(const char* name) {
  return reinterpret_cast<F>(entry(name));
}

using Function = void (*)();
Function resolve(const char* name) { return mesas<Function (*)(const char*)>("OSMesaGetProcAddress")(name); }

bool fault(const char* name) {
  const char* asked = std::getenv("AIRLIGHT_GL_FAULT");
  return asked != nullptr && std::strcmp(asked, name) == 0;
}

void get_integer(GLenum what, GLint* value) {
  reinterpret_cast<PFNGLGETINTEGERVPROC>(resolve("glGetIntegerv"))(what, value);
  if (fault("old") && what == GL_MINOR_VERSION) *value = 3;
  if (fault("texture") && what == GL_MAX_TEXTURE_SIZE) *value = 16;
  if (fault("layers") && what == GL_MAX_ARRAY_TEXTURE_LAYERS) *value = 0;
}

void get_integer64(GLenum what, GLint64* value) {
  reinterpret_cast<PFNGLGETINTEGER64VPROC>(resolve("glGetInteger64v"))(what, value);
  if (fault("storage") && what == GL_MAX_SHADER_STORAGE_BLOCK_SIZE) *value = 64;
  if (fault("small") && what == GL_MAX_SHADER_STORAGE_BLOCK_SIZE) *value = 1 << 24;
}

GLenum get_error() {
  static int calls = 0;
  ++calls;
  if (fault("memory") && calls == 12) return GL_OUT_OF_MEMORY;
  if (fault("lost") && calls >= 12) return GL_CONTEXT_LOST;
  return reinterpret_cast<PFNGLGETERRORPROC>(resolve("glGetError"))();
}

void shader_source(GLuint shader, GLsizei, const GLchar* const*, const GLint*) {
  const char* text = "#version 450\nvoid main() { no; }\nnor this\n";
  reinterpret_cast<PFNGLSHADERSOURCEPROC>(resolve("glShaderSource"))(shader, 1, &text, nullptr);
}

}  // namespace

extern "C" {
void* OSMesaCreateContextAttribs(const int* attributes, void* shared) {
  if (fault("context")) return nullptr;
  return mesas<void* (*)(const int*, void*)>("OSMesaCreateContextAttribs")(attributes, shared);
}
void OSMesaDestroyContext(void* context) { mesas<void (*)(void*)>("OSMesaDestroyContext")(context); }
unsigned char OSMesaMakeCurrent(void* context, void* buffer, unsigned type, int width, int height) {
  return mesas<unsigned char (*)(void*, void*, unsigned, int, int)>("OSMesaMakeCurrent")(context, buffer, type, width, height);
}
void* OSMesaGetCurrentContext() { return mesas<void* (*)()>("OSMesaGetCurrentContext")(); }
void OSMesaGetIntegerv(int what, int* value) { mesas<void (*)(int, int*)>("OSMesaGetIntegerv")(what, value); }
unsigned char OSMesaGetColorBuffer(void* context, int* width, int* height, int* format, void** buffer) {
  return mesas<unsigned char (*)(void*, int*, int*, int*, void**)>("OSMesaGetColorBuffer")(context, width, height, format,
                                                                                           buffer);
}
Function OSMesaGetProcAddress(const char* name) {
  if (fault("missing") && std::strcmp(name, "glDispatchCompute") == 0) return nullptr;
  if (std::strcmp(name, "glGetIntegerv") == 0) return reinterpret_cast<Function>(&get_integer);
  if (std::strcmp(name, "glGetInteger64v") == 0) return reinterpret_cast<Function>(&get_integer64);
  if (std::strcmp(name, "glGetError") == 0) return reinterpret_cast<Function>(&get_error);
  if (fault("compile") && std::strcmp(name, "glShaderSource") == 0) return reinterpret_cast<Function>(&shader_source);
  return resolve(name);
}
}
