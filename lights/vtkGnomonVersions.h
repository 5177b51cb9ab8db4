#pragma once

// What VTK 9.1 to 9.6 call differently. What they do differently is in plugin/vtk_versions/; no
// other file asks for VTK's version.

#include "vtkObject.h" // for VTK_ABI_NAMESPACE_BEGIN, where there is one
#include "vtkVersionMacros.h"

// From 9.3 VTK's classes may live in an inline namespace, and so must their forward declarations.
#ifndef VTK_ABI_NAMESPACE_BEGIN
#define VTK_ABI_NAMESPACE_BEGIN
#define VTK_ABI_NAMESPACE_END
#endif

// Until 9.4 vtkCompositePolyDataMapper2 draws blocks by helpers; from 9.3 vtkCompositePolyDataMapper
// draws them in batches. Before that the latter has one polydata mapper a block.
#define GNOMON_VTK_HAS_BLOCK_HELPERS (VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 5, 0))
#define GNOMON_VTK_HAS_BLOCK_BATCHES (VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0))

// The library that loads OpenGL's functions: GLEW, from 9.4 glad. GNOMON_HAS_GL(VERSION_4_3) and
// GNOMON_HAS_GL(ARB_buffer_storage) tell what the context has.
#define GNOMON_VTK_HAS_GLAD (VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 4, 0))
#if GNOMON_VTK_HAS_GLAD
#define GNOMON_VTK_GL_HEADER <vtk_glad.h>
#define GNOMON_HAS_GL(what) GLAD_GL_##what
#else
#define GNOMON_VTK_GL_HEADER <vtk_glew.h>
#define GNOMON_HAS_GL(what) GLEW_##what
#endif

// From 9.6 readers of pictures take a stream in place of a buffer.
#define GNOMON_VTK_HAS_STREAMS (VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0))

// A key of vtkProp.
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0)
#define GNOMON_VTK_TEXTURE_TRANSFORM GENERAL_TEXTURE_TRANSFORM
#else
#define GNOMON_VTK_TEXTURE_TRANSFORM GeneralTextureTransform
#endif
