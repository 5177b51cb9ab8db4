#pragma once

#include <cstddef>
#include <string>

namespace gnomon
{

/// Return the line that gives a macro of GLSL an integer's value.
inline std::string glslDefine(const std::string& name, int value)
{
  return "#define " + name + " " + std::to_string(value) + "\n";
}

/// Return the name of one element of an array of uniforms.
inline std::string glslElement(const std::string& name, std::size_t index)
{
  return name + "[" + std::to_string(index) + "]";
}

} // namespace gnomon
