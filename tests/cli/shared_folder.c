/* Preloaded into throng by test_slurm_size.py: makes $SHARED_ROOT a slow file system on a network, as its client sees it.

   Each call about a name below it, and each sync, takes $SHARED_LATENCY_US and is counted by kind in the file
   $SHARED_COUNTS: an array of 64-bit numbers, which outlives a process that is killed. That a name was not there is
   remembered for $SHARED_VISIBILITY_MS, as a cache of attributes does: until then it is not there for this process, unless
   it made the name itself or listed the folder since. "$SHARED_FAULT" is "SIGNAL CALL": the process sends the signal to
   itself before the call of this number, from 1. */
#define _GNU_SOURCE
#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <pthread.h>
#include <signal.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

/* test_slurm_size.py knows this order. */
enum kind { OPEN, CREATE, STATUS, LIST, MAKE_FOLDER, RENAME, LINK, REMOVE, SYNC, KINDS, CPU_US = 15, COUNTS = 16 };

static char root[PATH_MAX];
static char working_folder[PATH_MAX];
static size_t root_size = 0;
static uint64_t* counts = NULL;
static long latency_us = 0;
static long visibility_ms = 0;
static int fault_signal = 0;
static uint64_t fault_call = 0;
static uint64_t calls = 0;

static long number_of(const char* variable) {
  const char* text = getenv(variable);
  return text == NULL ? 0 : atol(text);
}

