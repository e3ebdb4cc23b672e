// The OpenGL 4.5 entry points that this backend calls, as a table: nothing of GL is linked, so that a program starts on a machine
// without it and two contexts from different libraries can live side by side.
#pragma once

#include <GL/glcorearb.h>

// Each name without its "gl"; the type of glFooBar is PFNGLFOOBARPROC. X(name, NAME)
#define AIRLIGHT_GL_FUNCTIONS(X)                                \
  X(AttachShader, ATTACHSHADER)                                 \
  X(BindBuffer, BINDBUFFER)                                     \
  X(BindBufferBase, BINDBUFFERBASE)                             \
  X(BindFramebuffer, BINDFRAMEBUFFER)                           \
  X(BindImageTexture, BINDIMAGETEXTURE)                         \
  X(BindTextureUnit, BINDTEXTUREUNIT)                           \
  X(BindVertexArray, BINDVERTEXARRAY)                           \
  X(CheckNamedFramebufferStatus, CHECKNAMEDFRAMEBUFFERSTATUS)   \
  X(ClearNamedFramebufferfv, CLEARNAMEDFRAMEBUFFERFV)           \
  X(ClearNamedFramebufferuiv, CLEARNAMEDFRAMEBUFFERUIV)         \
  X(ClipControl, CLIPCONTROL)                                   \
  X(CompileShader, COMPILESHADER)                               \
  X(CopyNamedBufferSubData, COPYNAMEDBUFFERSUBDATA)             \
  X(CreateBuffers, CREATEBUFFERS)                               \
  X(CreateFramebuffers, CREATEFRAMEBUFFERS)                     \
  X(CreateProgram, CREATEPROGRAM)                               \
  X(CreateShader, CREATESHADER)                                 \
  X(CreateTextures, CREATETEXTURES)                             \
  X(CreateVertexArrays, CREATEVERTEXARRAYS)                     \
  X(DeleteBuffers, DELETEBUFFERS)                               \
  X(DeleteFramebuffers, DELETEFRAMEBUFFERS)                     \
  X(DeleteProgram, DELETEPROGRAM)                               \
  X(DeleteShader, DELETESHADER)                                 \
  X(DeleteSync, DELETESYNC)                                     \
  X(DeleteTextures, DELETETEXTURES)                             \
  X(DeleteVertexArrays, DELETEVERTEXARRAYS)                     \
  X(DepthFunc, DEPTHFUNC)                                       \
  X(DetachShader, DETACHSHADER)                                 \
  X(Disable, DISABLE)                                           \
  X(DispatchCompute, DISPATCHCOMPUTE)                           \
  X(DrawArrays, DRAWARRAYS)                                     \
  X(DrawElements, DRAWELEMENTS)                                 \
  X(Enable, ENABLE)                                             \
  X(EnableVertexArrayAttrib, ENABLEVERTEXARRAYATTRIB)           \
  X(FenceSync, FENCESYNC)                                       \
  X(Finish, FINISH)                                             \
  X(Flush, FLUSH)                                               \
  X(GetError, GETERROR)                                         \
  X(GetIntegerv, GETINTEGERV)                                   \
  X(GetInteger64v, GETINTEGER64V)                               \
  X(GetNamedBufferSubData, GETNAMEDBUFFERSUBDATA)               \
  X(GetProgramInfoLog, GETPROGRAMINFOLOG)                       \
  X(GetProgramiv, GETPROGRAMIV)                                 \
  X(GetShaderInfoLog, GETSHADERINFOLOG)                         \
  X(GetShaderiv, GETSHADERIV)                                   \
  X(GetString, GETSTRING)                                       \
  X(GetTextureSubImage, GETTEXTURESUBIMAGE)                     \
  X(GetUniformLocation, GETUNIFORMLOCATION)                     \
  X(LinkProgram, LINKPROGRAM)                                   \
  X(MemoryBarrier, MEMORYBARRIER)                               \
  X(NamedBufferData, NAMEDBUFFERDATA)                           \
  X(NamedBufferSubData, NAMEDBUFFERSUBDATA)                     \
  X(NamedFramebufferDrawBuffers, NAMEDFRAMEBUFFERDRAWBUFFERS)   \
  X(NamedFramebufferTexture, NAMEDFRAMEBUFFERTEXTURE)           \
  X(NamedFramebufferTextureLayer, NAMEDFRAMEBUFFERTEXTURELAYER) \
  X(PixelStorei, PIXELSTOREI)                                   \
  X(ProgramUniform1f, PROGRAMUNIFORM1F)                         \
  X(ProgramUniform1i, PROGRAMUNIFORM1I)                         \
  X(ProgramUniform1ui, PROGRAMUNIFORM1UI)                       \
  X(ProgramUniform2f, PROGRAMUNIFORM2F)                         \
  X(ProgramUniform3f, PROGRAMUNIFORM3F)                         \
  X(Scissor, SCISSOR)                                           \
  X(ShaderSource, SHADERSOURCE)                                 \
  X(TextureBuffer, TEXTUREBUFFER)                               \
  X(TextureParameteri, TEXTUREPARAMETERI)                       \
  X(TextureStorage2D, TEXTURESTORAGE2D)                         \
  X(TextureStorage3D, TEXTURESTORAGE3D)                         \
  X(TextureSubImage3D, TEXTURESUBIMAGE3D)                       \
  X(UseProgram, USEPROGRAM)                                     \
  X(VertexArrayAttribBinding, VERTEXARRAYATTRIBBINDING)         \
  X(VertexArrayAttribFormat, VERTEXARRAYATTRIBFORMAT)           \
  X(VertexArrayElementBuffer, VERTEXARRAYELEMENTBUFFER)         \
  X(VertexArrayVertexBuffer, VERTEXARRAYVERTEXBUFFER)           \
  X(Viewport, VIEWPORT)                                         \
  X(WaitSync, WAITSYNC)

namespace airlight {

struct GlFunctions {
#define AIRLIGHT_GL_MEMBER(name, NAME) PFNGL##NAME##PROC name = nullptr;
  AIRLIGHT_GL_FUNCTIONS(AIRLIGHT_GL_MEMBER)
#undef AIRLIGHT_GL_MEMBER
};

}  // namespace airlight
