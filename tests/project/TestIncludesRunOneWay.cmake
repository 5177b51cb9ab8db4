# Includes run one way, folder by folder: plugin -> shadowtech -> lights. Nothing in them includes
# examples/ or tests/, and lights/ includes no OpenGL.
#
#   cmake -D SOURCE_DIR=... -P
cmake_minimum_required(VERSION 3.25)

set(rooms lights shadowtech plugin examples tests)
set(may_include_lights lights)
set(may_include_shadowtech shadowtech lights)
set(may_include_plugin plugin shadowtech lights)
set(opengl "^(GL|EGL)/|^vtk_glew\\.h$|^vtkOpenGL|^vtkShader|^vtkTextureObject|^vtkFrameBuffer")

# The room that an include leads to; empty for the system's.
function(room_of name result)
  set(${result} "" PARENT_SCOPE)
  foreach(room IN LISTS rooms)
    if(name MATCHES "^${room}/")
      set(${result} "${room}" PARENT_SCOPE)
    elseif(NOT name MATCHES "/")
      file(GLOB_RECURSE found "${SOURCE_DIR}/${room}/${name}")
      if(found)
        set(${result} "${room}" PARENT_SCOPE)
      endif()
    endif()
  endforeach()
endfunction()

set(faults "")
set(count 0)
foreach(room lights shadowtech plugin)
  file(GLOB_RECURSE files
    "${SOURCE_DIR}/${room}/*.h" "${SOURCE_DIR}/${room}/*.cpp" "${SOURCE_DIR}/${room}/*.cxx")
  foreach(file IN LISTS files)
    file(STRINGS "${file}" lines REGEX "^[ \t]*#[ \t]*include[ \t]*[<\"]")
    foreach(line IN LISTS lines)
      string(REGEX REPLACE ".*include[ \t]*[<\"]([^>\"]*)[>\"].*" "\\1" name "${line}")
      math(EXPR count "${count} + 1")
      room_of("${name}" target)
      if(target AND NOT target IN_LIST may_include_${room})
        string(APPEND faults "${file}: ${name} is in ${target}/\n")
      elseif(room STREQUAL "lights" AND name MATCHES "${opengl}")
        string(APPEND faults "${file}: ${name} is OpenGL\n")
      endif()
    endforeach()
  endforeach()
endforeach()

if(faults)
  message(FATAL_ERROR "Includes against the direction plugin -> shadowtech -> lights:\n${faults}")
endif()
if(count EQUAL 0)
  message(FATAL_ERROR "No includes found under ${SOURCE_DIR}.")
endif()
