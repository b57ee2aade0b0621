# Every target of the project links talus_options: warnings are errors, and arithmetic is what is written.
include(CheckCXXSourceCompiles)
add_library(talus_options INTERFACE)
target_compile_options(talus_options INTERFACE
  -Wall -Wextra -Wpedantic -Wnon-virtual-dtor -Woverloaded-virtual
  # Of sources that are compiled as one text, clang compares names that each keeps to itself.
  $<$<NOT:$<AND:$<CXX_COMPILER_ID:Clang>,$<BOOL:${TALUS_UNITY}>>>:-Wshadow>
  # Same bits for every compiler and optimisation level: no fused multiply-add behind our back.
  -ffp-contract=off
  # Nobody reads errno or the flags of the arithmetic: so loops with a square root or a choice vectorise, with the same bits.
  -fno-math-errno -fno-trapping-math
  # gcc looks for memory to free again only from half a gigabyte on: a tenth less time to compile.
  "$<$<CXX_COMPILER_ID:GNU>:SHELL:--param ggc-min-heapsize=524288>")
string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
# With a sanitizer gcc warns of faults that are none, as its manual says (array-bounds within std::string, by the length of
# the path of the sources): there a warning is only that.
if(NOT CMAKE_CXX_FLAGS_${build_type} MATCHES "-fsanitize")
  target_compile_options(talus_options INTERFACE -Werror)
endif()
# Where the target has one (-march=native), gcc's vectoriser of straight code fuses a b -+ c d in spite of that flag (seen
# with gcc 12). Elsewhere it stays: without it a small bed takes a tenth longer.
set(CMAKE_REQUIRED_FLAGS "${CMAKE_CXX_FLAGS_${build_type}}")
unset(TALUS_GCC_HAS_FMA CACHE)
check_cxx_source_compiles("
#if defined(__clang__) || !defined(__FP_FAST_FMA)
#error
#endif
int main() {}" TALUS_GCC_HAS_FMA)
unset(CMAKE_REQUIRED_FLAGS)
if(TALUS_GCC_HAS_FMA)
  target_compile_options(talus_options INTERFACE -fno-tree-slp-vectorize)
endif()
if(TALUS_SANITIZE)
  target_compile_options(talus_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_link_options(talus_options INTERFACE -fsanitize=address,undefined)
endif()
if(TALUS_FUZZ)
  target_compile_options(talus_options INTERFACE -fsanitize=float-cast-overflow -fno-sanitize-recover=float-cast-overflow)
endif()
# The library of the sanitizer, for a program that is not built with it and loads what is (LD_PRELOAD): Python.
set(sanitizer "")
if(TALUS_SANITIZE)
  set(sanitizer asan)
elseif(CMAKE_CXX_FLAGS_${build_type} MATCHES "-fsanitize=thread")
  set(sanitizer tsan)
endif()
if(sanitizer)
  set(file lib${sanitizer}.so)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    set(file libclang_rt.${sanitizer}-${CMAKE_SYSTEM_PROCESSOR}.so)
  endif()
  execute_process(COMMAND ${CMAKE_CXX_COMPILER} -print-file-name=${file} OUTPUT_VARIABLE TALUS_SANITIZER_LIBRARY OUTPUT_STRIP_TRAILING_WHITESPACE)
endif()
# Sums in their written order, and no fused multiply-add: Eigen's own vector code has neither.
target_compile_definitions(talus_options INTERFACE EIGEN_DONT_VECTORIZE)
target_include_directories(talus_options INTERFACE ${CMAKE_SOURCE_DIR}/src ${CMAKE_SOURCE_DIR})
