#pragma once
/// File system in memory of a given size, during its lifetime. Requires root.

#include <sys/mount.h>

#include <filesystem>
#include <string>

namespace talus::test {

class SmallDisk {
 public:
  /// Mounts it in a folder, which is created.
  explicit SmallDisk(const std::filesystem::path& folder, int kib = 64) : folder_(folder) {
    std::filesystem::create_directory(folder_);
    mounted_ = mount("tmpfs", folder_.c_str(), "tmpfs", 0, size_of(kib).c_str()) == 0;
  }
  ~SmallDisk() {
    if (mounted_) umount2(folder_.c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  bool is_mounted() const { return mounted_; }
  /// The following functions return whether they succeeded.
  bool forbid_writing() const {
    return mount("tmpfs", folder_.c_str(), "tmpfs", MS_REMOUNT | MS_RDONLY, nullptr) == 0;
  }
  bool resize(int kib) const {
    return mount("tmpfs", folder_.c_str(), "tmpfs", MS_REMOUNT, size_of(kib).c_str()) == 0;
  }

 private:
  static std::string size_of(int kib) { return "size=" + std::to_string(kib) + "k"; }

  std::filesystem::path folder_;
  bool mounted_;
};

}  // namespace talus::test