__attribute__((constructor)) static void begin(void) {
  const char* folder = getenv("SHARED_ROOT");
  const char* file = getenv("SHARED_COUNTS");
  if (folder == NULL || file == NULL || getcwd(working_folder, sizeof(working_folder)) == NULL) return;
  const int opened = open(file, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (opened < 0 || ftruncate(opened, COUNTS * sizeof(uint64_t)) != 0) return;
  void* shared = mmap(NULL, COUNTS * sizeof(uint64_t), PROT_READ | PROT_WRITE, MAP_SHARED, opened, 0);
  close(opened);
  if (shared == MAP_FAILED) return;
  latency_us = number_of("SHARED_LATENCY_US");
  visibility_ms = number_of("SHARED_VISIBILITY_MS");
  const char* fault = getenv("SHARED_FAULT");
  if (fault != NULL) sscanf(fault, "%d %lu", &fault_signal, &fault_call);
  snprintf(root, sizeof(root), "%s", folder);
  counts = shared;
  root_size = strlen(root); /* from here on calls are counted */
}

/* Of the process alone, without the programs that it starts. */
__attribute__((destructor)) static void end(void) {
  struct rusage usage;
  if (counts == NULL || getrusage(RUSAGE_SELF, &usage) != 0) return;
  counts[CPU_US] += (uint64_t)(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) * 1000000 +
                    (uint64_t)(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

/* The whole path of a name in an open folder; NULL where it is not below the root. */
static const char* shared_path(int folder, const char* name, char path[PATH_MAX]) {
  if (root_size == 0 || name == NULL) return NULL;
  const int saved = errno;
  char start[PATH_MAX] = "";
  if (name[0] != '/' && folder == AT_FDCWD) {
    memcpy(start, working_folder, sizeof(start));
  } else if (name[0] != '/') {
    char link[64];
    snprintf(link, sizeof(link), "/proc/self/fd/%d", folder);
    const ssize_t length = readlink(link, start, sizeof(start) - 1);
    start[length > 0 ? length : 0] = '\0';
  }
  errno = saved;
  const int size = snprintf(path, PATH_MAX, "%s%s%s", start, start[0] != '\0' && name[0] != '\0' ? "/" : "", name);
  if (size < 0 || size >= PATH_MAX || strncmp(path, root, root_size) != 0) return NULL;
  return path[root_size] == '/' || path[root_size] == '\0' ? path : NULL;
}

static void count(enum kind kind) {
  __atomic_add_fetch(&counts[kind], 1, __ATOMIC_RELAXED);
  const uint64_t call = __atomic_add_fetch(&calls, 1, __ATOMIC_RELAXED);
  const int saved = errno;
  if (fault_signal != 0 && call == fault_call) raise(fault_signal);
  if (latency_us > 0) {
    const struct timespec pause = {latency_us / 1000000, latency_us % 1000000 * 1000};
    nanosleep(&pause, NULL);
  }
  errno = saved;
}

/* Names that were not there, in a ring. */
enum { REMEMBERED = 256 };
static struct {
  char path[512];
  int64_t until_ms;
} missing[REMEMBERED];
static unsigned next_missing = 0;
static pthread_mutex_t missing_mutex = PTHREAD_MUTEX_INITIALIZER;

static int64_t now_ms(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (int64_t)now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

static int is_remembered(const char* path) {
  if (visibility_ms == 0) return 0;
  int found = 0;
  const int64_t now = now_ms();
  pthread_mutex_lock(&missing_mutex);
  for (int i = 0; i < REMEMBERED && !found; ++i) {
    found = missing[i].until_ms > now && strcmp(missing[i].path, path) == 0;
  }
  pthread_mutex_unlock(&missing_mutex);
  return found;
}

static void remember(const char* path) {
  if (visibility_ms == 0 || strlen(path) >= sizeof(missing[0].path)) return;
  pthread_mutex_lock(&missing_mutex);
  strcpy(missing[next_missing].path, path);
  missing[next_missing].until_ms = now_ms() + visibility_ms;
  next_missing = (next_missing + 1) % REMEMBERED;
  pthread_mutex_unlock(&missing_mutex);
}

/* Of the path, or of what lies in it. */
static void forget(const char* path, int is_folder) {
  const size_t size = strlen(path);
  pthread_mutex_lock(&missing_mutex);
  for (int i = 0; i < REMEMBERED; ++i) {
    if (strncmp(missing[i].path, path, size) != 0) continue;
    if (missing[i].path[size] == '\0' || (is_folder && missing[i].path[size] == '/')) missing[i].until_ms = 0;
  }
  pthread_mutex_unlock(&missing_mutex);
}

#define NEXT(name, type) ((type)dlsym(RTLD_NEXT, name))

/* A question about a name: its answer may be an old one, which costs nothing. */
#define ASK(kind, folder, name, call, failed)          \
  char buffer[PATH_MAX];                               \
  const char* path = shared_path(folder, name, buffer); \
  if (path == NULL) return call;                       \
  if (is_remembered(path)) {                           \
    errno = ENOENT;                                    \
    return failed;                                     \
  }                                                    \
  count(kind);                                         \
  const __auto_type result = call;                     \
  if (result == failed && errno == ENOENT) remember(path); \
  return result

/* A change of names. */
#define CHANGE(kind, folder, name, call)               \
  char buffer[PATH_MAX];                               \
  const char* path = shared_path(folder, name, buffer); \
  if (path == NULL) return call;                       \
  count(kind);                                         \
  const int result = call;                             \
  if (result >= 0) forget(path, 1);                    \
  return result

static int opened(const char* function, int folder, const char* name, int flags, mode_t mode) {
  int (*const next)(int, const char*, int, ...) = NEXT(function, int (*)(int, const char*, int, ...));
  if ((flags & O_CREAT) != 0) {
    CHANGE(CREATE, folder, name, next(folder, name, flags, mode));
  }
  ASK(OPEN, folder, name, next(folder, name, flags, mode), -1);
}

#define MODE                                                          \
  va_list more;                                                       \
  va_start(more, flags);                                              \
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, int) : 0; \
  va_end(more)

int open(const char* name, int flags, ...) {
  MODE;
  return opened("openat", AT_FDCWD, name, flags, mode);
}
int open64(const char* name, int flags, ...) {
  MODE;
  return opened("openat64", AT_FDCWD, name, flags, mode);
}
int openat(int folder, const char* name, int flags, ...) {
  MODE;
  return opened("openat", folder, name, flags, mode);
}
int openat64(int folder, const char* name, int flags, ...) {
  MODE;
  return opened("openat64", folder, name, flags, mode);
}

static FILE* stream_of(const char* function, const char* name, const char* mode) {
  FILE* (*const next)(const char*, const char*) = NEXT(function, FILE* (*)(const char*, const char*));
  if (strpbrk(mode, "wa") != NULL) {
    char buffer[PATH_MAX];
    const char* path = shared_path(AT_FDCWD, name, buffer);
    if (path != NULL) count(CREATE);
    FILE* file = next(name, mode);
    if (path != NULL && file != NULL) forget(path, 0);
    return file;
  }
  ASK(OPEN, AT_FDCWD, name, next(name, mode), NULL);
}
FILE* fopen(const char* name, const char* mode) { return stream_of("fopen", name, mode); }
FILE* fopen64(const char* name, const char* mode) { return stream_of("fopen64", name, mode); }

/* The GNU library's older programs call stat() by other names. */
#define STATUS_OF(function, type)                                                        \
  int function(const char* name, struct type* status) {                                  \
    int (*const next)(const char*, struct type*) = NEXT(#function, int (*)(const char*, struct type*)); \
    ASK(STATUS, AT_FDCWD, name, next(name, status), -1);                                 \
  }
STATUS_OF(stat, stat)
STATUS_OF(lstat, stat)
STATUS_OF(stat64, stat64)
STATUS_OF(lstat64, stat64)

int fstatat(int folder, const char* name, struct stat* status, int flags) {
  int (*const next)(int, const char*, struct stat*, int) =
      NEXT("fstatat", int (*)(int, const char*, struct stat*, int));
  ASK(STATUS, folder, name, next(folder, name, status, flags), -1);
}
int fstatat64(int folder, const char* name, struct stat64* status, int flags) {
  int (*const next)(int, const char*, struct stat64*, int) =
      NEXT("fstatat64", int (*)(int, const char*, struct stat64*, int));
  ASK(STATUS, folder, name, next(folder, name, status, flags), -1);
}
int statx(int folder, const char* name, int flags, unsigned int mask, struct statx* status) {
  int (*const next)(int, const char*, int, unsigned int, struct statx*) =
      NEXT("statx", int (*)(int, const char*, int, unsigned int, struct statx*));
  ASK(STATUS, folder, name, next(folder, name, flags, mask, status), -1);
}
int access(const char* name, int mode) {
  int (*const next)(const char*, int) = NEXT("access", int (*)(const char*, int));
  ASK(STATUS, AT_FDCWD, name, next(name, mode), -1);
}
int faccessat(int folder, const char* name, int mode, int flags) {
  int (*const next)(int, const char*, int, int) = NEXT("faccessat", int (*)(int, const char*, int, int));
  ASK(STATUS, folder, name, next(folder, name, mode, flags), -1);
}

/* A list of a folder asks for all of its names again. */
DIR* opendir(const char* name) {
  DIR* (*const next)(const char*) = NEXT("opendir", DIR* (*)(const char*));
  char buffer[PATH_MAX];
  const char* path = shared_path(AT_FDCWD, name, buffer);
  if (path != NULL) {
    count(LIST);
    forget(path, 1);
  }
  return next(name);
}
DIR* fdopendir(int folder) {
  DIR* (*const next)(int) = NEXT("fdopendir", DIR* (*)(int));
  char buffer[PATH_MAX];
  const char* path = shared_path(folder, "", buffer);
  if (path != NULL) {
    count(LIST);
    forget(path, 1);
  }
  return next(folder);
}

int mkdir(const char* name, mode_t mode) {
  int (*const next)(const char*, mode_t) = NEXT("mkdir", int (*)(const char*, mode_t));
  CHANGE(MAKE_FOLDER, AT_FDCWD, name, next(name, mode));
}
int rename(const char* from, const char* to) {
  int (*const next)(const char*, const char*) = NEXT("rename", int (*)(const char*, const char*));
  CHANGE(RENAME, AT_FDCWD, to, next(from, to));
}
int renameat(int from_folder, const char* from, int to_folder, const char* to) {
  int (*const next)(int, const char*, int, const char*) =
      NEXT("renameat", int (*)(int, const char*, int, const char*));
  CHANGE(RENAME, to_folder, to, next(from_folder, from, to_folder, to));
}
int link(const char* from, const char* to) {
  int (*const next)(const char*, const char*) = NEXT("link", int (*)(const char*, const char*));
  CHANGE(LINK, AT_FDCWD, to, next(from, to));
}
int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) {
  int (*const next)(int, const char*, int, const char*, int) =
      NEXT("linkat", int (*)(int, const char*, int, const char*, int));
  CHANGE(LINK, to_folder, to, next(from_folder, from, to_folder, to, flags));
}
int unlink(const char* name) {
  int (*const next)(const char*) = NEXT("unlink", int (*)(const char*));
  CHANGE(REMOVE, AT_FDCWD, name, next(name));
}
int remove(const char* name) {
  int (*const next)(const char*) = NEXT("remove", int (*)(const char*));
  CHANGE(REMOVE, AT_FDCWD, name, next(name));
}
int rmdir(const char* name) {
  int (*const next)(const char*) = NEXT("rmdir", int (*)(const char*));
  CHANGE(REMOVE, AT_FDCWD, name, next(name));
}
int unlinkat(int folder, const char* name, int flags) {
  int (*const next)(int, const char*, int) = NEXT("unlinkat", int (*)(int, const char*, int));
  CHANGE(REMOVE, folder, name, next(folder, name, flags));
}

static int synced(const char* function, int file) {
  char buffer[PATH_MAX];
  if (shared_path(file, "", buffer) != NULL) count(SYNC);
  return NEXT(function, int (*)(int))(file);
}
int fsync(int file) { return synced("fsync", file); }
int fdatasync(int file) { return synced("fdatasync", file); }
