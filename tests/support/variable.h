#pragma once
/// Environment of this process.

#include <cstdlib>
#include <string>

namespace talus::test {

/// Sets a variable of the environment that exists, for this process and its children, during its lifetime.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name), before_(std::getenv(name)) {
    setenv(name, value.c_str(), 1);
  }
  ~Variable() { setenv(name_, before_.c_str(), 1); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::string before_;
};

}  // namespace talus::test
