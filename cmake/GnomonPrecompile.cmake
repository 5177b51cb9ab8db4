# gnomon_precompile(<target> [<header>...]) compiles what most of a program's sources include of others once for all of them, where
# GNOMON_PRECOMPILE_HEADERS asks for it: what is used of the standard library nearly everywhere, GLM, and these headers. Gnomon's
# own are not to be among them. Nor do its libraries share any: so that it is seen where one of their sources forgets to include something.
function(gnomon_precompile target)
  if(GNOMON_PRECOMPILE_HEADERS)
    target_precompile_headers(${target} PRIVATE
      <algorithm> <array> <cmath> <cstdint> <functional> <limits> <memory> <optional> <string> <utility> <vector>
      <glm/glm.hpp> ${ARGN})
  endif()
endfunction()
