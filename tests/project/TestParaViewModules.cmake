# Check that the plugin for ParaView, a project of its own that CI does not build, includes the
# modules of cmake/ whose functions the libraries call.
#
#   cmake -D SOURCE_DIR=... -P
cmake_minimum_required(VERSION 3.25)

file(READ "${SOURCE_DIR}/plugin/paraview/CMakeLists.txt" project)
string(REGEX MATCHALL "include\\(Gnomon[A-Za-z]+\\)" includes "${project}")
set(defined "")
foreach(include IN LISTS includes)
  string(REGEX REPLACE "include\\((.*)\\)" "\\1" module "${include}")
  file(STRINGS "${SOURCE_DIR}/cmake/${module}.cmake" functions REGEX "^(function|macro)\\(")
  foreach(function IN LISTS functions)
    string(REGEX REPLACE "^[a-z]+\\(([a-z_]+).*" "\\1" name "${function}")
    list(APPEND defined ${name})
  endforeach()
endforeach()

set(calls 0)
foreach(library lights shadowtech plugin)
  file(STRINGS "${SOURCE_DIR}/${library}/CMakeLists.txt" lines REGEX "^ *gnomon_[a-z_]+\\(")
  foreach(line IN LISTS lines)
    string(REGEX REPLACE "^ *([a-z_]+)\\(.*" "\\1" name "${line}")
    math(EXPR calls "${calls} + 1")
    if(NOT name IN_LIST defined)
      message(SEND_ERROR
        "${library}/CMakeLists.txt calls ${name}(), and plugin/paraview/CMakeLists.txt includes "
        "no module that defines it.")
    endif()
  endforeach()
endforeach()
if(calls EQUAL 0)
  message(FATAL_ERROR "No library calls a function of cmake/.")
endif()
