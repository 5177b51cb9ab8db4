# Every package that Gnomon stands on, found in one place.
find_package(VTK 9.1 REQUIRED COMPONENTS
  CommonColor
  CommonCore
  CommonDataModel
  CommonExecutionModel
  CommonMath
  CommonTransforms
  FiltersCore
  FiltersGeneral
  FiltersModeling
  FiltersSources
  FiltersTexture
  IOGeometry
  IOImage
  IOImport
  IOPLY
  IOXML
  IOXMLParser
  ImagingCore
  InteractionStyle
  RenderingAnnotation
  RenderingCore
  RenderingLOD
  RenderingOpenGL2
  ChartsCore
  RenderingContext2D
  RenderingContextOpenGL2
  RenderingFreeType
  RenderingVolume
  RenderingVolumeOpenGL2
  ViewsContext2D
  glew)
find_package(glm REQUIRED)
find_package(embree 3 REQUIRED)
find_package(TBB REQUIRED)
find_package(OpenGL REQUIRED COMPONENTS OpenGL EGL)
if(GNOMON_BUILD_EXAMPLES)
  find_package(CLI11 REQUIRED)
  find_package(nlohmann_json REQUIRED)
  find_package(OpenEXR 3 REQUIRED)
  find_package(PNG REQUIRED)
  find_package(ZLIB REQUIRED)
endif()
