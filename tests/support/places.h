#pragma once
/// Paths of the sources and the build. CMake writes the values into a separate source: as definitions on the
/// command line they would prevent another clone from using the compiler cache.

#include <string>

namespace talus::test {

std::string source_folder();  ///< root of the checkout
std::string build_folder();   ///< root of this build
std::string talus_program();  ///< path of `talus`
std::string
faults_library();  ///< path of the library that makes system calls fail (tests/reliability/preload.cpp)

}  // namespace talus::test
