// A file that appears under its name only when it is complete.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace airlight {

// Made in the folder of `target`; removed on destruction unless it was renamed. Throws InputError when the folder
// cannot be written, MachineError when the disk is full or fails.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& target);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& name() const { return name_; }
  void write(const void* bytes, std::size_t size);                           // at the end
  void write_at(std::uint64_t offset, const void* bytes, std::size_t size);  // anywhere; write() knows nothing of it
  void rename_to_target();

 private:
  std::string target_, name_;
  int descriptor_ = -1;
};

}  // namespace airlight
