/* Preloaded into throng by test_power_loss.py: logs what would still be there after a power failure. Of a file these are
   the bytes of its last fsync(), of a folder the names of its last fsync(); a name that was never synced is gone.
   $SYNCED_LOG is the log: "file ID SIZE MTIME", or "folder ID" and "NAME/ID/TYPE" of each entry, separated by tabs. IDs
   are inode and time of birth. The log is opened before the process is confined. Files named *.sqlite* change after they
   were synced: $SYNCED_COPIES/ID gets their bytes. */
#define _GNU_SOURCE
#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

static int log_file = -1;

__attribute__((constructor)) static void begin(void) {
  const char* path = getenv("SYNCED_LOG");
  if (path == NULL) return;
  const int opened = open(path, O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
  log_file = fcntl(opened, F_DUPFD_CLOEXEC, 200);
  close(opened);
}

static int id_of(int folder, const char* name, int flags, char id[64], struct statx* status) {
  if (statx(folder, name, flags | AT_SYMLINK_NOFOLLOW, STATX_BASIC_STATS | STATX_BTIME, status) != 0) return -1;
  snprintf(id, 64, "%llu-%lld.%09u", (unsigned long long)status->stx_ino, (long long)status->stx_btime.tv_sec,
           status->stx_btime.tv_nsec);
  return 0;
}

static void log_folder(int folder, const char* id) {
  char* text = NULL;
  size_t size = 0;
  FILE* line = open_memstream(&text, &size);
  fprintf(line, "folder\t%s", id);
  DIR* entries = fdopendir(openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  for (struct dirent* entry; entries != NULL && (entry = readdir(entries)) != NULL;) {
    if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0) continue;
    char child[64];
    struct statx status;
    if (id_of(folder, entry->d_name, 0, child, &status) != 0) continue;
    const char type = S_ISDIR(status.stx_mode) ? 'd' : S_ISLNK(status.stx_mode) ? 'l' : 'f';
    fprintf(line, "\t%s/%s/%c", entry->d_name, child, type);
  }
  if (entries != NULL) closedir(entries);
  fputc('\n', line);
  fclose(line);
  if (write(log_file, text, size) < 0) perror("log");
  free(text);
}

static void copy_database(int file, const char* id) {
  char path[4096];
  char link[64];
  snprintf(link, sizeof(link), "/proc/self/fd/%d", file);
  const ssize_t length = readlink(link, path, sizeof(path) - 1);
  const char* folder = getenv("SYNCED_COPIES");
  if (length <= 0 || folder == NULL) return;
  path[length] = '\0';
  if (strstr(path, ".sqlite") == NULL) return;
  char copy[4200];
  snprintf(copy, sizeof(copy), "%s/%s", folder, id);
  const int out = open(copy, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  char block[65536];
  off_t at = 0;
  for (ssize_t count; (count = pread(file, block, sizeof(block), at)) > 0; at += count) {
    if (pwrite(out, block, count, at) != count) perror("copy");
  }
  close(out);
}

static void record(int file) {
  char id[64];
  struct statx status;
  if (log_file < 0 || id_of(file, "", AT_EMPTY_PATH, id, &status) != 0) return;
  if (S_ISDIR(status.stx_mode)) return log_folder(file, id);
  copy_database(file, id);
  dprintf(log_file, "file\t%s\t%llu\t%lld.%09u\n", id, (unsigned long long)status.stx_size,
          (long long)status.stx_mtime.tv_sec, status.stx_mtime.tv_nsec);
}

int fsync(int file) {
  const int result = syscall(SYS_fsync, file);
  if (result == 0) record(file);
  return result;
}

int fdatasync(int file) {
  const int result = syscall(SYS_fdatasync, file);
  if (result == 0) record(file);
  return result;
}
