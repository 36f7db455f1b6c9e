# grasp_affordances_embed_files(SOURCE FUNCTION FOLDER NAME ...): compiles in the files config/FOLDER/NAME.yaml. They stay the
# only place of what they say. Sets SOURCE to a source that defines FUNCTION() as in simulation/embedded_file.h.
function(grasp_affordances_embed_files source function folder)
  set(files "")
  foreach(name ${ARGN})
    set(file ${PROJECT_SOURCE_DIR}/config/${folder}/${name}.yaml)
    file(READ ${file} text)
    string(APPEND files "      {\"${name}\", R\"yaml(${text})yaml\"},\n")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  endforeach()
  configure_file(${PROJECT_SOURCE_DIR}/cmake/embedded_files.cpp.in ${CMAKE_CURRENT_BINARY_DIR}/${function}.cpp @ONLY)
  set(${source} ${CMAKE_CURRENT_BINARY_DIR}/${function}.cpp PARENT_SCOPE)
endfunction()
