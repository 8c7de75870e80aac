/* Preloaded into throng by test_power_loss.py: logs what would still be there after a power failure. Of a file these are
   the bytes of its last fsync(), of a folder the names of its last fsync(); a name that was never synced is gone.
   $SYNCED_LOG is the log: "file ID SIZE MTIME", or "folder ID" and "NAME/ID/TYPE" of each entry, separated by tabs. IDs
   are inode and time of birth. The log is opened before the process is confined. Files named *.sqlite* change after they
   were synced: $SYNCED_COPIES/ID gets their bytes, by a rename, because the process may be stopped at any line.
   One thread of one process looks and writes at a time: otherwise what one has seen could hide what another saw later. */
#define _GNU_SOURCE
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

enum { MAX_LOOKS = 100 };

static int log_file = -1;
static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;

static void take_mutex(void) { pthread_mutex_lock(&mutex); }
static void release_mutex(void) { pthread_mutex_unlock(&mutex); }

/* Of processes: it is given back when the process dies. The mutex is for the threads of one, which share it. */
static void lock_log(short type) {
  struct flock lock = {.l_type = type, .l_whence = SEEK_SET};
  while (fcntl(log_file, F_SETLKW, &lock) != 0 && errno == EINTR) {
  }
}

__attribute__((constructor)) static void begin(void) {
  const char* path = getenv("SYNCED_LOG");
  if (path == NULL) return;
  const int opened = open(path, O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
  log_file = fcntl(opened, F_DUPFD_CLOEXEC, 200);
  close(opened);
  pthread_atfork(take_mutex, release_mutex, release_mutex);  // no child begins with a mutex that nobody gives back
}

static int id_of(int folder, const char* name, int flags, char id[64], struct statx* status) {
  if (statx(folder, name, flags | AT_SYMLINK_NOFOLLOW, STATX_BASIC_STATS | STATX_BTIME, status) != 0) return -1;
  snprintf(id, 64, "%llu-%lld.%09u", (unsigned long long)status->stx_ino, (long long)status->stx_btime.tv_sec,
           status->stx_btime.tv_nsec);
  return 0;
}

/* False if an entry went while this looked: it may have got a name that was not among those read, and is not lost. */
static bool list_folder(int folder, FILE* line) {
  bool is_whole = true;
  DIR* entries = fdopendir(openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  for (struct dirent* entry; entries != NULL && (entry = readdir(entries)) != NULL;) {
    if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0) continue;
    char child[64];
    struct statx status;
    if (id_of(folder, entry->d_name, 0, child, &status) != 0) {
      is_whole = false;
      continue;
    }
    const char type = S_ISDIR(status.stx_mode) ? 'd' : S_ISLNK(status.stx_mode) ? 'l' : 'f';
    fprintf(line, "\t%s/%s/%c", entry->d_name, child, type);
  }
  if (entries != NULL) closedir(entries);
  return is_whole;
}

static void log_folder(int folder, const char* id) {
  bool is_whole = false;
  for (int looks = 0; !is_whole && looks < MAX_LOOKS; ++looks) {
    char* text = NULL;
    size_t size = 0;
    FILE* line = open_memstream(&text, &size);
    fprintf(line, "folder\t%s", id);
    is_whole = list_folder(folder, line);
    fputc('\n', line);
    fclose(line);
    if ((is_whole || looks == MAX_LOOKS - 1) && write(log_file, text, size) < 0) perror("log");
    free(text);
  }
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
  char part[4300];
  snprintf(copy, sizeof(copy), "%s/%s", folder, id);
  snprintf(part, sizeof(part), "%s.%d.part", copy, getpid());  // one thread of a process is here
  const int out = open(part, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  bool is_whole = out >= 0;
  char block[65536];
  off_t at = 0;
  ssize_t count = 0;
  for (; is_whole && (count = pread(file, block, sizeof(block), at)) > 0; at += count) {
    is_whole = pwrite(out, block, count, at) == count;
  }
  if (!is_whole || count < 0 || close(out) != 0 || rename(part, copy) != 0) perror("copy");
}

static void log_state(int file) {
  char id[64];
  struct statx status;
  if (id_of(file, "", AT_EMPTY_PATH, id, &status) != 0) return;
  if (S_ISDIR(status.stx_mode)) return log_folder(file, id);
  copy_database(file, id);
  dprintf(log_file, "file\t%s\t%llu\t%lld.%09u\n", id, (unsigned long long)status.stx_size,
          (long long)status.stx_mtime.tv_sec, status.stx_mtime.tv_nsec);
}

static void record(int file) {
  if (log_file < 0) return;
  take_mutex();
  lock_log(F_WRLCK);
  log_state(file);
  lock_log(F_UNLCK);
  release_mutex();
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
