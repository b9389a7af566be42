#pragma once

#include <cstdlib>
#include <string>
#include <utility>

namespace mimicry::test {

/// A variable of the program's environment for the length of a test: it is not set afterwards.
class TestVariable {
 public:
  TestVariable(std::string name, const std::string& value) : name_(std::move(name)) { set(value); }
  ~TestVariable() {
#ifdef _WIN32
    _putenv_s(name_.c_str(), "");
#else
    ::unsetenv(name_.c_str());
#endif
  }
  TestVariable(const TestVariable&) = delete;
  TestVariable& operator=(const TestVariable&) = delete;

  void set(const std::string& value) {
#ifdef _WIN32
    _putenv_s(name_.c_str(), value.c_str());
#else
    ::setenv(name_.c_str(), value.c_str(), 1);
#endif
  }

 private:
  std::string name_;
};

}  // namespace mimicry::test
