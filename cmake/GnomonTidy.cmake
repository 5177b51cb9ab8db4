# The target `tidy` runs clang-tidy (.clang-tidy) over Gnomon's own sources. It needs a build that
# compiles each of them by itself, as the preset debug does.
find_program(GNOMON_RUN_CLANG_TIDY NAMES run-clang-tidy run-clang-tidy-14)
if(GNOMON_RUN_CLANG_TIDY AND NOT CMAKE_UNITY_BUILD)
  add_custom_target(tidy
    COMMAND "${GNOMON_RUN_CLANG_TIDY}" -quiet -p "${PROJECT_BINARY_DIR}"
      "^${PROJECT_SOURCE_DIR}/(lights|shadowtech|plugin|examples|tests)/"
    COMMENT "clang-tidy"
    USES_TERMINAL VERBATIM)
endif()
