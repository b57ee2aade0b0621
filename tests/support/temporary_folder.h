#pragma once
/// A folder for one test.

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace talus::test {

/// A fresh folder that is removed with everything in it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    // In memory where there is such a place: some tests make many small files durable.
    std::filesystem::path place = "/dev/shm";
    if (access(place.c_str(), W_OK) != 0) place = std::filesystem::temp_directory_path();
    std::string name = (place / "talus-test-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    folder_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return folder_; }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

 private:
  std::filesystem::path folder_;
};

/// The path of what is called so in a folder, with whatever follows: the store ends the names of a run's
/// files with a mark of their writer.
inline std::string path_beginning(const std::filesystem::path& folder, const std::string& name) {
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none))
    if (entry.path().filename().string().starts_with(name)) return entry.path().string();
  return (folder / name).string();
}

}  // namespace talus::test
