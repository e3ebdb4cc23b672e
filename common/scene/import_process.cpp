#include "common/scene/import_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <new>
#include <system_error>
#include <utility>

#include "common/error.h"
#include "common/scene/import_stream.h"

namespace airlight {

namespace {

// How a copy begins its answer.
enum class Answer : std::uint64_t { file, input_error, machine_error, no_memory };

ImportProcess* first = nullptr;

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { close(number_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }

 private:
  int number_;
};

[[noreturn]] void failed(const char* what) {
  throw MachineError(fmt::format("{}: {}", what, std::generic_category().message(errno)));
}

// A byte with a descriptor beside it (unix(7)).
struct Parcel {
  char byte = 0;
  iovec content{&byte, 1};
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof(int))] = {};
  msghdr header = {};

  Parcel() {
    header.msg_iov = &content, header.msg_iovlen = 1, header.msg_control = control, header.msg_controllen = sizeof control;
  }

  bool send(int socket, int descriptor) {
    cmsghdr* const c = CMSG_FIRSTHDR(&header);
    c->cmsg_level = SOL_SOCKET, c->cmsg_type = SCM_RIGHTS, c->cmsg_len = CMSG_LEN(sizeof descriptor);
    std::memcpy(CMSG_DATA(c), &descriptor, sizeof descriptor);
    return sendmsg(socket, &header, MSG_NOSIGNAL) == 1;
  }
  // -1: the other end is closed.
  int receive(int socket) {
    ssize_t n = -1;
    while ((n = recvmsg(socket, &header, MSG_CMSG_CLOEXEC)) < 0 && errno == EINTR) continue;
    const cmsghdr* const c = n == 1 ? CMSG_FIRSTHDR(&header) : nullptr;
    int descriptor = -1;
    if (c && c->cmsg_type == SCM_RIGHTS) std::memcpy(&descriptor, CMSG_DATA(c), sizeof descriptor);
    return descriptor;
  }
};

void limit(int what, std::uint64_t soft) {
  rlimit r{};
  getrlimit(static_cast<__rlimit_resource>(what), &r);
  r.rlim_cur = std::min<rlim_t>(soft, r.rlim_max);
  setrlimit(static_cast<__rlimit_resource>(what), &r);
}

// Ends with the process that made it, and says nothing.
void follow(pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);
}

std::uint64_t memory_limit(const ImportLimits& l, std::uint64_t bytes) { return l.memory + l.memory_a_byte * bytes; }
std::uint64_t time_limit(const ImportLimits& l, std::uint64_t bytes) {
  return static_cast<std::uint64_t>(l.seconds) + bytes / l.bytes_a_second;
}

}  // namespace

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
const bool ImportProcess::bounds_memory = false;
#elif defined(__has_feature)
const bool ImportProcess::bounds_memory = !__has_feature(address_sanitizer) && !__has_feature(thread_sanitizer);
#else
const bool ImportProcess::bounds_memory = true;
#endif

ImportProcess* ImportProcess::running() { return first; }

ImportProcess::ImportProcess(const ImportLimits& limits, Import import) : limits_(limits), import_(std::move(import)) {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) failed("no socket for the process that reads meshes");
  const pid_t parent = getpid();
  server_ = fork();
  if (server_ == 0) {
    follow(parent);
    serve(ends[1]);
  }
  close(ends[1]);
  socket_ = ends[0];
  if (server_ < 0) {
    close(socket_);
    failed("no process to read meshes in");
  }
  if (!first) first = this;
}

ImportProcess::~ImportProcess() {
  if (first == this) first = nullptr;
  close(socket_);
  kill(server_, SIGKILL);
  waitpid(server_, nullptr, 0);
}

