// Meshes read in processes of their own, with limits: whatever a file does to the mesh library, it is refused in one line.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <mutex>

#include "common/scene/mesh_import.h"

namespace airlight {

// Of a process that reads one file, with those that it names. Both grow with the bytes that it reads.
struct ImportLimits {
  std::uint64_t memory = std::uint64_t{4} << 30U;  // [byte] of addresses
  std::uint64_t memory_a_byte = 16;
  int seconds = 10;  // of CPU time
  std::uint64_t bytes_a_second = std::uint64_t{2} << 20U;
};

// Of a process that still has one thread a copy is made, which waits; for each file it makes a copy of itself that reads it and
// ends. What was read comes back in a file without a name, in memory.
class ImportProcess {
 public:
  using Import = std::function<ImportedFile(const MeshRequest&, const BeforeReading&, Progress&)>;

  // To be called by the main thread, before there is another. Throws MachineError. `import` is what the copies call.
  explicit ImportProcess(const ImportLimits& = {}, Import import = import_here);
  ~ImportProcess();
  ImportProcess(const ImportProcess&) = delete;
  ImportProcess& operator=(const ImportProcess&) = delete;

  // As import_here(). Beyond the limits, and for a copy that ends by a signal: InputError "path: ...". From any thread; after
  // Interrupted not again.
  ImportedFile import(const MeshRequest&, Progress&);

  // Not under a sanitizer, whose own memory has more addresses than any file is given.
  static const bool bounds_memory;

  // The one of this process that was made first, or null.
  static ImportProcess* running();

 private:
  [[noreturn]] void serve(int socket) const;
  [[noreturn]] void read_one(int descriptor) const;
  std::string told(int status, std::uint64_t bytes) const;

  ImportLimits limits_;
  Import import_;
  std::mutex mutex_;
  pid_t server_ = -1;
  int socket_ = -1;
};

}  // namespace airlight
