#include "mesh/interposed_calls.h"

#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <dlfcn.h>
#include <fcntl.h>
#include <filesystem>
#include <mutex>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace pounding {
namespace {

/// Files on their way: none before it begins, and libraries open some before main does.
struct OpenedFiles {
  std::mutex mutex;
  std::vector<std::string> paths;
};
OpenedFiles* opened = nullptr;

void note(const char* name, int descriptor) {
  if (opened == nullptr || descriptor < 0 || name == nullptr) return;
  struct stat state {};
  if (fstat(descriptor, &state) != 0 || !S_ISREG(state.st_mode)) return;
  std::error_code none;  // where the working folder is gone, the name stays as it is
  std::filesystem::path path(name);
  if (path.is_relative()) path = std::filesystem::current_path(none) / path;
  for (const char* of_the_system : {"/proc/", "/sys/", "/dev/"}) {
    if (path.native().starts_with(of_the_system)) return;
  }
  const std::lock_guard lock(opened->mutex);
  if (std::ranges::find(opened->paths, path.native()) == opened->paths.end()) {
    opened->paths.push_back(path.native());
  }
}

/// Whether a name is that of a pipe, a socket or a device, which a geometry must not wait for.
bool has_no_end(const char* name) {
  struct stat state {};
  if (opened == nullptr || name == nullptr || stat(name, &state) != 0) return false;
  const std::string path(name);
  if (path == "/dev/null" || path == "/dev/urandom" || path == "/dev/random") return false;
  return S_ISFIFO(state.st_mode) || S_ISSOCK(state.st_mode) || S_ISCHR(state.st_mode);
}

}  // namespace

void note_opened_files() {
  static OpenedFiles files;
  opened = &files;
}

std::vector<std::string> opened_files() {
  if (opened == nullptr) return {};
  const std::lock_guard lock(opened->mutex);
  return opened->paths;
}

// Labels, since the headers declare these names in several ways; names of 64 bits are others for
// the same, and so are those that the compiler puts in for calls without a mode.
extern "C" {

int noted_open(const char* name, int flags, ...) __asm__("open");
std::FILE* noted_fopen(const char* name, const char* mode) __asm__("fopen");

int noted_open(const char* name, int flags, ...) {
  std::va_list list;
  va_start(list, flags);
  const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(list, mode_t) : 0;
  va_end(list);
  if (has_no_end(name)) {
    errno = ENXIO;
    return -1;
  }
  const auto descriptor = static_cast<int>(syscall(SYS_openat, AT_FDCWD, name, flags, mode));
  note(name, descriptor);
  return descriptor;
}

std::FILE* noted_fopen(const char* name, const char* mode) {
  static auto* const real =
      reinterpret_cast<std::FILE* (*)(const char*, const char*)>(dlsym(RTLD_NEXT, "fopen"));
  if (has_no_end(name)) {
    errno = ENXIO;
    return nullptr;
  }
  std::FILE* const stream = real(name, mode);
  if (stream != nullptr) note(name, fileno(stream));
  return stream;
}

int noted_open64(const char* name, int flags, ...) __asm__("open64") __attribute__((alias("open")));
int noted_open_2(const char* name, int flags, ...) __asm__("__open_2")
    __attribute__((alias("open")));
int noted_open64_2(const char* name, int flags, ...) __asm__("__open64_2")
    __attribute__((alias("open")));
std::FILE* noted_fopen64(const char* name, const char* mode) __asm__("fopen64")
    __attribute__((alias("fopen")));

}  // extern "C"

}  // namespace pounding
