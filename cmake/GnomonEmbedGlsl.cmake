# gnomon_embed_glsl(<output variable> <file.glsl>...)
#
# Turns GLSL files into one C++ source that registers each of them with gnomon::ShaderLibrary under
# its path relative to the project's root, e.g. "shadowtech/nsm/nsm_visibility.glsl". The variable
# receives the generated source's path. A raw string keeps the text as it is in the file.
function(gnomon_embed_glsl output)
  set(body "// Generated from the .glsl files; do not edit.\n#include \"shadowtech/base/EmbeddedShaders.h\"\n\nnamespace gnomon\n{\nconst std::map<std::string, std::string>& embeddedShaders()\n{\n  static const std::map<std::string, std::string> sources = {\n")
  foreach(file IN LISTS ARGN)
    get_filename_component(path "${file}" ABSOLUTE)
    file(READ "${path}" text)
    file(RELATIVE_PATH name "${PROJECT_SOURCE_DIR}" "${path}")
    string(APPEND body "    { \"${name}\", R\"__glsl__(${text})__glsl__\" },\n")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${path}")
  endforeach()
  string(APPEND body "  };\n  return sources;\n}\n} // namespace gnomon\n")
  set(generated "${CMAKE_CURRENT_BINARY_DIR}/EmbeddedShaders.cpp")
  file(CONFIGURE OUTPUT "${generated}" CONTENT "${body}" @ONLY)
  set(${output} "${generated}" PARENT_SCOPE)
endfunction()
