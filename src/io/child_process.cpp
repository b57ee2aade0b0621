#include "io/child_process.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fstream>
#include <mutex>
#include <new>
#include <optional>
#include <set>
#include <thread>

#include "base/child_program.h"
#include "base/errors.h"
#include "base/output_file.h"
#include "base/version.h"
#include "io/hdf5_file.h"
#include "io/run_file.h"
#include "io/run_folder.h"

namespace talus::io {

namespace {

using Bytes = std::vector<std::byte>;

constexpr rlim_t mebibyte = rlim_t{1} << 20;

void limit(__rlimit_resource resource, rlim_t most) {
  const rlimit both = {most, most};
  setrlimit(resource, &both);
}

/// Returns the memory mapped by this process, which its child inherits, bytes; 0 if unknown.
rlim_t address_space() {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
}

/// Closes everything that the child inherits except its pipe, and returns the new number of the pipe. A lock
/// lasts as long as any process has its file open, and a pipe as long as a process can write to it.
int close_all_but(int pipe) {
  constexpr int kept = STDERR_FILENO + 1;
  if (pipe != kept) ::dup2(pipe, kept);
  ::close_range(kept + 1, ~0U, 0);
  return kept;
}

/// Restricts a child of `parent`, and silences its output.
void restrict_child(pid_t parent, std::size_t input) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) _exit(1);  // the parent has already ended
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGALRM}) std::signal(signal, SIG_DFL);
  const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, stream);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, 0);
  const rlim_t seconds = 10 + input / mebibyte;
  limit(RLIMIT_CPU, seconds);
  ::alarm(static_cast<unsigned>(6 * seconds));  // ends a child that blocks
  // The shadow memory of AddressSanitizer exceeds any limit.
  if (!sanitizes_addresses) limit(RLIMIT_AS, address_space() + 2048 * mebibyte + 64 * input);
}

/// Returns the message of the child: the result or an error message, with the exit code as the last byte.
Bytes message_of(ExitCode code, Bytes content) {
  content.push_back(static_cast<std::byte>(code));
  return content;
}

Bytes outcome_of(const std::string& path, const std::function<Parcels()>& work) {
  const auto too_much = [&path] {
    return message_of(ExitCode::bad_data,
                      bytes_of(path + ": asks for more memory than a file of its size can need"));
  };
  try {
    return message_of(ExitCode::done, encode(work()));
  } catch (const Error& error) {
    return error.code() == ExitCode::out_of_memory
               ? too_much()
               : message_of(error.code(), bytes_of(std::string(error.what())));
  } catch (const std::bad_alloc&) {
    return too_much();
  }
}

void send(int pipe, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(pipe, bytes.data(), bytes.size());
    if (count < 0 && errno != EINTR) _exit(1);
    if (count > 0) bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
}

struct Child {
  pid_t process;
  Descriptor pipe;  ///< receives the child's output
};

/// Forks a child for which may_use_hdf5 holds, unless another thread uses HDF5 now. HDF5 before 2 holds its
/// lock while it calls back, and gives it to the child; the lock of HDF5 2 belongs to a thread of the kernel,
/// and a child could never take one that its parent holds.
pid_t fork_for_hdf5() {
#if H5_VERSION_GE(2, 0, 0)
  return ::fork();
#else
  pid_t child = -1;
  int property = 0;
  H5Piterate(
      H5P_FILE_ACCESS_DEFAULT, &property,
      [](hid_t, const char*, void* process) -> herr_t {
        *static_cast<pid_t*>(process) = ::fork();
        return 1;  // ends the iteration
      },
      &child);
  return child;
#endif
}

constexpr int another_thread_uses_hdf5 = 75;  ///< exit code of a child that was forked at a wrong moment

/// Starts a restricted child that sends the outcome of its work, and ends.
Child start(const std::string& path, std::size_t input, const std::function<Parcels()>& work) {
  int ends[2] = {-1, -1};
  if (::pipe2(ends, O_CLOEXEC) != 0) throw system_error(ExitCode::io_error, "make a pipe for", path, errno);
  Child child{-1, Descriptor(ends[0])};
  Descriptor to(ends[1]);
  const pid_t parent = ::getpid();
  hdf5::set_library_policy();
  child.process = fork_for_hdf5();
  if (child.process < 0) throw system_error(ExitCode::io_error, "start a process for", path, errno);
  if (child.process == 0) {
    if (!may_use_hdf5()) _exit(another_thread_uses_hdf5);
    const int pipe = close_all_but(to.get());
    restrict_child(parent, input);
    send(pipe, outcome_of(path, work));
    _exit(0);
  }
  return child;
}

Bytes read_all(const Descriptor& pipe, const std::string& path) {
  Bytes bytes;
  while (true) {
    const std::size_t before = bytes.size();
    bytes.resize(before + mebibyte);
    bytes.resize(before + read_at_most(pipe, std::span(bytes).subspan(before), path));
    if (bytes.size() < before + mebibyte) return bytes;
  }
}

