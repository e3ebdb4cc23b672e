// Numbers, texts and meshes through a descriptor, from one process to a copy of it on the same machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "common/scene/mesh_import.h"

namespace airlight {

// All throw MachineError where the descriptor fails.
class ImportStream {
 public:
  explicit ImportStream(int descriptor) : descriptor_(descriptor) {}

  void put(std::uint64_t);
  void put(const std::string&);
  void put(const MeshRequest&);
  void put(const ImportedFile&);

  std::uint64_t number();
  std::string text();
  MeshRequest request();
  ImportedFile file();

 private:
  template <class T>
  void put_all(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    put(values.size());
    write(values.data(), values.size() * sizeof(T));
  }
  template <class T>
  std::vector<T> all() {
    std::vector<T> values(number());
    read(values.data(), values.size() * sizeof(T));
    return values;
  }
  void write(const void*, std::size_t);
  void read(void*, std::size_t);

  int descriptor_;
};

}  // namespace airlight
