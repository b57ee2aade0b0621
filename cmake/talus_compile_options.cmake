# Every target of the project links talus_options: warnings are errors, and arithmetic is what is written.
add_library(talus_options INTERFACE)
target_compile_options(talus_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Werror
  # Same bits for every compiler and optimisation level: no fused multiply-add behind our back.
  -ffp-contract=off)
if(TALUS_SANITIZE)
  target_compile_options(talus_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_link_options(talus_options INTERFACE -fsanitize=address,undefined)
endif()
target_include_directories(talus_options INTERFACE ${CMAKE_SOURCE_DIR}/src ${CMAKE_SOURCE_DIR})
