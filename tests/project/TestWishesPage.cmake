# Check that each row of docs/guide/from_vtkShadowMapPass.md names an existing test. The wishes are
# those of issues and pull requests: Drake 20486, 24987; f3d 13; Open3D 3970; pyrender 105; pysam
# 228; pyvista 1278, 4939, 6065, 7344, 8685, 9041; Slicer 7780; Solar 1; vedo 64, 559; vtk-js 2823.
#
#   cmake -D SOURCE_DIR=... -P
cmake_minimum_required(VERSION 3.25)

set(tests "") # Suite.name of all tests written in C++
file(GLOB_RECURSE sources "${SOURCE_DIR}/tests/*Test.cpp")
foreach(source IN LISTS sources)
  file(STRINGS "${source}" lines REGEX "^TEST(_F|_P)?\\(")
  foreach(line IN LISTS lines)
    if(line MATCHES "^TEST(_F|_P)?\\(([A-Za-z0-9_]+), *([A-Za-z0-9_]+)\\)")
      list(APPEND tests "${CMAKE_MATCH_2}.${CMAKE_MATCH_3}")
    endif()
  endforeach()
endforeach()

set(faults "")
set(rows 0)
file(STRINGS "${SOURCE_DIR}/docs/guide/from_vtkShadowMapPass.md" lines REGEX "^\\| ")
list(POP_FRONT lines) # the table's head
foreach(line IN LISTS lines)
  math(EXPR rows "${rows} + 1")
  if(line MATCHES "\\| `([A-Za-z0-9_]+\\.[A-Za-z0-9_]+)` \\|$")
    if(NOT CMAKE_MATCH_1 IN_LIST tests)
      string(APPEND faults "${CMAKE_MATCH_1}: there is no such test\n")
    endif()
  else()
    string(APPEND faults "no test at the end of: ${line}\n")
  endif()
endforeach()

if(faults)
  message(FATAL_ERROR "docs/guide/from_vtkShadowMapPass.md:\n${faults}")
endif()
if(rows EQUAL 0)
  message(FATAL_ERROR "No rows found under ${SOURCE_DIR}.")
endif()
