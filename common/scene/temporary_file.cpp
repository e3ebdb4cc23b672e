#include "common/scene/temporary_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <mutex>
#include <set>
#include <system_error>

#include "common/error.h"
#include "common/scene/files.h"
#include "common/scene/image_file.h"

namespace airlight {

namespace {

// The names of all temporaries that exist, so that an interrupted program can remove them.
struct Registry {
  std::mutex mutex;
  std::set<std::string> names;
  unsigned next = 0;
};

Registry& registry() {
  static Registry r;
  return r;
}

std::string reason(int error) { return std::generic_category().message(error); }

bool full(int error) { return error == ENOSPC || error == EFBIG || error == EDQUOT; }

// A write beyond the limit of file sizes raises SIGXFSZ, which would end the program; blocked in this thread it becomes
// EFBIG.
class NoFileSizeSignal {
 public:
  NoFileSizeSignal() {
    sigemptyset(&signal_);
    sigaddset(&signal_, SIGXFSZ);
    pthread_sigmask(SIG_BLOCK, &signal_, &before_);
  }
  ~NoFileSizeSignal() {
    const timespec now{0, 0};
    if (sigismember(&before_, SIGXFSZ) == 0) sigtimedwait(&signal_, nullptr, &now);
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  NoFileSizeSignal(const NoFileSizeSignal&) = delete;
  NoFileSizeSignal& operator=(const NoFileSizeSignal&) = delete;

 private:
  sigset_t signal_{}, before_{};
};

}  // namespace

TemporaryFile::TemporaryFile(const std::string& target) : target_(target) {
  const std::lock_guard lock(registry().mutex);
  for (int attempt = 0; attempt < 1000 && descriptor_ < 0; ++attempt) {
    name_ = fmt::format("{}/.airlight-{}-{}.tmp", folder_of(target), getpid(), registry().next++);
    descriptor_ = open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno != EEXIST) break;
  }
  if (descriptor_ < 0) {
    const int error = errno;
    if (full(error)) throw MachineError(fmt::format("{}: cannot be written: {}", target, reason(error)));
    throw InputError(fmt::format("{}: cannot be written: {}", target, reason(error)));
  }
  registry().names.insert(name_);
}

TemporaryFile::~TemporaryFile() {
  if (descriptor_ >= 0) close(descriptor_);
  const std::lock_guard lock(registry().mutex);
  if (registry().names.erase(name_) > 0) unlink(name_.c_str());
}

void TemporaryFile::write(const void* bytes, std::size_t size) {
  const NoFileSizeSignal no_signal;
  for (const auto* at = static_cast<const char*>(bytes); size > 0;) {
    const ssize_t written = ::write(descriptor_, at, size);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw MachineError(fmt::format("{}: writing failed: {}", target_, reason(errno)));
    at += written;
    size -= static_cast<std::size_t>(written);
  }
}

void TemporaryFile::write_at(std::uint64_t offset, const void* bytes, std::size_t size) {
  const NoFileSizeSignal no_signal;
  for (const auto* at = static_cast<const char*>(bytes); size > 0;) {
    const ssize_t written = ::pwrite(descriptor_, at, size, static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw MachineError(fmt::format("{}: writing failed: {}", target_, reason(errno)));
    at += written;
    offset += static_cast<std::uint64_t>(written);
    size -= static_cast<std::size_t>(written);
  }
}

void TemporaryFile::rename_to_target() {
  const int closed = close(descriptor_);
  descriptor_ = -1;
  if (closed != 0) throw MachineError(fmt::format("{}: writing failed: {}", target_, reason(errno)));
  const std::lock_guard lock(registry().mutex);
  if (!registry().names.contains(name_)) throw Interrupted();  // remove_temporaries() was here
  if (rename(name_.c_str(), target_.c_str()) != 0) {
    throw InputError(fmt::format("{}: cannot be replaced: {}", target_, reason(errno)));
  }
  registry().names.erase(name_);
}

void remove_temporaries() noexcept {
  const std::lock_guard lock(registry().mutex);
  for (const std::string& name : registry().names) unlink(name.c_str());
  registry().names.clear();
}

}  // namespace airlight
