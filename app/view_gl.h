// The window's OpenGL 3.2, by GLFW, so that nothing else of the program needs its library.
#pragma once

#include <GL/glcorearb.h>

// As gpu/functions.h has those of the backend. X(name, NAME)
#define AIRLIGHT_WINDOW_GL(X)               \
  X(AttachShader, ATTACHSHADER)             \
  X(BindTexture, BINDTEXTURE)               \
  X(BindVertexArray, BINDVERTEXARRAY)       \
  X(Clear, CLEAR)                           \
  X(ClearColor, CLEARCOLOR)                 \
  X(CompileShader, COMPILESHADER)           \
  X(CreateProgram, CREATEPROGRAM)           \
  X(CreateShader, CREATESHADER)             \
  X(DeleteSync, DELETESYNC)                 \
  X(DrawArrays, DRAWARRAYS)                 \
  X(FenceSync, FENCESYNC)                   \
  X(GenTextures, GENTEXTURES)               \
  X(GenVertexArrays, GENVERTEXARRAYS)       \
  X(GetProgramiv, GETPROGRAMIV)             \
  X(GetTexImage, GETTEXIMAGE)               \
  X(GetUniformLocation, GETUNIFORMLOCATION) \
  X(LinkProgram, LINKPROGRAM)               \
  X(PixelStorei, PIXELSTOREI)               \
  X(ReadBuffer, READBUFFER)                 \
  X(ReadPixels, READPIXELS)                 \
  X(ShaderSource, SHADERSOURCE)             \
  X(TexImage3D, TEXIMAGE3D)                 \
  X(TexParameteri, TEXPARAMETERI)           \
  X(Uniform1f, UNIFORM1F)                   \
  X(Uniform2f, UNIFORM2F)                   \
  X(UseProgram, USEPROGRAM)                 \
  X(Viewport, VIEWPORT)                     \
  X(WaitSync, WAITSYNC)

namespace airlight {

struct WindowGl {
#define AIRLIGHT_WINDOW_GL_MEMBER(name, NAME) PFNGL##NAME##PROC name = nullptr;
  AIRLIGHT_WINDOW_GL(AIRLIGHT_WINDOW_GL_MEMBER)
#undef AIRLIGHT_WINDOW_GL_MEMBER
};

}  // namespace airlight
