# Compiles through ccache if it is installed. Paths are relative to the checkout, so that clones in different folders
# share the cache. CMAKE_CXX_COMPILER_LAUNCHER, if set, is kept.
find_program(TALUS_CCACHE ccache)
if(TALUS_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER env CCACHE_BASEDIR=${CMAKE_SOURCE_DIR} CCACHE_NOHASHDIR=true
    CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_ctime,include_file_mtime ${TALUS_CCACHE})
endif()
