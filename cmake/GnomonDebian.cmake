# Debian packages by CPack: `cmake --workflow --preset debian` writes them to build/debian/packages.
#
# Each install component is a package (cmake/GnomonPackage.cmake). dpkg-shlibdeps finds what
# libraries and programs depend on, so packages fit the release of Debian that they are built on.
find_program(GNOMON_DPKG dpkg)
mark_as_advanced(GNOMON_DPKG)
if(NOT GNOMON_DPKG OR SKBUILD)
  return()
endif()

set(GNOMON_MAINTAINER "Gnomon developers <gnomon@example.org>" CACHE STRING
  "Who answers for Debian packages: a name and an address")

# Packages of two releases differ in version, and those of a later one are newer.
cmake_host_system_information(RESULT release QUERY DISTRIB_INFO)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
if(release_VERSION_ID)
  string(REGEX REPLACE "^debian$" "deb" id "${release_ID}")
  string(APPEND CPACK_DEBIAN_PACKAGE_RELEASE "~${id}${release_VERSION_ID}")
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "${GNOMON_MAINTAINER}")
set(CPACK_PACKAGE_DIRECTORY "${PROJECT_BINARY_DIR}/packages")
set(CPACK_PACKAGE_VERSION "${PROJECT_VERSION}")
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_NAME gnomon)
set(CPACK_DEBIAN_PACKAGE_SOURCE gnomon)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${CMAKE_LIBRARY_OUTPUT_DIRECTORY}")

set(gnomon_debian_folder "${PROJECT_BINARY_DIR}/debian")
set(gnomon_soversion "${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}")

# Every package has its licence and a changelog, as Debian's policy asks.
file(READ "${PROJECT_SOURCE_DIR}/LICENSE" text)
string(REGEX REPLACE "^[^\n]*\n\n(Copyright [^\n]*)\n\n" "" text "${text}")
string(REGEX REPLACE "^Copyright *(\\(c\\))? *" "" copyright "${CMAKE_MATCH_1}")
string(REGEX REPLACE "\n+$" "" text "${text}")
string(REGEX REPLACE "\n(\n+)" "\n.\n" text "${text}")
string(REPLACE "\n" "\n " text "${text}")
file(WRITE "${gnomon_debian_folder}/copyright"
  "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/\n"
  "Upstream-Name: Gnomon\n\n"
  "Files: *\nCopyright: ${copyright}\nLicense: BSD-3-clause\n ${text}\n")
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC) # that of SOURCE_DATE_EPOCH, if set
file(WRITE "${gnomon_debian_folder}/changelog.Debian"
  "gnomon (${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) unstable; urgency=medium\n\n"
  "  * Release ${PROJECT_VERSION}; CHANGELOG.md of gnomon-doc says what is new.\n\n"
  " -- ${GNOMON_MAINTAINER}  ${date}\n")
execute_process(COMMAND gzip -9nf changelog.Debian
  WORKING_DIRECTORY "${gnomon_debian_folder}" COMMAND_ERROR_IS_FATAL ANY)

# gnomon_debian_package(<component> <package> <section> <what> <text>...
#   [OVERRIDES <lintian tag>...])
#
# <what> ends the description's first line, <text> is its last lines. Other fields are variables of
# CPack.
function(gnomon_debian_package component package section what)
  cmake_parse_arguments(PARSE_ARGV 4 arg "" "" "OVERRIDES")
  string(TOUPPER "${component}" upper)
  list(JOIN arg_UNPARSED_ARGUMENTS "\n" description)
  string(PREPEND description
    "shadows for VTK, from fast to exact - ${what}\n"
    "Gnomon gives VTK applications shadows: shadow maps, soft shadows and exact,\n"
    "ray-traced ones, in pictures and as data.\n\n")
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME "${package}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION "${section}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${description}\n" PARENT_SCOPE)
  set(CPACK_COMPONENTS_ALL "${CPACK_COMPONENTS_ALL};${component}" PARENT_SCOPE)

  # Only packages hold these: an installation without CPack has a folder `licenses`.
  install(FILES "${gnomon_debian_folder}/copyright" "${gnomon_debian_folder}/changelog.Debian.gz"
    DESTINATION "share/doc/${package}" COMPONENT ${component} EXCLUDE_FROM_ALL)
  if(arg_OVERRIDES)
    list(TRANSFORM arg_OVERRIDES PREPEND "${package}: ")
    list(JOIN arg_OVERRIDES "\n" overrides)
    file(WRITE "${gnomon_debian_folder}/${package}" "${overrides}\n")
    install(FILES "${gnomon_debian_folder}/${package}"
      DESTINATION share/lintian/overrides COMPONENT ${component} EXCLUDE_FROM_ALL)
  endif()
