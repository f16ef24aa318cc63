#pragma once

#include <cstddef>

// The part of OpenGL that Hedgehop uses, declared here so that no package of OpenGL is needed to build it: types of
// [OpenGL2017] table 2.2, values and parameters as in its registry. A test compares them with Khronos' headers.

namespace hedgehop::sim {

using GLenum = unsigned int;
using GLbitfield = unsigned int;
using GLuint = unsigned int;
using GLint = int;
using GLsizei = int;
using GLboolean = unsigned char;
using GLubyte = unsigned char;
using GLchar = char;
using GLfloat = float;
using GLsizeiptr = std::ptrdiff_t;

}  // namespace hedgehop::sim

// X(name without GL_, value)
#define HEDGEHOP_GL_CONSTANTS(X)    \
  X(FALSE, 0)                       \
  X(TRUE, 1)                        \
  X(NONE, 0)                        \
  X(NO_ERROR, 0)                    \
  X(TRIANGLES, 0x0004)              \
  X(GEQUAL, 0x0206)                 \
  X(CW, 0x0900)                     \
  X(CULL_FACE, 0x0B44)              \
  X(DEPTH_TEST, 0x0B71)             \
  X(PACK_ROW_LENGTH, 0x0D02)        \
  X(PACK_ALIGNMENT, 0x0D05)         \
  X(TEXTURE_2D, 0x0DE1)             \
  X(UNSIGNED_BYTE, 0x1401)          \
  X(INT, 0x1404)                    \
  X(UNSIGNED_INT, 0x1405)           \
  X(FLOAT, 0x1406)                  \
  X(COLOR, 0x1800)                  \
  X(DEPTH, 0x1801)                  \
  X(DEPTH_COMPONENT, 0x1902)        \
  X(RED, 0x1903)                    \
  X(RGB, 0x1907)                    \
  X(RGBA, 0x1908)                   \
  X(VENDOR, 0x1F00)                 \
  X(RENDERER, 0x1F01)               \
  X(VERSION, 0x1F02)                \
  X(NEAREST, 0x2600)                \
  X(LINEAR, 0x2601)                 \
  X(LINEAR_MIPMAP_LINEAR, 0x2703)   \
  X(TEXTURE_MAG_FILTER, 0x2800)     \
  X(TEXTURE_MIN_FILTER, 0x2801)     \
  X(TEXTURE_WRAP_S, 0x2802)         \
  X(TEXTURE_WRAP_T, 0x2803)         \
  X(COLOR_BUFFER_BIT, 0x4000)       \
  X(POLYGON_OFFSET_FILL, 0x8037)    \
  X(RGBA8, 0x8058)                  \
  X(CLAMP_TO_BORDER, 0x812D)        \
  X(R8, 0x8229)                     \
  X(R32F, 0x822E)                   \
  X(R32I, 0x8235)                   \
  X(TEXTURE0, 0x84C0)               \
  X(TEXTURE1, 0x84C1)               \
  X(MAX_RENDERBUFFER_SIZE, 0x84E8)  \
  X(RGBA32F, 0x8814)                \
  X(TEXTURE_COMPARE_MODE, 0x884C)   \
  X(TEXTURE_COMPARE_FUNC, 0x884D)   \
  X(COMPARE_REF_TO_TEXTURE, 0x884E) \
  X(ARRAY_BUFFER, 0x8892)           \
  X(ELEMENT_ARRAY_BUFFER, 0x8893)   \
  X(STATIC_DRAW, 0x88E4)            \
  X(FRAGMENT_SHADER, 0x8B30)        \
  X(VERTEX_SHADER, 0x8B31)          \
  X(COMPILE_STATUS, 0x8B81)         \
  X(LINK_STATUS, 0x8B82)            \
  X(TEXTURE_2D_ARRAY, 0x8C1A)       \
  X(LOWER_LEFT, 0x8CA1)             \
  X(READ_FRAMEBUFFER, 0x8CA8)       \
  X(DRAW_FRAMEBUFFER, 0x8CA9)       \
  X(RENDERBUFFER_SAMPLES, 0x8CAB)   \
  X(DEPTH_COMPONENT32F, 0x8CAC)     \
  X(FRAMEBUFFER_COMPLETE, 0x8CD5)   \
  X(COLOR_ATTACHMENT0, 0x8CE0)      \
  X(DEPTH_ATTACHMENT, 0x8D00)       \
  X(FRAMEBUFFER, 0x8D40)            \
  X(RENDERBUFFER, 0x8D41)           \
  X(MAX_SAMPLES, 0x8D57)            \
  X(RED_INTEGER, 0x8D94)            \
  X(ZERO_TO_ONE, 0x935F)

