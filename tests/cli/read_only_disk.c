/* Preloaded into throng by test_machine.py: while the file $READ_ONLY_FLAG exists, all below $READ_ONLY_ROOT is read-only, as
   on a disk with errors that the kernel has remounted. (A remount by hand is refused as long as a file is open for
   writing, and the service's database always is.) */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <unistd.h>

static int below_root(const char* path) {
  const char* root = getenv("READ_ONLY_ROOT");
  const char* flag = getenv("READ_ONLY_FLAG");
  if (root == NULL || flag == NULL || strncmp(path, root, strlen(root)) != 0) return 0;
  struct stat status;
  return stat(flag, &status) == 0;
}

static int is_refused_file(int file) {
  char link[64];
  char path[PATH_MAX];
  const int saved = errno;
  snprintf(link, sizeof(link), "/proc/self/fd/%d", file);
  const ssize_t length = readlink(link, path, sizeof(path) - 1);
  errno = saved;
  if (length <= 0) return 0;
  path[length] = '\0';
  return below_root(path);
}

#define REFUSE(condition, result) \
  if (condition) {                \
    errno = EROFS;                \
    return result;                \
  }
#define NEXT(name, type) ((type)dlsym(RTLD_NEXT, name))

static int opened(const char* name, const char* path, int flags, mode_t mode) {
  const int writes = (flags & O_ACCMODE) != O_RDONLY || (flags & (O_CREAT | O_TRUNC)) != 0;
  REFUSE(writes && below_root(path), -1)
  return NEXT(name, int (*)(const char*, int, ...))(path, flags, mode);
}
#define OPEN(name)                                                      \
  int name(const char* path, int flags, ...) {                          \
    va_list more;                                                       \
    va_start(more, flags);                                              \
    const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, int) : 0; \
    va_end(more);                                                       \
    return opened(#name, path, flags, mode);                            \
  }
OPEN(open)
OPEN(open64)

#define FOPEN(name)                                                          \
  FILE* name(const char* path, const char* mode) {                           \
    REFUSE(strpbrk(mode, "wa+") != NULL && below_root(path), NULL)           \
    return NEXT(#name, FILE* (*)(const char*, const char*))(path, mode);     \
  }
FOPEN(fopen)
FOPEN(fopen64)

ssize_t write(int file, const void* bytes, size_t count) {
  REFUSE(is_refused_file(file), -1)
  return syscall(SYS_write, file, bytes, count);
}
ssize_t pwrite(int file, const void* bytes, size_t count, off_t at) {
  REFUSE(is_refused_file(file), -1)
  return syscall(SYS_pwrite64, file, bytes, count, at);
}
ssize_t pwrite64(int file, const void* bytes, size_t count, off64_t at) { return pwrite(file, bytes, count, at); }
int ftruncate(int file, off_t size) {
  REFUSE(is_refused_file(file), -1)
  return syscall(SYS_ftruncate, file, size);
}
int ftruncate64(int file, off64_t size) { return ftruncate(file, size); }
int mkdir(const char* path, mode_t mode) {
  REFUSE(below_root(path), -1)
  return syscall(SYS_mkdir, path, mode);
}
int rename(const char* from, const char* to) {
  REFUSE(below_root(to), -1)
  return syscall(SYS_rename, from, to);
}
int link(const char* from, const char* to) {
  REFUSE(below_root(to), -1)
  return syscall(SYS_link, from, to);
}
int unlink(const char* path) {
  REFUSE(below_root(path), -1)
  return syscall(SYS_unlink, path);
}
int rmdir(const char* path) {
  REFUSE(below_root(path), -1)
  return syscall(SYS_rmdir, path);
}

static int with_flag(int result, const char* path, unsigned long* flags) {
  if (result == 0 && below_root(path)) *flags |= ST_RDONLY;
  return result;
}
int statvfs(const char* path, struct statvfs* disk) {
  return with_flag(NEXT("statvfs", int (*)(const char*, struct statvfs*))(path, disk), path, &disk->f_flag);
}
int statvfs64(const char* path, struct statvfs64* disk) {
  return with_flag(NEXT("statvfs64", int (*)(const char*, struct statvfs64*))(path, disk), path, &disk->f_flag);
}
