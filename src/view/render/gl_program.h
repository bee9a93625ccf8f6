#pragma once

#include <span>
#include <string>

#include <glm/glm.hpp>

namespace myotact::view {

/// A pair of shaders, shaders/NAME.vert and shaders/NAME.frag. Needs a current context from first to last.
class GlProgram {
 public:
  /// Throws Error NoInput when a file is missing, Internal with the compiler's message when it does not compile.
  explicit GlProgram(const std::string& name);
  ~GlProgram();
  GlProgram(const GlProgram&) = delete;
  GlProgram& operator=(const GlProgram&) = delete;

  void use() const;
  void set(const char* uniform, const glm::mat4& value) const;
  void set(const char* uniform, const glm::vec3& value) const;
  void set(const char* uniform, const glm::vec4& value) const;
  void set(const char* uniform, float value) const;
  void set(const char* uniform, std::span<const glm::vec3> values) const;

 private:
  unsigned program_ = 0;
};

}  // namespace myotact::view
