// SPDX-License-Identifier: BSD-3-Clause
// LD_PRELOAD=fail_nth.so: one call of a kind fails, once, while main runs. Kinds are
//   alloc   malloc and its like: no memory
//   write   write, writev, fwrite, fflush, fclose of what is written: no space left
//   open    open, fopen, opendir, mkdir, mkdtemp and their like: too many open files
//   rename  rename: input/output error
//
//   FAIL=KIND:N      the N-th of main, from 1
//   FAIL_LIST=FILE   nothing fails; at the end FILE has a line "KIND N" for the first call of a kind from each place, a
//                    place being the functions that lead there. Of one thread it is the same at every run
#define _GNU_SOURCE
#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <execinfo.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t);

enum kind { alloc_kind, write_kind, open_kind, rename_kind, kinds };
static const char* const names[kinds] = {"alloc", "write", "open", "rename"};

#define EXPORT __attribute__((visibility("default")))
#define REAL(name) (__extension__(__typeof__(&name)) dlsym(RTLD_NEXT, #name))

static volatile int armed;
static __thread int inside;
static unsigned long counts[kinds];
static int failing = kinds;
static unsigned long failing_at;
static int list = -1;

enum { depth = 8, places = 1 << 20 };
static uint64_t seen[places];

/// Whether nobody came this way before.
static int new_place(enum kind kind) {
  void* frames[depth + 2];
  const int count = backtrace(frames, depth + 2);
  uint64_t hash = 1469598103934665603U + kind;
  for (int i = 2; i < count; ++i) hash = (hash ^ (uintptr_t)frames[i]) * 1099511628211U;
  hash |= 1;
  for (uint64_t at = hash % places;; at = (at + 1) % places) {
    if (seen[at] == hash) return 0;
    if (seen[at] != 0) continue;
    seen[at] = hash;
    return 1;
  }
}

/// Counts a call; whether it is the one that fails.
static int fails(enum kind kind) {
  if (!armed || inside) return 0;
  const unsigned long n = __atomic_add_fetch(&counts[kind], 1, __ATOMIC_RELAXED);
  if (list >= 0) {
    inside = 1;
    if (new_place(kind)) dprintf(list, "%s %lu\n", names[kind], n);
    inside = 0;
  }
  return failing == (int)kind && n == failing_at;
}

static int (*real_main)(int, char**, char**);

