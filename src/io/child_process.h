#pragma once
/// Work that must not be able to end this process: on bytes that nobody vouches for, by a library that they
/// may crash.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace talus {

/// Bytes that `work` returns in a child process. The child has no more than 10 s of processor time and 1 s
/// for each MiB of `input`, the size of what it reads in bytes, and six times that by the clock; 2 GiB of
/// memory and 64 times `input` beside what this process has; and it writes no files. An Error that `work`
/// throws is thrown here; where the child ends in any other way, this throws Error(bad_data) with the name
/// `path`. Not while another thread holds what `work` needs.
std::vector<std::byte> in_child_process(const std::string& path, std::size_t input,
                                        const std::function<std::vector<std::byte>()>& work);

}  // namespace talus
