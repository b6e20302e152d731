#include "mesh/interposed_calls.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <dlfcn.h>
#include <fcntl.h>
#include <mutex>
#include <sys/stat.h>
#include <unistd.h>

#include "mesh/mesh_guard.h"

namespace pounding {
namespace {

/// Files on their way: none before it begins, and libraries open some before main does.
struct OpenedFiles {
  std::mutex mutex;
  std::vector<std::string> paths;
};
OpenedFiles* opened = nullptr;

std::string folder_of(int folder) {
  const std::string link =
      folder == AT_FDCWD ? "/proc/self/cwd" : "/proc/self/fd/" + std::to_string(folder);
  std::string path(4096, '\0');
  const ssize_t length = readlink(link.c_str(), path.data(), path.size());
  path.resize(length > 0 ? static_cast<std::size_t>(length) : 0);
  return path;
}

void note(int folder, const char* name, int descriptor) {
  if (opened == nullptr || descriptor < 0 || name == nullptr) return;
  struct stat state {};
  if (fstat(descriptor, &state) != 0 || !S_ISREG(state.st_mode)) return;
  std::string path(name);
  if (!path.starts_with('/')) path = folder_of(folder) + "/" + path;
  for (const char* of_the_system : {"/proc/", "/sys/", "/dev/"}) {
    if (path.starts_with(of_the_system)) return;
  }
  const std::lock_guard lock(opened->mutex);
  if (std::ranges::find(opened->paths, path) == opened->paths.end()) {
    opened->paths.push_back(std::move(path));
  }
}

/// The C library's own function of this name.
template <typename Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

int open_at(int folder, const char* name, int flags, mode_t mode) {
  static auto* const real = next<int(int, const char*, int, ...)>("openat");
  const int descriptor = real(folder, name, flags, mode);
  note(folder, name, descriptor);
  return descriptor;
}

using OpenStream = std::FILE*(const char*, const char*);

std::FILE* open_stream(OpenStream* real, const char* name, const char* mode) {
  std::FILE* const stream = real(name, mode);
  if (stream != nullptr) note(AT_FDCWD, name, fileno(stream));
  return stream;
}

/// The mode behind the flags, which a call that makes a file has.
mode_t mode_of(int flags, std::va_list list) {
  return (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(list, mode_t) : 0;
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

// Labels, since the headers declare these names in several ways.
extern "C" {

int interposed_open(const char* name, int flags, ...) __asm__("open");
int interposed_open64(const char* name, int flags, ...) __asm__("open64");
int interposed_openat(int folder, const char* name, int flags, ...) __asm__("openat");
int interposed_openat64(int folder, const char* name, int flags, ...) __asm__("openat64");
int interposed_open_2(const char* name, int flags) __asm__("__open_2");
int interposed_open64_2(const char* name, int flags) __asm__("__open64_2");
int interposed_openat_2(int folder, const char* name, int flags) __asm__("__openat_2");
int interposed_openat64_2(int folder, const char* name, int flags) __asm__("__openat64_2");
std::FILE* interposed_fopen(const char* name, const char* mode) __asm__("fopen");
std::FILE* interposed_fopen64(const char* name, const char* mode) __asm__("fopen64");
int interposed_system(const char* command) __asm__("system");
std::FILE* interposed_popen(const char* command, const char* mode) __asm__("popen");

int interposed_open(const char* name, int flags, ...) {
  std::va_list list;
  va_start(list, flags);
  const mode_t mode = mode_of(flags, list);
  va_end(list);
  return open_at(AT_FDCWD, name, flags, mode);
}

int interposed_open64(const char* name, int flags, ...) {
  std::va_list list;
  va_start(list, flags);
  const mode_t mode = mode_of(flags, list);
  va_end(list);
  return open_at(AT_FDCWD, name, flags, mode);
}

int interposed_openat(int folder, const char* name, int flags, ...) {
  std::va_list list;
  va_start(list, flags);
  const mode_t mode = mode_of(flags, list);
  va_end(list);
  return open_at(folder, name, flags, mode);
}

int interposed_openat64(int folder, const char* name, int flags, ...) {
  std::va_list list;
  va_start(list, flags);
  const mode_t mode = mode_of(flags, list);
  va_end(list);
  return open_at(folder, name, flags, mode);
}

int interposed_open_2(const char* name, int flags) {
  return open_at(AT_FDCWD, name, flags, 0);
}

int interposed_open64_2(const char* name, int flags) {
  return open_at(AT_FDCWD, name, flags, 0);
}

int interposed_openat_2(int folder, const char* name, int flags) {
  return open_at(folder, name, flags, 0);
}

int interposed_openat64_2(int folder, const char* name, int flags) {
  return open_at(folder, name, flags, 0);
}

std::FILE* interposed_fopen(const char* name, const char* mode) {
  static auto* const real = next<OpenStream>("fopen");
  return open_stream(real, name, mode);
}

std::FILE* interposed_fopen64(const char* name, const char* mode) {
  static auto* const real = next<OpenStream>("fopen64");
  return open_stream(real, name, mode);
}

int interposed_system(const char* command) {
  if (command == nullptr) return 1;  // the question whether there is a shell
  deny("run the command '" + std::string(command) + "'");
}

std::FILE* interposed_popen(const char* command, const char* /*mode*/) {
  deny("run the command '" + std::string(command) + "'");
}

}  // extern "C"

}  // namespace pounding
