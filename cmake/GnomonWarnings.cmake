# Warnings for Gnomon's own targets; gnomon_set_warnings(<target>...) switches them on.
function(gnomon_set_warnings)
  foreach(target IN LISTS ARGN)
    target_compile_options(${target} PRIVATE
      -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Wold-style-cast -Woverloaded-virtual
      $<$<BOOL:${GNOMON_WARNINGS_AS_ERRORS}>:-Werror>)
  endforeach()
endfunction()
