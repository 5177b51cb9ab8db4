# docs/guide/settings.md is what `gnomon settings --markdown` says.
#
#   cmake -D GNOMON=... -D PAGE=... -P
cmake_minimum_required(VERSION 3.25)

execute_process(COMMAND "${GNOMON}" settings --markdown
  OUTPUT_VARIABLE made COMMAND_ERROR_IS_FATAL ANY)
file(READ "${PAGE}" page)
if(NOT made STREQUAL page)
  message(FATAL_ERROR "${PAGE} is stale: make it again by `gnomon settings --markdown`.")
endif()
