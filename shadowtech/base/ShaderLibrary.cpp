#include "shadowtech/base/ShaderLibrary.h"

#include "shadowtech/base/EmbeddedShaders.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cctype>
#include <memory>
#include <set>

namespace gnomon
{
namespace
{

/// Return the #version line. Below OpenGL 4.3, shaders need only explicit attribute locations.
const char* versionLine()
{
  return GNOMON_HAS_GL(VERSION_4_3) ? "#version 430 core\n"
    : GNOMON_HAS_GL(VERSION_3_3)    ? "#version 330 core\n"
                                    : "#version 150 core\n"
                                      "#extension GL_ARB_explicit_attrib_location : require\n";
}

/// The beginning of lines that include a file.
const std::string includeOf = "#include \"";

/// Return the position of the next line that includes a file; npos if there is none.
std::size_t nextInclude(const std::string& source, std::size_t from)
{
  std::size_t at = source.find(includeOf, from);
  while (at != std::string::npos && at > 0 && source[at - 1] != '\n')
  {
    at = source.find(includeOf, at + 1);
  }
  return at;
}

void appendWithIncludes(const std::string& path, std::set<std::string>& seen, std::string& text)
{
  if (!seen.insert(path).second)
  {
    return;
  }
  const auto found = embeddedShaders().find(path);
  if (found == embeddedShaders().end())
  {
    throw ShaderError("no such shader source: " + path);
  }
  // Frames ask for sources again and again, so the text between includes is copied as a whole.
  const std::string& source = found->second;
  std::size_t copied = 0;
  for (std::size_t at = nextInclude(source, 0); at != std::string::npos;
       at = nextInclude(source, copied))
  {
    text.append(source, copied, at - copied);
    const std::size_t name = at + includeOf.size();
    const std::size_t nameEnd = source.find('"', name);
    appendWithIncludes(source.substr(name, nameEnd - name), seen, text);
    copied = std::min(source.find('\n', nameEnd), source.size() - 1) + 1;
  }
  text.append(source, copied);
}

std::string infoLog(GLuint object, bool isProgram)
{
  GLint length = 0;
  isProgram ? glGetProgramiv(object, GL_INFO_LOG_LENGTH, &length)
            : glGetShaderiv(object, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(length > 0 ? length : 0), '\0');
  if (length > 0)
  {
    isProgram ? glGetProgramInfoLog(object, length, nullptr, log.data())
              : glGetShaderInfoLog(object, length, nullptr, log.data());
    log.pop_back(); // the terminator, which would end the error's text
  }
  return log;
}

/// A compiled shader, deleted when it goes out of scope after linking.
class Shader
{
public:
  Shader(GLenum type, const std::string& source)
    : name(glCreateShader(type))
  {
    const char* text = source.c_str();
    glShaderSource(this->name, 1, &text, nullptr);
    glCompileShader(this->name);
    GLint compiled = 0;
    glGetShaderiv(this->name, GL_COMPILE_STATUS, &compiled);
    if (!compiled)
    {
      const std::string log = infoLog(this->name, false);
      glDeleteShader(this->name);
      throw ShaderError("a shader does not compile:\n" + log + "\n" + source);
    }
  }
  Shader& operator=(Shader&&) = delete; ///< nor copied
  ~Shader() { glDeleteShader(this->name); }

  const GLuint name;
};

} // namespace

std::string ShaderLibrary::source(const std::string& path)
{
  std::set<std::string> seen;
  std::string text;
  appendWithIncludes(path, seen, text);
  return text;
}

std::string numberedForLight(const std::string& text, int light)
{
  const std::string suffix = "_LIGHT";
  const std::string number = "_" + std::to_string(light);
  const auto continues = [&](std::size_t at)
  {
    return at < text.size() &&
      (std::isalnum(static_cast<unsigned char>(text[at])) || text[at] == '_');
  };
  std::string numbered;
  numbered.reserve(text.size());
  std::size_t copied = 0;
  for (std::size_t at = text.find(suffix); at != std::string::npos; at = text.find(suffix, copied))
  {
    const std::size_t end = at + suffix.size();
    numbered.append(text, copied, at - copied);
    numbered += continues(end) ? suffix : number;
    copied = end;
  }
  return numbered.append(text, copied);
}

GLuint ShaderLibrary::program(
  const std::vector<Stage>& stages, const std::vector<std::string>& defines)
{
  std::string header = versionLine();
  for (const std::string& define : defines)
  {
    header += "#define " + define + "\n";
  }
  std::string key = header;
  for (const Stage& stage : stages)
  {
    key += std::to_string(stage.type) + "\n" + stage.source;
  }
  GlProgram& program = this->programs_[key];
  if (program)
  {
    return program.name();
  }

  GlProgram built;
  built.create();
  std::vector<std::unique_ptr<Shader>> shaders;
  for (const Stage& stage : stages)
  {
    shaders.push_back(std::make_unique<Shader>(stage.type, header + stage.source));
    glAttachShader(built.name(), shaders.back()->name);
  }
  glLinkProgram(built.name());
  for (const auto& shader : shaders)
  {
    glDetachShader(built.name(), shader->name);
  }
  GLint linked = 0;
  glGetProgramiv(built.name(), GL_LINK_STATUS, &linked);
  if (!linked)
  {
    throw ShaderError("a program does not link:\n" + infoLog(built.name(), true));
  }
  ++this->compiles_;
  program = std::move(built);
  return program.name();
}

void ShaderLibrary::setUniform(GLuint program, const Uniform& uniform)
{
  const GLint location = glGetUniformLocation(program, uniform.name.c_str());
  if (location < 0)
  {
    return;
  }
  struct Setter
  {
    GLint location;
    void operator()(int v) const { glUniform1i(location, v); }
    void operator()(float v) const { glUniform1f(location, v); }
    void operator()(const glm::ivec2& v) const { glUniform2iv(location, 1, glm::value_ptr(v)); }
    void operator()(const glm::vec2& v) const { glUniform2fv(location, 1, glm::value_ptr(v)); }
    void operator()(const glm::vec3& v) const { glUniform3fv(location, 1, glm::value_ptr(v)); }
    void operator()(const glm::vec4& v) const { glUniform4fv(location, 1, glm::value_ptr(v)); }
    void operator()(const glm::mat3& v) const
    {
      glUniformMatrix3fv(location, 1, GL_FALSE, glm::value_ptr(v));
    }
    void operator()(const glm::mat4& v) const
    {
      glUniformMatrix4fv(location, 1, GL_FALSE, glm::value_ptr(v));
    }
    void operator()(const TextureBinding&) const
    {
      throw ShaderError("a texture was set as a uniform without a unit");
    }
  };
  std::visit(Setter{ location }, uniform.value);
}

int ShaderLibrary::setUniforms(
  GLuint program, const std::vector<Uniform>& uniforms, int light, int firstUnit)
{
  int unit = firstUnit;
  for (Uniform uniform : uniforms)
  {
    uniform.name = numberedForLight(uniform.name, light);
    if (const auto* texture = std::get_if<TextureBinding>(&uniform.value))
    {
      glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
      glBindTexture(texture->target, texture->texture);
      uniform.value = unit++;
    }
    setUniform(program, uniform);
  }
  return unit;
}

} // namespace gnomon
