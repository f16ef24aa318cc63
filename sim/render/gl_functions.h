#pragma once

#include <GL/glcorearb.h>

// The OpenGL functions in use: X(middle part of the pointer type, name without gl).
#define HEDGEHOP_GL_FUNCTIONS(X)                                    \
  X(ACTIVETEXTURE, ActiveTexture)                                   \
  X(ATTACHSHADER, AttachShader)                                     \
  X(BINDBUFFER, BindBuffer)                                         \
  X(BINDFRAMEBUFFER, BindFramebuffer)                               \
  X(BINDRENDERBUFFER, BindRenderbuffer)                             \
  X(BINDTEXTURE, BindTexture)                                       \
  X(BINDVERTEXARRAY, BindVertexArray)                               \
  X(BLITFRAMEBUFFER, BlitFramebuffer)                               \
  X(BUFFERDATA, BufferData)                                         \
  X(CHECKFRAMEBUFFERSTATUS, CheckFramebufferStatus)                 \
  X(CLEARBUFFERFV, ClearBufferfv)                                   \
  X(CLEARBUFFERIV, ClearBufferiv)                                   \
  X(CLIPCONTROL, ClipControl)                                       \
  X(COMPILESHADER, CompileShader)                                   \
  X(CREATEPROGRAM, CreateProgram)                                   \
  X(CREATESHADER, CreateShader)                                     \
  X(CULLFACE, CullFace)                                             \
  X(DELETERENDERBUFFERS, DeleteRenderbuffers)                       \
  X(DELETESHADER, DeleteShader)                                     \
  X(DEPTHFUNC, DepthFunc)                                           \
  X(DISABLE, Disable)                                               \
  X(DRAWARRAYS, DrawArrays)                                         \
  X(DRAWBUFFER, DrawBuffer)                                         \
  X(DRAWELEMENTS, DrawElements)                                     \
  X(ENABLE, Enable)                                                 \
  X(ENABLEVERTEXATTRIBARRAY, EnableVertexAttribArray)               \
  X(FRAMEBUFFERRENDERBUFFER, FramebufferRenderbuffer)               \
  X(FRAMEBUFFERTEXTURE2D, FramebufferTexture2D)                     \
  X(FRONTFACE, FrontFace)                                           \
  X(GENBUFFERS, GenBuffers)                                         \
  X(GENFRAMEBUFFERS, GenFramebuffers)                               \
  X(GENRENDERBUFFERS, GenRenderbuffers)                             \
  X(GENTEXTURES, GenTextures)                                       \
  X(GENVERTEXARRAYS, GenVertexArrays)                               \
  X(GETERROR, GetError)                                             \
  X(GETPROGRAMINFOLOG, GetProgramInfoLog)                           \
  X(GETPROGRAMIV, GetProgramiv)                                     \
  X(GETRENDERBUFFERPARAMETERIV, GetRenderbufferParameteriv)         \
  X(GETSHADERINFOLOG, GetShaderInfoLog)                             \
  X(GETSHADERIV, GetShaderiv)                                       \
  X(GETINTEGERV, GetIntegerv)                                       \
  X(GETSTRING, GetString)                                           \
  X(GETUNIFORMLOCATION, GetUniformLocation)                         \
  X(LINKPROGRAM, LinkProgram)                                       \
  X(MULTIDRAWELEMENTS, MultiDrawElements)                           \
  X(PIXELSTOREI, PixelStorei)                                       \
  X(POLYGONOFFSET, PolygonOffset)                                   \
  X(READBUFFER, ReadBuffer)                                         \
  X(READPIXELS, ReadPixels)                                         \
  X(RENDERBUFFERSTORAGE, RenderbufferStorage)                       \
  X(RENDERBUFFERSTORAGEMULTISAMPLE, RenderbufferStorageMultisample) \
  X(SHADERSOURCE, ShaderSource)                                     \
  X(TEXIMAGE2D, TexImage2D)                                         \
  X(TEXIMAGE3D, TexImage3D)                                         \
  X(TEXPARAMETERI, TexParameteri)                                   \
  X(TEXSUBIMAGE3D, TexSubImage3D)                                   \
  X(UNIFORM1F, Uniform1f)                                           \
  X(UNIFORM1I, Uniform1i)                                           \
  X(UNIFORM3FV, Uniform3fv)                                         \
  X(UNIFORM4FV, Uniform4fv)                                         \
  X(UNIFORMMATRIX3FV, UniformMatrix3fv)                             \
  X(UNIFORMMATRIX4FV, UniformMatrix4fv)                             \
  X(USEPROGRAM, UseProgram)                                         \
  X(VERTEXATTRIBPOINTER, VertexAttribPointer)                       \
  X(VIEWPORT, Viewport)

namespace hedgehop::sim {

/// The OpenGL functions of a context. Hedgehop does not link to a GL library.
struct GlFunctions {
#define HEDGEHOP_GL_MEMBER(TYPE, NAME) PFNGL##TYPE##PROC NAME = nullptr;
  HEDGEHOP_GL_FUNCTIONS(HEDGEHOP_GL_MEMBER)
#undef HEDGEHOP_GL_MEMBER
};

/// Returns the table of functions.
/// @param address  returns the entry point for a name, or null. @param library  its name, for messages.
/// Throws std::runtime_error that names the library and the function if a function is missing.
GlFunctions load_gl(void (*(*address)(const char* name))(), const char* library);

/// Throws std::runtime_error with the code if an OpenGL error is pending.
/// @param activity  for the message, such as "drawing".
void check_gl(const GlFunctions& gl, const char* activity);

}  // namespace hedgehop::sim
