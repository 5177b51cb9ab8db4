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
foreach(source __init__.py data.py figure.py images.py)
  configure_file("${gnomon_python_folder}/${source}"
    "${PROJECT_BINARY_DIR}/${GNOMON_PYTHON_DESTINATION}/gnomon/${source}" COPYONLY)
endforeach()
install(DIRECTORY "${gnomon_python_folder}" DESTINATION "${GNOMON_PYTHON_DESTINATION}"
  COMPONENT python
  FILES_MATCHING PATTERN "*.py")

# The installed wrappers find the libraries wherever the installation is moved to.
file(RELATIVE_PATH gnomon_up "/${GNOMON_PYTHON_DESTINATION}/gnomon" "/${CMAKE_INSTALL_LIBDIR}")
set_target_properties(GnomonLightsPython GnomonPluginPython PROPERTIES
  INSTALL_RPATH "\$ORIGIN/${gnomon_up}")
