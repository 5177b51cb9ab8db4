# Tests as CTest sees them, in two tiers: those with the label `quick`, whose programs the target
# gnomon_quick_tests builds, and all of them. tests/main/QuickTier.h says which cases of GoogleTest
# programs are quick; tests/slow_cases.txt names those that are slow in any case.

# Launches a test with a display of its own. Without -noreset the server starts again when its last
# client leaves, and refuses the next window of the same process meanwhile.
find_program(GNOMON_XVFB_RUN xvfb-run REQUIRED)
set(GNOMON_ON_X_SERVER "${GNOMON_XVFB_RUN}" -a -s "-screen 0 1280x1024x24 -noreset")

# What CTest does to a test's environment: no other test needs a display, unless Gnomon is built
# without EGL (xvfb-run -s -noreset ctest).
set(GNOMON_TEST_DISPLAY "")
if(GNOMON_EGL)
  set(GNOMON_TEST_DISPLAY "DISPLAY=unset:")
endif()

# gnomon_run_test_program(<program> [NAME <name>] [SLOW] [ON_X_SERVER] [SHARDS <number>]
#   [SLOW_SHARDS <number>] [CASES <pattern>... | BUT <pattern>...] [ENVIRONMENT <name=value>...])
#
# Registers a GoogleTest program with CTest as <name>.1, <name>.2 and so on, each a process with a
# share of the cases, and <name>.slow.1 and so on with the cases outside of the quick tier, if
# SLOW_SHARDS is given. A process per case would cost more than most cases do. SLOW leaves the whole
# program out of the quick tier. CASES and BUT are patterns of --gtest_filter, for cases that need
# processes of their own. ON_X_SERVER gives each process a display of its own.
function(gnomon_run_test_program program)
  cmake_parse_arguments(PARSE_ARGV 1 arg
    "SLOW;ON_X_SERVER" "NAME;SHARDS;SLOW_SHARDS" "CASES;BUT;ENVIRONMENT")
  if(NOT DEFINED arg_NAME)
    set(arg_NAME ${program})
  endif()
  if(NOT DEFINED arg_SHARDS)
    set(arg_SHARDS 1)
  endif()
  list(JOIN arg_CASES ":" cases)
  list(JOIN arg_BUT ":" but)
  set(filter "${cases}-${but}")

  if(DEFINED arg_SLOW_SHARDS)
    set(list "${PROJECT_SOURCE_DIR}/tests/slow_cases.txt")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${list}")
    file(STRINGS "${list}" slow REGEX "^${program} ")
    list(TRANSFORM slow REPLACE "^[^ ]+ +" "")
    list(JOIN slow ":" slow)
    gnomon_add_shards(names ${program} ${arg_NAME}.slow ${arg_SLOW_SHARDS} "${filter}"
      GNOMON_TEST_TIER=slow "GNOMON_SLOW_CASES=${slow}" ${arg_ENVIRONMENT})
    list(APPEND arg_ENVIRONMENT GNOMON_TEST_TIER=quick "GNOMON_SLOW_CASES=${slow}")
  endif()
  gnomon_add_shards(names ${program} ${arg_NAME} ${arg_SHARDS} "${filter}" ${arg_ENVIRONMENT})
  if(NOT arg_SLOW)
    gnomon_quick_tests(${names} DEPENDS ${program})
  endif()
endfunction()

# Pictures are small and programs many, so that optimising the shaders takes llvmpipe longer than it
# saves: GALLIVM_PERF=nopt leaves it out. All other tests, and what users run, optimise.
function(gnomon_add_shards names program name shards filter)
  set(added "")
  set(launcher "")
  if(arg_ON_X_SERVER)
    set(launcher ${GNOMON_ON_X_SERVER})
  endif()
  foreach(shard RANGE 1 ${shards})
    set(test ${name}.${shard})
    math(EXPR index "${shard} - 1")
    add_test(NAME ${test}
      COMMAND ${launcher} $<TARGET_FILE:${program}> --gtest_brief=1 "--gtest_filter=${filter}")
    set_tests_properties(${test} PROPERTIES
      ENVIRONMENT
        "GTEST_TOTAL_SHARDS=${shards};GTEST_SHARD_INDEX=${index};GALLIVM_PERF=nopt;${ARGN}"
      ENVIRONMENT_MODIFICATION "${GNOMON_TEST_DISPLAY}")
    list(APPEND added ${test})
  endforeach()
  set(${names} "${added}" PARENT_SCOPE)
endfunction()

# gnomon_quick_tests(<test>... [DEPENDS <target>...]) puts tests of this folder into the quick tier.
function(gnomon_quick_tests)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "" "DEPENDS")
  set_property(TEST ${arg_UNPARSED_ARGUMENTS} APPEND PROPERTY LABELS quick)
  if(NOT TARGET gnomon_quick_tests)
    add_custom_target(gnomon_quick_tests)
  endif()
  if(DEFINED arg_DEPENDS)
    add_dependencies(gnomon_quick_tests ${arg_DEPENDS})
  endif()
endfunction()
