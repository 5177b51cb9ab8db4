# What makes find_package(Gnomon) work; the libraries' own export comes from vtk_module_build.
#
# Everything is in an install component, of which cmake/GnomonDebian.cmake makes packages. VTK names
# runtime, development and python; program, documentation and licence are Gnomon's.
include(CMakePackageConfigHelpers)

set(gnomon_cmake_destination "${CMAKE_INSTALL_LIBDIR}/cmake/Gnomon")
configure_package_config_file(
  "${PROJECT_SOURCE_DIR}/cmake/GnomonConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/GnomonConfig.cmake"
  INSTALL_DESTINATION "${gnomon_cmake_destination}"
  PATH_VARS CMAKE_INSTALL_BINDIR)
write_basic_package_version_file(
  "${PROJECT_BINARY_DIR}/GnomonConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion) # before 1.0 a minor version may change what is public

install(FILES
  "${PROJECT_BINARY_DIR}/GnomonConfig.cmake"
  "${PROJECT_BINARY_DIR}/GnomonConfigVersion.cmake"
  "${PROJECT_SOURCE_DIR}/cmake/GnomonImageTest.cmake"
  DESTINATION "${gnomon_cmake_destination}" COMPONENT development)
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE"
  DESTINATION "${CMAKE_INSTALL_DATAROOTDIR}/licenses/Gnomon" COMPONENT licence)

# The pages and what they link to, in the same folders as here.
install(DIRECTORY "${PROJECT_SOURCE_DIR}/docs" DESTINATION "${CMAKE_INSTALL_DOCDIR}"
  COMPONENT documentation
  FILES_MATCHING PATTERN "*.md" PATTERN "*.png" PATTERN "*.csv" PATTERN "*.svg")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/examples" DESTINATION "${CMAKE_INSTALL_DOCDIR}"
  COMPONENT documentation
  FILES_MATCHING PATTERN "*.cxx" PATTERN "*.py" PATTERN "CMakeLists.txt" PATTERN "cone_*.png"
  PATTERN gnomon EXCLUDE)
foreach(page README.md CHANGELOG.md CONTRIBUTING.md LICENSE cmake/debian-packages.txt)
  get_filename_component(folder "${page}" DIRECTORY)
  install(FILES "${PROJECT_SOURCE_DIR}/${page}" DESTINATION "${CMAKE_INSTALL_DOCDIR}/${folder}"
    COMPONENT documentation)
endforeach()
