# Installs Gnomon into an empty prefix, looks at what lies there, and builds and runs
# examples/shadows.cxx by the CMakeLists.txt on a page. With PREFIX and DOCUMENTATION, looks at what
# is installed there, and installs nothing.
#
#   cmake -D BUILD_DIR=... -D CONSUMER_DIR=... -D PAGE=... -D WORK_DIR=... -D CXX=... -D CC=...
#     -D PYTHON=... -D PYTHON_DESTINATION=... [-D PREFIX=... -D DOCUMENTATION=...] -P
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)
endfunction()

file(REMOVE_RECURSE "${WORK_DIR}")
set(headers_of gnomon/) # of the system's many headers
if(NOT PREFIX)
  set(headers_of "")
  set(PREFIX "${WORK_DIR}/prefix")
  set(DOCUMENTATION "${PREFIX}/share/doc/Gnomon")
  run("${CMAKE_COMMAND}" --install "${BUILD_DIR}" --prefix "${PREFIX}")
endif()
run("${PREFIX}/bin/gnomon" techniques)

# Public headers only, all of them flat under include/gnomon.
file(GLOB_RECURSE headers RELATIVE "${PREFIX}/include" "${PREFIX}/include/${headers_of}*")
list(SORT headers)
set(expected
  gnomon/GnomonLightsModule.h
  gnomon/GnomonPluginModule.h
  gnomon/GnomonShadowTechModule.h
  gnomon/vtkGnomonAreaLight.h
  gnomon/vtkGnomonEGLRenderWindow.h
  gnomon/vtkGnomonFlatteringLights.h
  gnomon/vtkGnomonFrameCounts.h
  gnomon/vtkGnomonFrameReport.h
  gnomon/vtkGnomonLightKeys.h
  gnomon/vtkGnomonLightPlacement.h
  gnomon/vtkGnomonLightSamplingPass.h
  gnomon/vtkGnomonNamedSettings.h
  gnomon/vtkGnomonOffScreenWindow.h
  gnomon/vtkGnomonPixelClass.h
  gnomon/vtkGnomonPropKeys.h
  gnomon/vtkGnomonShadowPass.h
  gnomon/vtkGnomonShadowSettings.h
  gnomon/vtkGnomonSun.h
  gnomon/vtkGnomonVersions.h
  gnomon/vtkGnomonVisibilityFilter.h
  gnomon/vtkGnomonVisibilityImages.h)
if(NOT headers STREQUAL expected)
  list(JOIN headers "\n  " headers)
  list(JOIN expected "\n  " expected)
  message(FATAL_ERROR "Installed headers:\n  ${headers}\nExpected:\n  ${expected}")
endif()

# The pages' links hold where they are installed.
run("${CMAKE_COMMAND}" -D "SOURCE_DIR=${DOCUMENTATION}"
  -P "${CONSUMER_DIR}/../project/TestPages.cmake")

# The project is the page's, and has every public header stand on its own.
file(READ "${PAGE}" page)
string(REGEX MATCH "```cmake\n([^`]*)```" block "${page}")
file(WRITE "${WORK_DIR}/project/CMakeLists.txt"
  "${CMAKE_MATCH_1}target_sources(my_program PRIVATE publicHeaders.cxx)\n")
file(COPY "${CONSUMER_DIR}/publicHeaders.cxx" "${CONSUMER_DIR}/../../examples/shadows.cxx"
  DESTINATION "${WORK_DIR}/project")
run("${CMAKE_COMMAND}" -S "${WORK_DIR}/project" -B "${WORK_DIR}/build" -G Ninja
  "-DCMAKE_PREFIX_PATH=${PREFIX}" -DCMAKE_BUILD_TYPE=Release
  "-DCMAKE_C_COMPILER=${CC}" "-DCMAKE_CXX_COMPILER=${CXX}")
run("${CMAKE_COMMAND}" --build "${WORK_DIR}/build")
run("${CMAKE_COMMAND}" -E env --unset=DISPLAY "${WORK_DIR}/build/my_program" "${WORK_DIR}/picture.png")
file(SIZE "${WORK_DIR}/picture.png" bytes)
if(bytes LESS 1000)
  message(FATAL_ERROR "The consumer's picture has only ${bytes} bytes.")
endif()

# The Python package.
if(PYTHON)
  foreach(file py.typed GnomonLights.pyi GnomonPlugin.pyi)
    if(NOT EXISTS "${PREFIX}/${PYTHON_DESTINATION}/gnomon/${file}")
      message(FATAL_ERROR "The Python package has no ${file}.")
    endif()
  endforeach()
  execute_process(
    COMMAND "${CMAKE_COMMAND}" -E env --unset=DISPLAY
      "PYTHONPATH=${PREFIX}/${PYTHON_DESTINATION}"
      "${PYTHON}" "${CONSUMER_DIR}/../../examples/shadows.py" "${WORK_DIR}/python.png"
    OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
  if(NOT output MATCHES "In shadow: [0-9.]+% of the plane" OR NOT EXISTS "${WORK_DIR}/python.png")
    message(FATAL_ERROR "examples/shadows.py said: ${output}")
  endif()
endif()
