#pragma once

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/Technique.h"

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace gnomon
{

/// A shader does not compile, does not link, or does not exist. The message names it.
class ShaderError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// GLSL sources by name, their includes and variants, and the programs built from them.
class ShaderLibrary
{
public:
  /// Return the text of an embedded file. Its `#include "path"` lines (paths from the project's
  /// root) are replaced by the files they name, each at most once.
  /// @throws ShaderError for a file that is not embedded
  static std::string source(const std::string& path);

  struct Stage
  {
    GLenum type;        ///< GL_VERTEX_SHADER, ...
    std::string source; ///< without the #version line and the defines
  };

  /// Return the program of these stages and defines ("NAME" or "NAME value"), compiled on first
  /// use.
  /// @throws ShaderError with the compiler's log
  GLuint program(const std::vector<Stage>& stages, const std::vector<std::string>& defines = {});

  /// Set a uniform of the program in use; names that it does not use are ignored. The uniform of a
  /// texture is its unit, an int; the caller binds the texture.
  static void setUniform(GLuint program, const Uniform& uniform);

  /// Bind the textures among `uniforms` to units from `firstUnit` on, and set all uniforms. In
  /// their names, _LIGHT stands for `light`.
  /// @return the first free unit
  static int setUniforms(
    GLuint program, const std::vector<Uniform>& uniforms, int light, int firstUnit);

  int compiles() const { return this->compiles_; }

private:
  std::map<std::string, GlProgram> programs_;
  int compiles_ = 0;
};

/// Return the text with every identifier that ends in _LIGHT numbered: `map_LIGHT` becomes `map_3`.
std::string numberedForLight(const std::string& text, int light);

} // namespace gnomon
