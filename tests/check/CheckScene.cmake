# Render a scene's visibility file and check it.
#
# GNOMON, GNOMON_CHECK: the programs. SCENE: a scene file, or with BUILTIN the name of a built-in
# scene, which is exported first. WORK_DIR: where the files go.
file(MAKE_DIRECTORY "${WORK_DIR}")
if(BUILTIN)
  execute_process(COMMAND "${GNOMON}" scenes --export "${SCENE}" "${WORK_DIR}"
    COMMAND_ERROR_IS_FATAL ANY)
  set(SCENE "${WORK_DIR}/${SCENE}.json")
endif()
execute_process(
  COMMAND "${GNOMON}" render "${SCENE}" -o "${WORK_DIR}/picture.png" --technique raytraced
    --size 640x480 --visibility "${WORK_DIR}/visibility.exr"
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${GNOMON_CHECK}" "${SCENE}" "${WORK_DIR}/visibility.exr"
  COMMAND_ERROR_IS_FATAL ANY)
