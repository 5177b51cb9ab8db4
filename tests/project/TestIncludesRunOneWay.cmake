# Check that includes run one way, folder by folder. Each folder lists the folders that it may
# include beside itself, all of them above it, so the list has no cycles. Nothing includes examples/
# or tests/, lights/ includes no OpenGL, and plugin/plan/ neither OpenGL, VTK nor the report. One
# file a system includes headers of window systems and operating systems.
#
#   cmake -D SOURCE_DIR=... -P
cmake_minimum_required(VERSION 3.25)

set(folders "")
# folder(<name> <folders that it may include>...)
macro(folder name)
  foreach(target ${ARGN})
    if(NOT target IN_LIST folders)
      message(FATAL_ERROR "${name} may include ${target}, which does not stand above it.")
    endif()
  endforeach()
  list(APPEND folders ${name})
  set(may_include_${name} ${name} ${ARGN})
endmacro()

folder(lights)
folder(shadowtech/base lights)
# Folders that several techniques share.
folder(shadowtech/depth_map lights shadowtech/base)
folder(shadowtech/moment_map lights shadowtech/base)
folder(shadowtech/mesh lights shadowtech/base)
folder(shadowtech/tracing lights shadowtech/base)
folder(shadowtech/probing lights shadowtech/base shadowtech/tracing)
folder(shadowtech/fitting lights shadowtech/base)
folder(shadowtech/exact lights shadowtech/base shadowtech/mesh shadowtech/tracing)
# All other folders are techniques: none includes another's.
set(shared ${folders})
file(GLOB techniques LIST_DIRECTORIES true RELATIVE "${SOURCE_DIR}" "${SOURCE_DIR}/shadowtech/*")
list(FILTER techniques EXCLUDE REGEX "\\.")
list(REMOVE_ITEM techniques ${shared})
foreach(technique IN LISTS techniques)
  folder(${technique} ${shared})
endforeach()
folder(shadowtech ${shared} ${techniques}) # the registry
folder(plugin/ranks lights shadowtech/base)
folder(plugin/window lights shadowtech/base)
# Differences between VTK's releases.
folder(plugin/vtk_versions lights shadowtech/base plugin/window)
folder(plugin/scene lights shadowtech/base plugin/ranks plugin/vtk_versions plugin/window)
folder(plugin/data lights shadowtech/base shadowtech/sky shadowtech/tracing plugin/scene)
folder(plugin/plan lights shadowtech shadowtech/base shadowtech/probing shadowtech/sky
  shadowtech/tracing)
folder(plugin/frame ${shared} shadowtech shadowtech/sky shadowtech/transmittance plugin/plan
  plugin/ranks plugin/scene plugin/window)
folder(plugin/pass lights shadowtech shadowtech/base plugin/plan)
folder(plugin ${shared} shadowtech shadowtech/sky plugin/data plugin/frame plugin/pass plugin/plan plugin/ranks
  plugin/scene plugin/vtk_versions plugin/window)
folder(plugin/paraview/GnomonShadows/views lights plugin)

# Public headers of plugin/ that its folders may include: they include nothing of it.
set(plain_headers plugin/vtkGnomonVisibilityImages.h plugin/vtkGnomonPropKeys.h)
set(opengl "^(GL|EGL)/|^vtk_gl(ew|ad)\\.h$|^vtkOpenGL|^vtkShader|^vtkTextureObject|^vtkFrameBuffer")

# Headers of C++, of the libraries and of VTK but for those of its window systems; then what three
# files include beside them.
set(portable "^[a-z0-9_]+$|^Gnomon[A-Za-z]+Module\\.h$|^(glm|nlohmann|tbb|embree[34])/|^vtk[A-Za-z0-9_]+\\.h$")
set(of_a_window_system "^vtk(XOpenGL|XRender|Win32|Cocoa|EGL)")
set(system_of_plugin/window/EglContext.cpp "^EGL/")
set(system_of_plugin/window/GlxContext.cpp "^dlfcn\\.h$")
set(system_of_shadowtech/base/SystemLinux.cpp "^unistd\\.h$")

# Set the path of an included file from the project's root; empty for the system's headers.
function(path_of name folder result)
  set(${result} "" PARENT_SCOPE)
  if(name MATCHES "/")
    if(name MATCHES "^(lights|shadowtech|plugin|examples|tests)/")
      set(${result} "${name}" PARENT_SCOPE)
    endif()
    return()
  endif()
  foreach(room ${folder} lights shadowtech/base plugin examples tests)
    if(EXISTS "${SOURCE_DIR}/${room}/${name}")
      set(${result} "${room}/${name}" PARENT_SCOPE)
      return()
    endif()
  endforeach()
endfunction()

set(faults "")
set(count 0)
file(GLOB_RECURSE files RELATIVE "${SOURCE_DIR}"
  "${SOURCE_DIR}/lights/*.*" "${SOURCE_DIR}/shadowtech/*.*" "${SOURCE_DIR}/plugin/*.*")
list(FILTER files INCLUDE REGEX "\\.(h|cpp|cxx|glsl)$")
foreach(file IN LISTS files)
  get_filename_component(folder "${file}" DIRECTORY)
  if(NOT folder IN_LIST folders)
    string(APPEND faults "${file}: ${folder}/ is not in the list\n")
    continue()
  endif()
  file(STRINGS "${SOURCE_DIR}/${file}" lines REGEX "^[ \t]*#[ \t]*include[ \t]*[<\"]")
  file(STRINGS "${SOURCE_DIR}/${file}" paths REGEX "\"/(proc|sys|dev)/")
  if(paths AND NOT DEFINED system_of_${file})
    string(APPEND faults "${file}: ${paths} is of a system\n")
  endif()
  foreach(line IN LISTS lines)
    string(REGEX REPLACE ".*include[ \t]*[<\"]([^>\"]*)[>\"].*" "\\1" name "${line}")
    math(EXPR count "${count} + 1")
    path_of("${name}" "${folder}" path)
    get_filename_component(target "${path}" DIRECTORY)
    if(path IN_LIST plain_headers AND folder MATCHES "^plugin/")
      continue()
    elseif(path AND NOT target IN_LIST may_include_${folder})
      string(APPEND faults "${file}: ${name} is in ${target}/\n")
    elseif(path AND file IN_LIST plain_headers AND target MATCHES "^plugin")
      string(APPEND faults "${file}: ${name} is in ${target}/, and this header is for all\n")
    elseif(NOT path
      AND (NOT name MATCHES "${portable}" OR name MATCHES "${of_a_window_system}")
      AND NOT (DEFINED system_of_${file} AND name MATCHES "${system_of_${file}}"))
      string(APPEND faults "${file}: ${name} is of a system, or of a library that is not listed\n")
    elseif(folder STREQUAL "lights" AND name MATCHES "${opengl}")
      string(APPEND faults "${file}: ${name} is OpenGL\n")
    elseif(folder STREQUAL "plugin/plan" AND name MATCHES "(^|/)(vtk|Gl[.A-Z]|GL/)")
      string(APPEND faults "${file}: ${name} is no value, and plans are functions of values\n")
    elseif(folder STREQUAL "plugin/frame" AND name MATCHES "vtkGnomonFrameReport.h$"
      AND NOT file MATCHES "/FrameReporting\\.h$")
      string(APPEND faults "${file}: no stage reads reports; FrameReporting makes them\n")
    endif()
  endforeach()
endforeach()

if(faults)
  message(FATAL_ERROR "Includes that the list of folders does not allow:\n${faults}")
endif()
if(count EQUAL 0)
  message(FATAL_ERROR "No includes found under ${SOURCE_DIR}.")
endif()
