# Check that the rows of the table of docs/techniques/README.md begin like the list of `gnomon
# techniques`, in its order.
#
#   cmake -D GNOMON=... -D PAGE=... -P
cmake_minimum_required(VERSION 3.25)

execute_process(COMMAND "${GNOMON}" techniques OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE "(^|\n)([a-z]+) +([^\n]+)" "\\1| `\\2` | \\3 |" expected "${listed}")

file(STRINGS "${PAGE}" rows REGEX "^\\| `")
set(found "")
foreach(row IN LISTS rows)
  string(REGEX REPLACE "^(\\| `[a-z]+` \\| [^|]+ \\|).*" "\\1" row "${row}")
  string(APPEND found "${row}\n")
endforeach()

if(NOT found STREQUAL expected)
  message(FATAL_ERROR "${PAGE} is stale: its table's rows begin\n${found}\nexpected\n${expected}")
endif()
