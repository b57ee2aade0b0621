# Every target of the project links talus_options: warnings, errors in the gate alone, and arithmetic executed as written.
include(CheckCXXSourceCompiles)
add_library(talus_options INTERFACE)
target_compile_options(talus_options INTERFACE
  -Wall -Wextra -Wpedantic -Wnon-virtual-dtor -Woverloaded-virtual
  # Not for clang in a unity build, where it compares local names of different sources.
  $<$<NOT:$<AND:$<CXX_COMPILER_ID:Clang>,$<BOOL:${TALUS_UNITY}>>>:-Wshadow>
  # Same bits for every compiler and optimisation level: no implicit fused multiply-add.
  -ffp-contract=off
  # No code reads errno or floating-point flags; without them, loops with a square root or a choice vectorise, with the same bits.
  -fno-math-errno -fno-trapping-math
  # gcc collects garbage only above half a gigabyte, which saves a tenth of the compile time.
  "$<$<CXX_COMPILER_ID:GNU>:SHELL:--param ggc-min-heapsize=524288>")
string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
# With a sanitizer gcc gives false warnings, as its manual says (array-bounds within std::string, depending on the length of
# the source path), so warnings are not errors there.
if(TALUS_WERROR AND NOT CMAKE_CXX_FLAGS_${build_type} MATCHES "-fsanitize")
  target_compile_options(talus_options INTERFACE -Werror)
endif()
# On targets with FMA (-march=native), the SLP vectoriser of gcc 12 fuses a b -+ c d despite -ffp-contract=off. It is kept
# on other targets, because a small bed takes a tenth longer without it.
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
# The library of the sanitizer, to be preloaded (LD_PRELOAD) by Python, which is not built with the sanitizer but loads code that is.
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
# Eigen's vector code reorders sums and fuses multiplications and additions.
target_compile_definitions(talus_options INTERFACE EIGEN_DONT_VECTORIZE)
target_include_directories(talus_options INTERFACE ${CMAKE_SOURCE_DIR}/src ${CMAKE_SOURCE_DIR})
