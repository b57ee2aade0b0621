# talus_embed(LIST name file): builds a file into the binary, as talus::embedded::name (see embed.cmake). The source
# that does it is appended to LIST.
set(TALUS_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_DIR}/embed.cmake)
function(talus_embed list name file)
  set(output ${CMAKE_CURRENT_BINARY_DIR}/embedded_${name}.cpp)
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DNAME=${name} -DINPUT=${file} -DOUTPUT=${output} -P ${TALUS_EMBED_SCRIPT}
    DEPENDS ${file} ${TALUS_EMBED_SCRIPT} VERBATIM)
  set_source_files_properties(${output} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON) # each has its own bytes
  set(${list} ${${list}} ${output} PARENT_SCOPE)
endfunction()
