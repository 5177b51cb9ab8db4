# Warnings for Gnomon's own targets; gnomon_set_warnings(<target>...) switches them on.
#
# Unity builds compile many sources as one. There a local variable may shadow a constant of another
# source, and fixtures in unnamed namespaces look as if they came from a header. These two warnings
# are for the builds that compile each source by itself (presets debug and sanitizers), which also
# find forgotten includes.
function(gnomon_set_warnings)
  foreach(target IN LISTS ARGN)
    target_compile_options(${target} PRIVATE
      -Wall -Wextra -Wnon-virtual-dtor -Wold-style-cast -Woverloaded-virtual
      $<IF:$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>,-Wshadow=local;-Wno-subobject-linkage,-Wshadow>
      $<$<BOOL:${GNOMON_WARNINGS_AS_ERRORS}>:-Werror>)
  endforeach()
endfunction()