endfunction()

set(CPACK_COMPONENTS_ALL "")
gnomon_debian_package(runtime libgnomon${gnomon_soversion} libs "shared libraries"
  "This package has the shared libraries."
  OVERRIDES
    package-name-doesnt-match-sonames # three libraries, one package
    maintscript-calls-ldconfig) # CPack writes these scripts
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS libgl1-mesa-dri)
# What dpkg-shlibdeps writes into packages of programs with these libraries.
set(shlibs "")
foreach(library GnomonLights GnomonShadowTech GnomonPlugin)
  string(APPEND shlibs "lib${library} ${gnomon_soversion} libgnomon${gnomon_soversion} "
    "(= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})\n")
endforeach()
file(WRITE "${gnomon_debian_folder}/runtime/shlibs" "${shlibs}")
file(WRITE "${gnomon_debian_folder}/runtime/triggers" "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA
  "${gnomon_debian_folder}/runtime/shlibs" "${gnomon_debian_folder}/runtime/triggers")

gnomon_debian_package(development libgnomon-dev libdevel "development files"
  "This package has headers and what CMake's find_package(Gnomon) reads.")
set(CPACK_COMPONENT_DEVELOPMENT_DEPENDS runtime)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libvtk9-dev, libglm-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "gnomon, gnomon-doc")

if(GNOMON_BUILD_EXAMPLES)
  gnomon_debian_package(program gnomon graphics "program"
    "This package has the program gnomon. It shows models with shadows, compares"
    "techniques by error, time and memory, and pictures in tests.")
  file(WRITE "${gnomon_debian_folder}/gnomon.1"
    ".TH GNOMON 1 \"\" \"Gnomon ${PROJECT_VERSION}\"\n"
    ".SH NAME\ngnomon \\- show models with shadows, and measure the shadows\n"
    ".SH SYNOPSIS\n.B gnomon\n.I COMMAND\n.RI [ OPTION ]...\n"
    ".SH DESCRIPTION\n.B gnomon \\-\\-help\nlists the commands,\n"
    ".B gnomon \\fICOMMAND\\fP \\-\\-help\nthe options of one.\n"
    ".SH EXAMPLE\n.B gnomon render model.ply \\-o picture.png\n"
    ".SH SEE ALSO\nThe package gnomon\\-doc has the guide.\n")
  execute_process(COMMAND gzip -9nf gnomon.1
    WORKING_DIRECTORY "${gnomon_debian_folder}" COMMAND_ERROR_IS_FATAL ANY)
  install(FILES "${gnomon_debian_folder}/gnomon.1.gz"
    DESTINATION share/man/man1 COMPONENT program EXCLUDE_FROM_ALL)
  set(CPACK_COMPONENT_PROGRAM_DEPENDS runtime)
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "glmark2-data, gnomon-doc") # the bunny is there
endif()

if(GNOMON_WRAP_PYTHON)
  gnomon_debian_package(python python3-gnomon python "Python 3 package"
    "This package has the Python package gnomon: shadows in pictures by one line,"
    "visibility and hours of sun as NumPy arrays.")
  set(CPACK_COMPONENT_PYTHON_DEPENDS runtime)
  # Compiled modules fit one minor version of Python.
  math(EXPR next "${Python3_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "python3 (>= 3.${Python3_VERSION_MINOR}~), python3 (<< 3.${next}), python3-numpy, python3-vtk9")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS gnomon-doc)
  file(WRITE "${gnomon_debian_folder}/python/postinst"
    "#!/bin/sh\nset -e\nif [ \"$1\" = configure ]; then\n  py3compile -p python3-gnomon\nfi\n")
  file(WRITE "${gnomon_debian_folder}/python/prerm"
    "#!/bin/sh\nset -e\npy3clean -p python3-gnomon\n")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
    "${gnomon_debian_folder}/python/postinst" "${gnomon_debian_folder}/python/prerm")
endif()

gnomon_debian_package(documentation gnomon-doc doc "documentation"
  "This package has the guide, technique pages, measurements and example programs."
  OVERRIDES # README.md leads to these files
    extra-license-file
    wrong-name-for-upstream-changelog)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_ARCHITECTURE all)

include(CPack)
