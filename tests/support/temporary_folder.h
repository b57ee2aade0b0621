#pragma once
/// Folder for one test.

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace talus::test {

/// Fresh folder that is removed with its contents.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    // In memory if possible, because some tests make many small files durable.
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

/// Tests in a folder of their own.
class FolderTest : public testing::Test {
 protected:
  const TemporaryFolder folder;
};

/// Returns the path of the entry whose name begins with `name`: the store appends a mark of the writer to the
/// names of a run's files.
inline std::string path_beginning(const std::filesystem::path& folder, const std::string& name) {
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none))
    if (entry.path().filename().string().starts_with(name)) return entry.path().string();
  return (folder / name).string();
}

}  // namespace talus::test
