# Check that the tests compile or run the code on the pages. Each ```cpp, ```python and ```glsl
# block of README.md and docs, and each statement `...;` in their text, must occur in a source file.
# Paragraphs of a block may have other lines between them there, but lie in one file. Indentation
# does not count.
#
#   cmake -D SOURCE_DIR=... -P
cmake_minimum_required(VERSION 3.25)

# Return text without indentation and without characters that CMake's lists interpret.
function(normalise text result)
  string(REPLACE ";" "@SEMICOLON@" text "${text}")
  string(REPLACE "[" "@OPEN@" text "${text}")
  string(REPLACE "]" "@CLOSE@" text "${text}")
  string(REGEX REPLACE "\n[ \t]+" "\n" text "${text}")
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

function(read_normalised path result)
  file(READ "${path}" text)
  normalise("\n${text}" text)
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

# Test whether a text holds all paragraphs of a block, in this order.
function(find_paragraphs block text result)
  set(${result} FALSE PARENT_SCOPE)
  while(NOT block STREQUAL "")
    string(FIND "${block}" "\n\n" end)
    string(SUBSTRING "${block}" 0 ${end} paragraph)
    string(FIND "${text}" "\n${paragraph}\n" place)
    if(place EQUAL -1)
      return()
    endif()
    string(LENGTH "${paragraph}" length)
    math(EXPR place "${place} + ${length}")
    string(SUBSTRING "${text}" ${place} -1 text)
    set(rest "")
    if(NOT end EQUAL -1)
      math(EXPR end "${end} + 2")
      string(SUBSTRING "${block}" ${end} -1 rest)
    endif()
    set(block "${rest}")
  endwhile()
  set(${result} TRUE PARENT_SCOPE)
endfunction()

# Sources that may hold a language's snippets.
file(GLOB_RECURSE cpp_files "${SOURCE_DIR}/examples/*.cxx" "${SOURCE_DIR}/tests/clients/*.cxx"
  "${SOURCE_DIR}/lights/*.h" "${SOURCE_DIR}/lights/*.cpp" "${SOURCE_DIR}/shadowtech/*.h"
  "${SOURCE_DIR}/shadowtech/*.cpp")
file(GLOB_RECURSE python_files "${SOURCE_DIR}/examples/*.py" "${SOURCE_DIR}/tests/clients/*.py"
  "${SOURCE_DIR}/tests/paraview/*.py" "${SOURCE_DIR}/tests/python/*.py")
file(GLOB_RECURSE glsl_files "${SOURCE_DIR}/shadowtech/*.glsl")

# A snippet is snippet_<number>, of page_<number>; its number is in numbers_<language>.
set(count 0)
function(add_snippet language page text)
  string(STRIP "${text}" text)
  math(EXPR count "${count} + 1")
  set(snippet_${count} "${text}" PARENT_SCOPE)
  set(page_${count} "${page}" PARENT_SCOPE)
  set(count ${count} PARENT_SCOPE)
  set(numbers_${language} ${numbers_${language}} ${count} PARENT_SCOPE)
endfunction()

file(GLOB_RECURSE pages "${SOURCE_DIR}/docs/*.md")
foreach(path "${SOURCE_DIR}/README.md" ${pages})
  file(RELATIVE_PATH page "${SOURCE_DIR}" "${path}")
  read_normalised("${path}" text)
  foreach(language cpp python glsl)
    string(REGEX MATCHALL "```${language}\n[^`]*```" blocks "${text}")
    foreach(block IN LISTS blocks)
      string(REGEX REPLACE "```${language}\n([^`]*)```" "\\1" block "${block}")
      add_snippet(${language} "${page}" "${block}")
    endforeach()
  endforeach()
  string(REGEX REPLACE "```[^`]*```" "" text "${text}")
  string(REGEX MATCHALL "`[^`\n]+@SEMICOLON@`" statements "${text}")
  foreach(statement IN LISTS statements)
    string(REPLACE "`" "" statement "${statement}")
    add_snippet(cpp "${page}" "${statement}")
  endforeach()
endforeach()

foreach(language cpp python glsl)
  set(missing ${numbers_${language}})
  foreach(file IN LISTS ${language}_files)
    if(NOT missing)
      break()
    endif()
    read_normalised("${file}" text)
    foreach(number IN LISTS missing)
      find_paragraphs("${snippet_${number}}" "${text}" found)
      if(found)
        list(REMOVE_ITEM missing ${number})
      endif()
    endforeach()
  endforeach()
  foreach(number IN LISTS missing)
    string(REPLACE "@SEMICOLON@" ";" snippet "${snippet_${number}}")
    string(REPLACE "@OPEN@" "[" snippet "${snippet}")
    string(REPLACE "@CLOSE@" "]" snippet "${snippet}")
    string(APPEND faults "${page_${number}}: no source file has\n${snippet}\n\n")
  endforeach()
endforeach()

if(faults)
  message("${faults}") # FATAL_ERROR alone would wrap its lines
  message(FATAL_ERROR "Pages show code that is in no source file.")
endif()
if(count EQUAL 0)
  message(FATAL_ERROR "No snippets found in pages under ${SOURCE_DIR}.")
endif()
message(STATUS "${count} snippets")
