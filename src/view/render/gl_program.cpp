#include "view/render/gl_program.h"

#include <array>

#include <epoxy/gl.h>

#include "core/data_folder.h"
#include "core/error.h"
#include "core/file.h"

namespace myotact::view {

namespace {

GLuint compile(const std::string& file, GLenum stage) {
  const auto path = data_folder() / "shaders" / file;
  const std::string source = read_file(path);
  const char* text = source.c_str();
  const GLuint shader = glCreateShader(stage);
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint compiled = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_TRUE) return shader;
  std::array<char, 1024> message{};
  glGetShaderInfoLog(shader, static_cast<GLsizei>(message.size()), nullptr, message.data());
  glDeleteShader(shader);
  throw Error(ExitStatus::Internal, path.string() + ": does not compile: " + message.data());
}

}  // namespace

GlProgram::GlProgram(const std::string& name) {
  const GLuint vertex = compile(name + ".vert", GL_VERTEX_SHADER);
  const GLuint fragment = compile(name + ".frag", GL_FRAGMENT_SHADER);
  program_ = glCreateProgram();
  glAttachShader(program_, vertex);
  glAttachShader(program_, fragment);
  glLinkProgram(program_);
  glDeleteShader(vertex);
  glDeleteShader(fragment);
  GLint linked = 0;
  glGetProgramiv(program_, GL_LINK_STATUS, &linked);
  if (linked != GL_TRUE) throw Error(ExitStatus::Internal, "shaders/" + name + ": does not link");
}

GlProgram::~GlProgram() {
  glDeleteProgram(program_);
}

void GlProgram::use() const {
  glUseProgram(program_);
}

void GlProgram::set(const char* uniform, const glm::mat4& value) const {
  glUniformMatrix4fv(glGetUniformLocation(program_, uniform), 1, GL_FALSE, &value[0][0]);
}

void GlProgram::set(const char* uniform, const glm::vec3& value) const {
  glUniform3fv(glGetUniformLocation(program_, uniform), 1, &value[0]);
}

void GlProgram::set(const char* uniform, const glm::vec4& value) const {
  glUniform4fv(glGetUniformLocation(program_, uniform), 1, &value[0]);
}

void GlProgram::set(const char* uniform, float value) const {
  glUniform1f(glGetUniformLocation(program_, uniform), value);
}

void GlProgram::set(const char* uniform, std::span<const glm::vec3> values) const {
  glUniform3fv(glGetUniformLocation(program_, uniform), static_cast<GLsizei>(values.size()), &values[0][0]);
}

}  // namespace myotact::view
