# gnomon_embed_glsl(<output variable> <function> <file.glsl>...)
#
# Turns GLSL files into one C++ source that defines
#     const std::map<std::string, std::string>& gnomon::<function>()
# from each file's path relative to the project's root, e.g.
# "shadowtech/depth_map/compare_estimator.glsl", to its text. The variable receives the generated
# source's path.
function(gnomon_embed_glsl output function)
  string(CONCAT body
    "// Generated from the .glsl files; do not edit.\n"
    "#include <map>\n#include <string>\n\n"
    "namespace gnomon\n{\n"
    "const std::map<std::string, std::string>& ${function}();\n"
    "const std::map<std::string, std::string>& ${function}()\n{\n"
    "  static const std::map<std::string, std::string> sources = {\n")
  foreach(file IN LISTS ARGN)
    get_filename_component(path "${file}" ABSOLUTE)
    file(READ "${path}" text)
    file(RELATIVE_PATH name "${GNOMON_SOURCE_DIR}" "${path}")
    string(APPEND body "    { \"${name}\", R\"__glsl__(${text})__glsl__\" },\n")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${path}")
  endforeach()
  string(APPEND body "  };\n  return sources;\n}\n} // namespace gnomon\n")
  set(generated "${CMAKE_CURRENT_BINARY_DIR}/${function}.cpp")
  file(CONFIGURE OUTPUT "${generated}" CONTENT "${body}" @ONLY)
  set(${output} "${generated}" PARENT_SCOPE)
endfunction()
