# Check that docs/guide/settings.md equals the output of `gnomon settings --markdown`, and that
# vtkGnomonShadowSettings' header equals that of `gnomon settings --class`.
#
#   cmake -D GNOMON=... -D PAGE=... -D HEADER=... -P
cmake_minimum_required(VERSION 3.25)

function(expect file option)
  execute_process(COMMAND "${GNOMON}" settings ${option}
    OUTPUT_VARIABLE made COMMAND_ERROR_IS_FATAL ANY)
  file(READ "${file}" found)
  if(NOT made STREQUAL found)
    message(FATAL_ERROR "${file} is stale: make it again by `gnomon settings ${option}`.")
  endif()
endfunction()

expect("${PAGE}" --markdown)
expect("${HEADER}" --class)