static int watched_main(int argc, char** argv, char** environment) {
  const char* place = getenv("FAIL");
  const char* file = getenv("FAIL_LIST");
  void* frame[2];
  backtrace(frame, 2);  // allocates when it is called first
  if (file) list = open(file, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (place && strchr(place, ':')) {
    for (failing = 0; failing < kinds; ++failing)
      if (strncmp(place, names[failing], strlen(names[failing])) == 0) break;
    failing_at = strtoul(strchr(place, ':') + 1, NULL, 10);
  }
  armed = 1;
  const int code = real_main(argc, argv, environment);
  armed = 0;
  return code;
}

EXPORT int __libc_start_main(int (*main)(int, char**, char**), int argc, char** argv, void (*init)(void),
                             void (*fini)(void), void (*rtld_fini)(void), void* stack_end) {
  real_main = main;
  return REAL(__libc_start_main)(watched_main, argc, argv, init, fini, rtld_fini, stack_end);
}

static void* no_memory(void) {
  errno = ENOMEM;
  return NULL;
}

EXPORT void* malloc(size_t size) {
  return fails(alloc_kind) ? no_memory() : __libc_malloc(size);
}
EXPORT void* calloc(size_t count, size_t size) {
  return fails(alloc_kind) ? no_memory() : __libc_calloc(count, size);
}
EXPORT void* realloc(void* before, size_t size) {
  return fails(alloc_kind) ? no_memory() : __libc_realloc(before, size);
}
EXPORT void* memalign(size_t alignment, size_t size) {
  return fails(alloc_kind) ? no_memory() : __libc_memalign(alignment, size);
}
EXPORT void* aligned_alloc(size_t alignment, size_t size) {
  return memalign(alignment, size);
}
EXPORT int posix_memalign(void** result, size_t alignment, size_t size) {
  void* made = memalign(alignment, size);
  if (!made) return ENOMEM;
  *result = made;
  return 0;
}

static int no_space(void) {
  errno = ENOSPC;
  return -1;
}

EXPORT ssize_t write(int file, const void* bytes, size_t count) {
  return fails(write_kind) ? no_space() : REAL(write)(file, bytes, count);
}
EXPORT ssize_t writev(int file, const struct iovec* parts, int count) {
  return fails(write_kind) ? no_space() : REAL(writev)(file, parts, count);
}
EXPORT size_t fwrite(const void* bytes, size_t size, size_t count, FILE* file) {
  if (!fails(write_kind)) return REAL(fwrite)(bytes, size, count, file);
  no_space();
  return 0;
}
EXPORT int fflush(FILE* file) {
  return fails(write_kind) ? no_space() : REAL(fflush)(file);
}
static int writes(FILE* file) {
  const int number = fileno(file);
  return number >= 0 && (fcntl(number, F_GETFL) & O_ACCMODE) != O_RDONLY;
}
EXPORT int fclose(FILE* file) {
  const int failed = writes(file) && fails(write_kind);
  const int result = REAL(fclose)(file);
  return failed ? no_space() : result;
}

static int no_file(void) {
  errno = EMFILE;
  return -1;
}

#define MODE(flags, last)                  \
  mode_t mode = 0;                         \
  if ((flags) & (O_CREAT | __O_TMPFILE)) { \
    va_list rest;                          \
    va_start(rest, last);                  \
    mode = va_arg(rest, mode_t);           \
    va_end(rest);                          \
  }
EXPORT int open(const char* path, int flags, ...) {
  MODE(flags, flags)
  return fails(open_kind) ? no_file() : REAL(open)(path, flags, mode);
}
EXPORT int open64(const char* path, int flags, ...) {
  MODE(flags, flags)
  return fails(open_kind) ? no_file() : REAL(open64)(path, flags, mode);
}
EXPORT int openat(int folder, const char* path, int flags, ...) {
  MODE(flags, flags)
  return fails(open_kind) ? no_file() : REAL(openat)(folder, path, flags, mode);
}
EXPORT int openat64(int folder, const char* path, int flags, ...) {
  MODE(flags, flags)
  return fails(open_kind) ? no_file() : REAL(openat64)(folder, path, flags, mode);
}
EXPORT FILE* fopen(const char* path, const char* mode) {
  return fails(open_kind) ? (no_file(), NULL) : REAL(fopen)(path, mode);
}
EXPORT FILE* fopen64(const char* path, const char* mode) {
  return fails(open_kind) ? (no_file(), NULL) : REAL(fopen64)(path, mode);
}
EXPORT DIR* opendir(const char* path) {
  return fails(open_kind) ? (no_file(), NULL) : REAL(opendir)(path);
}
EXPORT DIR* fdopendir(int folder) {
  return fails(open_kind) ? (no_file(), NULL) : REAL(fdopendir)(folder);
}
EXPORT int mkdir(const char* path, mode_t mode) {
  return fails(open_kind) ? no_file() : REAL(mkdir)(path, mode);
}
EXPORT char* mkdtemp(char* pattern) {
  return fails(open_kind) ? (no_file(), NULL) : REAL(mkdtemp)(pattern);
}

static int no_rename(void) {
  errno = EIO;
  return -1;
}
EXPORT int rename(const char* from, const char* to) {
  return fails(rename_kind) ? no_rename() : REAL(rename)(from, to);
}
EXPORT int renameat(int from_folder, const char* from, int to_folder, const char* to) {
  return fails(rename_kind) ? no_rename() : REAL(renameat)(from_folder, from, to_folder, to);
}
EXPORT int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) {
  return fails(rename_kind) ? no_rename() : REAL(renameat2)(from_folder, from, to_folder, to, flags);
}
