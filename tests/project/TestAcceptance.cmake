# Check that every test named in tests/acceptance.tsv exists. The file names the tests of each row
# of the publications' acceptance tables, or the reason why there are none. A test is a source file
# (`path`) or one test in it (`path:name`). A remark may follow the tests, after a semicolon.
#
# The publications are apelles (Moschig 2012), hybrid (Morais 2016), montecarlo (Curtis 2009),
# selective (Moderno) and survey (Rzeczkowski 2024). Rows of `hard` are hard cases without a scene.
#
#   cmake -D SOURCE_DIR=... -P
cmake_minimum_required(VERSION 3.25)

set(faults "")
set(rows "")
set(named 0)

file(READ "${SOURCE_DIR}/tests/acceptance.tsv" text)
string(REPLACE ";" "@" text "${text}") # semicolons end items of CMake's lists
string(REGEX REPLACE "\n+$" "" text "${text}")
string(REPLACE "\n" ";" lines "${text}")
list(POP_FRONT lines header)
if(NOT header STREQUAL "spec\trow\twhat\ttests or reason")
  string(APPEND faults "expected the columns spec, row, what, tests or reason\n")
endif()

foreach(line IN LISTS lines)
  if(NOT line MATCHES "^([a-z]+)\t([^\t]+)\t([^\t]+)\t([^\t]+)$")
    string(APPEND faults "${line}: expected four columns, none of them empty\n")
    continue()
  endif()
  set(row "${CMAKE_MATCH_1} ${CMAKE_MATCH_2}")
  set(held "${CMAKE_MATCH_4}")
  if(row IN_LIST rows)
    string(APPEND faults "${row}: is there twice\n")
  endif()
  list(APPEND rows "${row}")
  if(NOT held MATCHES "^tests/")
    if(held MATCHES "\\.cpp")
      string(APPEND faults "${row}: ${held}: tests begin with tests/\n")
    endif()
    continue() # a reason
  endif()
  string(REGEX REPLACE "@.*" "" tests "${held}")
  string(REPLACE " " ";" tests "${tests}")
  foreach(test IN LISTS tests)
    math(EXPR named "${named} + 1")
    string(REGEX REPLACE ":.*" "" path "${test}")
    if(NOT path MATCHES "\\.cpp$" OR NOT EXISTS "${SOURCE_DIR}/${path}")
      string(APPEND faults "${row}: ${path}: there is no such test file\n")
      continue()
    endif()
    if(test MATCHES ":(.+)")
      set(name "${CMAKE_MATCH_1}")
      file(READ "${SOURCE_DIR}/${path}" source)
      if(NOT source MATCHES "TEST[A-Z_]*\\([A-Za-z0-9]+,[ \n]*${name}[,)]")
        string(APPEND faults "${row}: ${test}: there is no such test\n")
      endif()
    endif()
  endforeach()
endforeach()

if(faults)
  message(FATAL_ERROR "tests/acceptance.tsv:\n${faults}")
endif()
if(named EQUAL 0)
  message(FATAL_ERROR "tests/acceptance.tsv names no test.")
endif()
