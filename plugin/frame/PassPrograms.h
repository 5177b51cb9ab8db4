#pragma once

#include "plugin/frame/ShaderManager.h"
#include "plugin/frame/TriangleNumbers.h"
#include "shadowtech/base/ShaderLibrary.h"

namespace gnomon
{

/// The programs of a pass: what its shaders do, and those compiled for Gnomon's own stages.
struct PassPrograms
{
  ShaderManager shaders;
  ShaderLibrary library;
  TriangleNumbers numbers;
};

} // namespace gnomon
