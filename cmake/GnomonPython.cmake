# The Python package `gnomon`: VTK's own wrappers of the public classes, and plugin/python/gnomon.

# Debian's Python looks for packages of its own there; others say it by this.
set(GNOMON_PYTHON_DESTINATION "lib/python3/dist-packages" CACHE STRING
  "Where the Python package is installed, below the prefix")

vtk_module_wrap_python(
  MODULES Gnomon::Lights Gnomon::Plugin
  PYTHON_PACKAGE "gnomon"
  TARGET Gnomon::Python
  WRAPPED_MODULES gnomon_wrapped
  MODULE_DESTINATION "${GNOMON_PYTHON_DESTINATION}"
  INSTALL_EXPORT GnomonPython
  INSTALL_HEADERS OFF
  BUILD_STATIC OFF
  DEPENDS VTK::RenderingOpenGL2)

set(gnomon_python_folder "${PROJECT_SOURCE_DIR}/plugin/python/gnomon")
set(gnomon_built_package "${PROJECT_BINARY_DIR}/${GNOMON_PYTHON_DESTINATION}")
set(gnomon_python_sources __init__.py arguments.py attributes.py catalogue.py classes.py data.py
  errors.py figure.py holders.py images.py lighting.py program.py why.py)
foreach(source IN LISTS gnomon_python_sources)
  configure_file("${gnomon_python_folder}/${source}" "${gnomon_built_package}/gnomon/${source}"
    COPYONLY)
endforeach()
configure_file("${gnomon_python_folder}/_version.py.in"
  "${gnomon_built_package}/gnomon/_version.py" @ONLY)
# Python's importlib.metadata reads the package's name and version there.
set(gnomon_metadata "gnomon-${PROJECT_VERSION}.dist-info")
file(WRITE "${gnomon_built_package}/${gnomon_metadata}/METADATA"
  "Metadata-Version: 2.1\nName: gnomon\nVersion: ${PROJECT_VERSION}\n"
  "Summary: Shadows for VTK's renderers, from fast to exact\n")

# Types for editors and type checkers (PEP 561): the wrapped classes' in stubs, which a built package
# is asked for; those of the functions are in their sources.
list(TRANSFORM gnomon_python_sources PREPEND "${gnomon_built_package}/gnomon/"
  OUTPUT_VARIABLE gnomon_built_sources)
set(gnomon_stubs
  "${gnomon_built_package}/gnomon/GnomonLights.pyi"
  "${gnomon_built_package}/gnomon/GnomonPlugin.pyi")
add_custom_command(
  OUTPUT ${gnomon_stubs}
  COMMAND "${CMAKE_COMMAND}" -E env "PYTHONPATH=${gnomon_built_package}"
    "${Python3_EXECUTABLE}" "${CMAKE_CURRENT_LIST_DIR}/python_stubs.py"
    "${gnomon_built_package}/gnomon" GnomonLights GnomonPlugin
  DEPENDS "${CMAKE_CURRENT_LIST_DIR}/python_stubs.py" ${gnomon_built_sources} GnomonLightsPython
    GnomonPluginPython
  COMMENT "Writing the type stubs of the Python package"
  VERBATIM)
add_custom_target(GnomonPythonStubs ALL DEPENDS ${gnomon_stubs})
file(TOUCH "${gnomon_built_package}/gnomon/py.typed")
install(FILES ${gnomon_stubs} "${gnomon_built_package}/gnomon/py.typed"
    "${gnomon_built_package}/gnomon/_version.py"
  DESTINATION "${GNOMON_PYTHON_DESTINATION}/gnomon"
  COMPONENT python)
if(NOT SKBUILD) # wheels have pip's
  install(FILES "${gnomon_built_package}/${gnomon_metadata}/METADATA"
    DESTINATION "${GNOMON_PYTHON_DESTINATION}/${gnomon_metadata}"
    COMPONENT python)
endif()
install(DIRECTORY "${gnomon_python_folder}" DESTINATION "${GNOMON_PYTHON_DESTINATION}"
  COMPONENT python
  FILES_MATCHING PATTERN "*.py")

# The installed wrappers find the libraries wherever the installation is moved to.
file(RELATIVE_PATH gnomon_up "/${GNOMON_PYTHON_DESTINATION}/gnomon" "/${CMAKE_INSTALL_LIBDIR}")
set_target_properties(GnomonLightsPython GnomonPluginPython PROPERTIES
  INSTALL_RPATH "\$ORIGIN/${gnomon_up}")
