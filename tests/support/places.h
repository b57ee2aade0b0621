#pragma once
/// Where the sources and the build are. The values are in a source of their own, written by CMake: as
/// definitions on the command line they would keep another clone from finding any test in the cache of the
/// compiler.

#include <string>

namespace talus::test {

std::string source_folder();  ///< of the checkout
std::string build_folder();   ///< of this build
std::string talus_program();  ///< the path of `talus`
std::string
faults_library();  ///< the path of what makes calls to the system fail (tests/reliability/preload.cpp)

}  // namespace talus::test
