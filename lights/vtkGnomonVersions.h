#pragma once

// Names that differ between VTK 9.1 and 9.6. plugin/vtk_versions/ holds differences in behaviour.
// No other file checks VTK's version.

#include "vtkObject.h" // for VTK_ABI_NAMESPACE_BEGIN, where there is one
#include "vtkVersionMacros.h"

// From 9.3, VTK's classes may live in an inline namespace. Their forward declarations must, too.
#ifndef VTK_ABI_NAMESPACE_BEGIN
#define VTK_ABI_NAMESPACE_BEGIN
#define VTK_ABI_NAMESPACE_END
#endif

// Until 9.4, vtkCompositePolyDataMapper2 draws blocks by helpers. From 9.3,
// vtkCompositePolyDataMapper draws them in batches; until 9.2, it has one polydata mapper per
// block.
#define GNOMON_VTK_HAS_BLOCK_HELPERS (VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 5, 0))
#define GNOMON_VTK_HAS_BLOCK_BATCHES (VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0))

// The library that loads OpenGL's functions: GLEW, or glad from 9.4. GNOMON_HAS_GL(VERSION_4_3) is
// true if the context has that version.
#define GNOMON_VTK_HAS_GLAD (VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 4, 0))
#if GNOMON_VTK_HAS_GLAD
#define GNOMON_VTK_GL_HEADER <vtk_glad.h>
#define GNOMON_HAS_GL(what) GLAD_GL_##what
#else
#define GNOMON_VTK_GL_HEADER <vtk_glew.h>
#define GNOMON_HAS_GL(what) GLEW_##what
#endif

// From 9.6, readers of pictures take a stream instead of a buffer.
#define GNOMON_VTK_HAS_STREAMS (VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0))

// A key of vtkProp.
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0)
#define GNOMON_VTK_TEXTURE_TRANSFORM GENERAL_TEXTURE_TRANSFORM
#else
#define GNOMON_VTK_TEXTURE_TRANSFORM GeneralTextureTransform
#endif