void ImportProcess::serve(int socket) const {
  // What a terminal or a shell sends to all of them is the parent's to answer. So are its streams: who waits for their end waits
  // for the parent.
  signal(SIGINT, SIG_IGN), signal(SIGTERM, SIG_IGN);
  const int nowhere = open("/dev/null", O_RDWR);
  for (int stream = 0; stream < 3; ++stream) dup2(nowhere, stream);
  for (;;) {
    const int descriptor = Parcel().receive(socket);
    if (descriptor < 0) _exit(0);
    const pid_t self = getpid(), reader = fork();
    if (reader == 0) {
      follow(self);
      read_one(descriptor);
    }
    close(descriptor);
    int status = -1;
    if (reader > 0) waitpid(reader, &status, 0);
    if (send(socket, &status, sizeof status, MSG_NOSIGNAL) != sizeof status) _exit(1);
  }
}

void ImportProcess::read_one(int descriptor) const {
  ImportStream stream(descriptor);
  std::uint64_t bytes = 0;
  const auto bound = [&] {
    if (bounds_memory) limit(RLIMIT_AS, memory_limit(limits_, bytes));
    limit(RLIMIT_CPU, time_limit(limits_, bytes));
  };
  limit(RLIMIT_CORE, 0);
  bound();
  const auto tell_bytes = [&] {
    if (pwrite(descriptor, &bytes, sizeof bytes, 0) != sizeof bytes) _exit(1);
  };
  const auto answer = [&](Answer a, const std::string& text) {
    lseek(descriptor, 0, SEEK_SET);
    stream.put(bytes);
    stream.put(static_cast<std::uint64_t>(a));
    if (a != Answer::file) stream.put(text);
  };
  try {
    const MeshRequest request = stream.request();
    if (ftruncate(descriptor, 0) != 0) _exit(1);
    tell_bytes();  // at each change: also of a copy that does not come to its answer
    const BeforeReading before_reading = [&](std::uint64_t more) { bytes += more, bound(), tell_bytes(); };
    NoProgress none;
    try {
      const ImportedFile file = import_(request, before_reading, none);
      answer(Answer::file, "");
      stream.put(file);
    } catch (const InputError& e) {
      answer(Answer::input_error, e.what());
    } catch (const std::bad_alloc&) {
      answer(Answer::no_memory, "");
    } catch (const std::exception& e) {
      answer(Answer::machine_error, request.path + ": " + e.what());
    }
  } catch (...) {
    _exit(1);
  }
  _exit(0);
}

ImportedFile ImportProcess::import(const MeshRequest& request, Progress& progress) {
  const std::lock_guard lock(mutex_);
  const Descriptor shared(memfd_create("airlight mesh", MFD_CLOEXEC));
  if (shared.number() < 0) failed("no memory to hand meshes over");
  ImportStream stream(shared.number());
  stream.put(request);
  lseek(shared.number(), 0, SEEK_SET);
  if (!Parcel().send(socket_, shared.number())) throw MachineError("the process that reads meshes has ended");

  pollfd ready{socket_, POLLIN, 0};
  int status = -1;
  while (poll(&ready, 1, 50) <= 0) progress.check();
  if (recv(socket_, &status, sizeof status, MSG_WAITALL) != sizeof status)
    throw MachineError("the process that reads meshes has ended");

  lseek(shared.number(), 0, SEEK_SET);
  const std::uint64_t bytes = stream.number();
  if (status == -1) throw MachineError(request.path + ": no process to read it in");
  if (!WIFEXITED(status)) throw InputError(request.path + ": " + told(status, bytes));
  if (WEXITSTATUS(status) != 0) throw MachineError(request.path + ": what was read of it does not fit into memory");
  switch (static_cast<Answer>(stream.number())) {
    case Answer::file:
      return stream.file();
    case Answer::input_error:
      throw InputError(stream.text());
    case Answer::machine_error:
      throw MachineError(stream.text());
    case Answer::no_memory:
      break;
  }
  throw InputError(fmt::format("{}: takes more than {} MiB of memory to read, expected less", request.path,
                               memory_limit(limits_, bytes) >> 20U));
}

// How a copy ended that did not end by itself.
std::string ImportProcess::told(int status, std::uint64_t bytes) const {
  const int number = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  if (number == SIGXCPU) return fmt::format("takes more than {} s to read, expected less", time_limit(limits_, bytes));
  return fmt::format("not a readable mesh: reading it ended by signal {} ({})", number, strsignal(number));
}

}  // namespace airlight
