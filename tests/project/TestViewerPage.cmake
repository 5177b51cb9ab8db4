# docs/guide/viewer.md ends with what `gnomon view --keys` says.
#
#   cmake -D GNOMON=... -D PAGE=... -P
cmake_minimum_required(VERSION 3.25)

execute_process(COMMAND "${GNOMON}" view --keys OUTPUT_VARIABLE keys COMMAND_ERROR_IS_FATAL ANY)
file(READ "${PAGE}" page)
string(FIND "${page}" "\n${keys}" place)
string(LENGTH "${page}" pageLength)
string(LENGTH "\n${keys}" keysLength)
math(EXPR expected "${pageLength} - ${keysLength}")
if(NOT place EQUAL expected)
  message(FATAL_ERROR "${PAGE} is stale: tests/lab/pages/draw.sh viewer makes its table of keys again.")
endif()
