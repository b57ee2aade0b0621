# talus_embed(name file): embeds a file into the binary as talus::embedded::name. Call it before talus_room.
function(talus_embed name file)
  set(TALUS_EMBEDDED ${TALUS_EMBEDDED} ${name}=${file} PARENT_SCOPE)
endfunction()

# talus_embed_into(target entries...): adds the source that defines all entries (see embed.cmake).
set(TALUS_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_DIR}/embed.cmake)
function(talus_embed_into target)
  list(JOIN ARGN "\n" lines)
  set(list ${CMAKE_CURRENT_BINARY_DIR}/embedded.txt)
  file(CONFIGURE OUTPUT ${list} CONTENT "${lines}\n" @ONLY)
  set(files ${ARGN})
  list(TRANSFORM files REPLACE "^[^=]+=" "")
  set(output ${CMAKE_CURRENT_BINARY_DIR}/embedded.cpp)
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DLIST=${list} -DOUTPUT=${output} -P ${TALUS_EMBED_SCRIPT}
    DEPENDS ${list} ${files} ${TALUS_EMBED_SCRIPT} VERBATIM)
  set_source_files_properties(${output} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON SKIP_PRECOMPILE_HEADERS ON)
  target_sources(${target} PRIVATE ${output})
endfunction()
