// Runs the program as a user would: a shell command, its output, its exit code.
#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace airlight {

struct Told {
  std::string out, err;
  int code = -1;  // 128 + n for a signal
};

inline std::string content(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

// A folder of its own below the system's temporary one, removed with its content.
class Work {
 public:
  explicit Work(const std::string& name = "airlight cli") {
    std::string pattern = (std::filesystem::temp_directory_path() / (name + " XXXXXX")).string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = pattern;
  }
  ~Work() { std::filesystem::remove_all(path_); }
  Work(const Work&) = delete;
  Work& operator=(const Work&) = delete;

  std::filesystem::path path(const std::string& name = "") const { return path_ / name; }
  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(path_), std::filesystem::directory_iterator()));
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(path(name), std::ios::binary) << text; }

  // `arguments` as in a shell whose working folder is this; `before` stands before the program.
  Told run(const std::string& arguments, const std::string& before = "") const {
    const std::string out = quoted(path(".out").string()), err = quoted(path(".err").string());
    const std::string line =
        "cd " + quoted(path_.string()) + " && " + before + " " AIRLIGHT_PROGRAM " " + arguments + " >" + out + " 2>" + err;
    const int status = std::system(line.c_str());
    Told told{content(path(".out")), content(path(".err")), WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status)};
    std::filesystem::remove(path(".out"));
    std::filesystem::remove(path(".err"));
    return told;
  }
  static std::string quoted(const std::string& text) { return "'" + text + "'"; }

 private:
  std::filesystem::path path_;
};

}  // namespace airlight
