# Every package that Gnomon stands on, found in one place.
find_package(VTK 9.1 REQUIRED COMPONENTS
  CommonColor
  CommonCore
  CommonDataModel
  CommonExecutionModel
  CommonMath
  CommonTransforms
  DomainsChemistry
  DomainsChemistryOpenGL2
  FiltersCore
  FiltersGeneral
  FiltersModeling
  FiltersSources
  FiltersTexture
  IOGeometry
  IOImage
  IOImport
  IOPLY
  IOXML
  IOXMLParser
  ImagingCore
  InteractionStyle
  InteractionWidgets
  ParallelCore
  RenderingAnnotation
  RenderingCore
  RenderingLOD
  RenderingOpenGL2
  RenderingUI
  RenderingFreeType
  RenderingVolume
  RenderingVolumeOpenGL2
  OPTIONAL_COMPONENTS
  ParallelMPI
  glew
  glad)
if(GNOMON_WRAP_PYTHON AND NOT VTK_WRAP_PYTHON)
  message(STATUS "No Python package: this VTK is built without Python")
  set(GNOMON_WRAP_PYTHON OFF)
endif()
if(GNOMON_WRAP_PYTHON)
  # Another Python on the path has no wrappers of the system's VTK.
  if(VTK_DIR MATCHES "^/usr/lib" AND NOT DEFINED Python3_EXECUTABLE)
    set(Python3_EXECUTABLE /usr/bin/python3)
  endif()
  find_package(Python3 REQUIRED COMPONENTS Interpreter Development.Module)
  find_package(VTK 9.1 REQUIRED COMPONENTS Python WrappingPythonCore)
endif()
include(GnomonLibraries)
if(GNOMON_BUILD_EXAMPLES)
  find_package(CLI11 REQUIRED)
  find_package(OpenEXR 3 REQUIRED)
  find_package(PNG REQUIRED)
  find_package(ZLIB REQUIRED)
  find_path(GNOMON_MUSTACHE_INCLUDE_DIR kainjow/mustache.hpp REQUIRED)
endif()

# What tests use where it is there: VTK's widget for Qt 5 or 6. Debian's VTK names the module also
# where libvtk9-qt-dev is missing.
if(GNOMON_BUILD_TESTS AND TARGET VTK::GUISupportQt)
  find_package(VTK 9.1 QUIET OPTIONAL_COMPONENTS GUISupportQt)
  if(VTK_GUISupportQt_FOUND)
    find_path(GNOMON_QVTK_INCLUDE_DIR QVTKOpenGLNativeWidget.h
      PATH_SUFFIXES "vtk-${VTK_MAJOR_VERSION}.${VTK_MINOR_VERSION}")
  endif()
endif()
