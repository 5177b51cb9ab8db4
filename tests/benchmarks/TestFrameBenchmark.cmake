# Runs the frame benchmark on two small frames and looks at its figures' shape, not at their values.
#
# BENCHMARK: the program. JSON: where its figures go.
file(REMOVE "${JSON}")
execute_process(
  COMMAND "${BENCHMARK}" cube --size 64x64 --map-size 64 --frames 2 --json "${JSON}"
  COMMAND_ERROR_IS_FATAL ANY)
file(READ "${JSON}" figures)

set(expected "plain VTK" "vtkShadowMapPass 64" "nsm 64 inline" "nsm 64 image" "raytraced"
  "pass, no light casts")
set(names "")
string(JSON count LENGTH "${figures}" variants)
math(EXPR last "${count} - 1")
foreach(i RANGE ${last})
  string(JSON name GET "${figures}" variants ${i} name)
  list(APPEND names "${name}")
  foreach(motion static camera_moving light_moving)
    foreach(key ms over_plain over_vtk_shadow_map_pass)
      string(JSON value GET "${figures}" variants ${i} ${motion} ${key})
      if(NOT value GREATER 0)
        message(FATAL_ERROR "${name}, ${motion}, ${key}: found ${value}, expected more than 0")
      endif()
    endforeach()
  endforeach()
endforeach()
if(NOT names STREQUAL expected)
  message(FATAL_ERROR "variants: found ${names}, expected ${expected}")
endif()