// X(result, name without gl, parameters)
#define HEDGEHOP_GL_FUNCTIONS(X)                                                                                       \
  X(void, ActiveTexture, (GLenum))                                                                                     \
  X(void, AttachShader, (GLuint, GLuint))                                                                              \
  X(void, BindBuffer, (GLenum, GLuint))                                                                                \
  X(void, BindFramebuffer, (GLenum, GLuint))                                                                           \
  X(void, BindRenderbuffer, (GLenum, GLuint))                                                                          \
  X(void, BindTexture, (GLenum, GLuint))                                                                               \
  X(void, BindVertexArray, (GLuint))                                                                                   \
  X(void, BlitFramebuffer, (GLint, GLint, GLint, GLint, GLint, GLint, GLint, GLint, GLbitfield, GLenum))               \
  X(void, BufferData, (GLenum, GLsizeiptr, const void*, GLenum))                                                       \
  X(GLenum, CheckFramebufferStatus, (GLenum))                                                                          \
  X(void, ClearBufferfv, (GLenum, GLint, const GLfloat*))                                                              \
  X(void, ClearBufferiv, (GLenum, GLint, const GLint*))                                                                \
  X(void, ClipControl, (GLenum, GLenum))                                                                               \
  X(void, CompileShader, (GLuint))                                                                                     \
  X(GLuint, CreateProgram, ())                                                                                         \
  X(GLuint, CreateShader, (GLenum))                                                                                    \
  X(void, CullFace, (GLenum))                                                                                          \
  X(void, DeleteRenderbuffers, (GLsizei, const GLuint*))                                                               \
  X(void, DeleteShader, (GLuint))                                                                                      \
  X(void, DepthFunc, (GLenum))                                                                                         \
  X(void, Disable, (GLenum))                                                                                           \
  X(void, DrawArrays, (GLenum, GLint, GLsizei))                                                                        \
  X(void, DrawBuffer, (GLenum))                                                                                        \
  X(void, DrawElements, (GLenum, GLsizei, GLenum, const void*))                                                        \
  X(void, Enable, (GLenum))                                                                                            \
  X(void, EnableVertexAttribArray, (GLuint))                                                                           \
  X(void, FramebufferRenderbuffer, (GLenum, GLenum, GLenum, GLuint))                                                   \
  X(void, FramebufferTexture2D, (GLenum, GLenum, GLenum, GLuint, GLint))                                               \
  X(void, FrontFace, (GLenum))                                                                                         \
  X(void, GenBuffers, (GLsizei, GLuint*))                                                                              \
  X(void, GenFramebuffers, (GLsizei, GLuint*))                                                                         \
  X(void, GenRenderbuffers, (GLsizei, GLuint*))                                                                        \
  X(void, GenTextures, (GLsizei, GLuint*))                                                                             \
  X(void, GenVertexArrays, (GLsizei, GLuint*))                                                                         \
  X(GLenum, GetError, ())                                                                                              \
  X(void, GetProgramInfoLog, (GLuint, GLsizei, GLsizei*, GLchar*))                                                     \
  X(void, GetProgramiv, (GLuint, GLenum, GLint*))                                                                      \
  X(void, GetRenderbufferParameteriv, (GLenum, GLenum, GLint*))                                                        \
  X(void, GetShaderInfoLog, (GLuint, GLsizei, GLsizei*, GLchar*))                                                      \
  X(void, GetShaderiv, (GLuint, GLenum, GLint*))                                                                       \
  X(void, GetIntegerv, (GLenum, GLint*))                                                                               \
  X(const GLubyte*, GetString, (GLenum))                                                                               \
  X(GLint, GetUniformLocation, (GLuint, const GLchar*))                                                                \
  X(void, LinkProgram, (GLuint))                                                                                       \
  X(void, MultiDrawElements, (GLenum, const GLsizei*, GLenum, const void* const*, GLsizei))                            \
  X(void, PixelStorei, (GLenum, GLint))                                                                                \
  X(void, PolygonOffset, (GLfloat, GLfloat))                                                                           \
  X(void, ReadBuffer, (GLenum))                                                                                        \
  X(void, ReadPixels, (GLint, GLint, GLsizei, GLsizei, GLenum, GLenum, void*))                                         \
  X(void, RenderbufferStorage, (GLenum, GLenum, GLsizei, GLsizei))                                                     \
  X(void, RenderbufferStorageMultisample, (GLenum, GLsizei, GLenum, GLsizei, GLsizei))                                 \
  X(void, ShaderSource, (GLuint, GLsizei, const GLchar* const*, const GLint*))                                         \
  X(void, TexImage2D, (GLenum, GLint, GLint, GLsizei, GLsizei, GLint, GLenum, GLenum, const void*))                    \
  X(void, TexImage3D, (GLenum, GLint, GLint, GLsizei, GLsizei, GLsizei, GLint, GLenum, GLenum, const void*))           \
  X(void, TexParameteri, (GLenum, GLenum, GLint))                                                                      \
  X(void, TexSubImage3D, (GLenum, GLint, GLint, GLint, GLint, GLsizei, GLsizei, GLsizei, GLenum, GLenum, const void*)) \
  X(void, Uniform1f, (GLint, GLfloat))                                                                                 \
  X(void, Uniform1i, (GLint, GLint))                                                                                   \
  X(void, Uniform3fv, (GLint, GLsizei, const GLfloat*))                                                                \
  X(void, Uniform4fv, (GLint, GLsizei, const GLfloat*))                                                                \
  X(void, UniformMatrix3fv, (GLint, GLsizei, GLboolean, const GLfloat*))                                               \
  X(void, UniformMatrix4fv, (GLint, GLsizei, GLboolean, const GLfloat*))                                               \
  X(void, UseProgram, (GLuint))                                                                                        \
  X(void, VertexAttribPointer, (GLuint, GLint, GLenum, GLboolean, GLsizei, const void*))                               \
  X(void, Viewport, (GLint, GLint, GLsizei, GLsizei))
