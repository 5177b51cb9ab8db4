# Check that docs/guide/settings.md equals the output of `gnomon settings --markdown`.
#
#   cmake -D GNOMON=... -D PAGE=... -P
cmake_minimum_required(VERSION 3.25)

execute_process(COMMAND "${GNOMON}" settings --markdown
  OUTPUT_VARIABLE made COMMAND_ERROR_IS_FATAL ANY)
file(READ "${PAGE}" found)
if(NOT made STREQUAL found)
  message(FATAL_ERROR "${PAGE} is stale: make it again by `gnomon settings --markdown`.")
endif()
