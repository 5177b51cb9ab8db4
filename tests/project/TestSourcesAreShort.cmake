# Check that no source of shadowtech/ and plugin/ has more than 500 lines; the shadow pass may have
# 600.
#
#   cmake -D SOURCE_DIR=... -P
cmake_minimum_required(VERSION 3.25)

set(most_of_plugin/vtkGnomonShadowPass.cxx 600)
set(faults "")
file(GLOB_RECURSE files RELATIVE "${SOURCE_DIR}"
  "${SOURCE_DIR}/shadowtech/*.cpp" "${SOURCE_DIR}/plugin/*.cpp" "${SOURCE_DIR}/plugin/*.cxx")
foreach(file IN LISTS files)
  file(READ "${SOURCE_DIR}/${file}" text)
  string(REGEX REPLACE "[^\n]" "" ends "${text}")
  string(LENGTH "${ends}" length)
  set(most 500)
  if(DEFINED most_of_${file})
    set(most ${most_of_${file}})
  endif()
  if(length GREATER most)
    string(APPEND faults "${file}: ${length} lines, expected at most ${most}\n")
  endif()
endforeach()

if(faults)
  message(FATAL_ERROR "Sources are too long:\n${faults}")
endif()
if(NOT files)
  message(FATAL_ERROR "No sources found under ${SOURCE_DIR}.")
endif()
