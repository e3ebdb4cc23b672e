#include "common/scene/import_stream.h"

#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "common/error.h"

namespace airlight {

namespace {

[[noreturn]] void failed(int number) {
  throw MachineError("what was read of a mesh cannot be handed on: " + std::generic_category().message(number));
}

}  // namespace

void ImportStream::write(const void* bytes, std::size_t size) {
  const char* at = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t n = ::write(descriptor_, at, size);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) failed(errno);
    at += n, size -= static_cast<std::size_t>(n);
  }
}

void ImportStream::read(void* bytes, std::size_t size) {
  char* at = static_cast<char*>(bytes);
  while (size > 0) {
    const ssize_t n = ::read(descriptor_, at, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) failed(n < 0 ? errno : EPIPE);
    at += n, size -= static_cast<std::size_t>(n);
  }
}

void ImportStream::put(std::uint64_t v) { write(&v, sizeof v); }

void ImportStream::put(const std::string& text) {
  put(text.size());
  write(text.data(), text.size());
}

void ImportStream::put(const MeshRequest& r) {
  put(r.path);
  put(static_cast<std::uint64_t>(r.flat));
  put(static_cast<std::uint64_t>(r.by_material));
  put(static_cast<std::uint64_t>(r.part));
}

void ImportStream::put(const ImportedFile& f) {
  put(f.content_hash);
  put(f.meshes.size());
  for (const ImportedMesh& m : f.meshes) {
    static_assert(std::is_trivially_copyable_v<Material>);
    put(static_cast<std::uint64_t>(m.part));
    write(&m.material, sizeof m.material);
    put(m.mesh->file);
    put_all(m.mesh->positions);
    put_all(m.mesh->normals);
    put_all(m.mesh->triangles);
  }
}

std::uint64_t ImportStream::number() {
  std::uint64_t v = 0;
  read(&v, sizeof v);
  return v;
}

std::string ImportStream::text() {
  std::string text(number(), '\0');
  read(text.data(), text.size());
  return text;
}

MeshRequest ImportStream::request() {
  MeshRequest r;
  r.path = text();
  r.flat = number() != 0;
  r.by_material = number() != 0;
  r.part = static_cast<int>(number());
  return r;
}

ImportedFile ImportStream::file() {
  ImportedFile f;
  f.content_hash = text();
  f.meshes.resize(number());
  for (ImportedMesh& m : f.meshes) {
    m.part = static_cast<int>(number());
    read(&m.material, sizeof m.material);
    Mesh mesh;
    mesh.file = text();
    mesh.positions = all<glm::vec3>();
    mesh.normals = all<glm::vec3>();
    mesh.triangles = all<glm::uvec3>();
    m.mesh = std::make_shared<const Mesh>(std::move(mesh));
  }
  return f;
}

}  // namespace airlight