[[noreturn]] void refuse(const std::string& path, int status) {
  const bool too_long = WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGALRM ||
                                                WTERMSIG(status) == SIGKILL);
  throw Error(ExitCode::bad_data, "{}: cannot be read: {}; the file is malformed, write it again", path,
              too_long ? "HDF5 takes longer to read it than its size can justify"
                       : "HDF5 fails on it (in a separate process)");
}

/// Appends the size as 64 bits, followed by the bytes.
void append(Bytes& to, std::span<const std::byte> bytes) {
  const std::uint64_t count = bytes.size();
  const auto counted = std::as_bytes(std::span(&count, 1));
  to.insert(to.end(), counted.begin(), counted.end());
  to.insert(to.end(), bytes.begin(), bytes.end());
}

/// Removes one appended item from the front and returns it. Throws if it is incomplete.
Bytes take(std::span<const std::byte>& from, const std::string& path) {
  std::uint64_t count = 0;
  const bool has_count = from.size() >= sizeof count;
  if (has_count) std::memcpy(&count, from.data(), sizeof count);
  if (!has_count || count > from.size() - sizeof count)
    throw Error(ExitCode::bad_data, path + ": cannot be read: HDF5 returns invalid data");
  const auto bytes = from.subspan(sizeof count, count);
  from = from.subspan(sizeof count + count);
  return {bytes.begin(), bytes.end()};
}

}  // namespace

bool may_use_hdf5() {
#if H5_VERSION_GE(2, 0, 0)
  bool acquired = false;
  unsigned count = 0;
  return H5TSmutex_acquire(1, &acquired) >= 0 && acquired && H5TSmutex_release(&count) >= 0;
#else
  return true;
#endif
}

Bytes encode(const Parcels& parcels) {
  Bytes bytes;
  for (const auto& [name, content] : parcels) {
    append(bytes, std::as_bytes(std::span(name)));
    append(bytes, content);
  }
  return bytes;
}

Parcels decode(std::span<const std::byte> bytes, const std::string& path) {
  Parcels parcels;
  while (!bytes.empty()) {
    const auto name = values_of<std::string>(take(bytes, path));
    parcels.insert_or_assign(name, take(bytes, path));
  }
  return parcels;
}

Parcels in_child_process(const std::string& path, std::size_t input, const std::function<Parcels()>& work) {
  Bytes message;
  int status = 0;
  while (true) {
    const Child child = start(path, input, work);
    message = read_all(child.pipe, path);
    status = wait_for_program(child.process, {});
    if (!WIFEXITED(status) || WEXITSTATUS(status) != another_thread_uses_hdf5) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || message.empty()) refuse(path, status);
  const auto code = static_cast<ExitCode>(message.back());
  message.pop_back();
  if (code == ExitCode::done) return decode(message, path);
  throw Error(code, values_of<std::string>(message));
}

static std::atomic<bool> walks_first = false;

static std::mutex tried_mutex;
static std::set<FileMark> tried;  // guarded by tried_mutex

/// Returns the files of a run; none if the manifest of its folder cannot be read.
static std::vector<std::string> files_of_run(const std::string& run) try {
  if (!is_folder(run)) return {run};
  std::vector<std::string> paths;
  for (const StoredFile& file : files_of(read_manifest(run))) paths.push_back(path_in(run, file.name));
  return paths;
} catch (const Error&) {
  return {};
}

bool walk_before_opening() { return walks_first = true; }

void try_run(const std::string& run) {
  if (!walks_first) return;
  std::size_t bytes = 0;
  const std::vector<std::string> files = files_of_run(run);
  std::set<FileMark> marks;
  for (const std::string& file : files)
    if (const std::optional<FileMark> mark = mark_of_file(file)) {
      marks.insert(*mark);
      bytes += mark->size;
    }
  if (const std::scoped_lock lock(tried_mutex);
      std::includes(tried.begin(), tried.end(), marks.begin(), marks.end()))
    return;
  const auto walk = [&] {
    walks_first = false;  // in the child
    try {
      for (const std::string& file : files) hdf5::Reader::from_file(file).walk();
      RunFile::open(run);
    } catch (const Error&) {  // this process reports it
    }
    return Parcels();
  };
  try {
    in_child_process(run, bytes, walk);
  } catch (const Error& error) {
    if (error.code() != ExitCode::bad_data) return;  // there is no child process
    throw Error(ExitCode::bad_data, run +
                                        ": HDF5 crashes or hangs on this run: it is malformed, although its "
                                        "hash is right; restore it from a copy");
  }
  const std::scoped_lock lock(tried_mutex);
  tried.insert(marks.begin(), marks.end());
}

}  // namespace talus::io
