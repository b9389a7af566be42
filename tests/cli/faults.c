/* Loaded before a program (LD_PRELOAD), so that its system fails it at a chosen call:
 *   FAULT_AT=N         the N-th call that writes below FAULT_IN fails, and so do all later ones where
 *                      FAULT_STAYS is set; a write that fails has written half
 *   FAULT_ERRNO=E      with this error
 *   FAULT_FIRED=FILE   this file is made when that happens
 *   FAULT_THREADS=N    no more than N threads can be started
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

static atomic_int calls, threads;
static atomic_bool watched[1024]; /* by file descriptor */

static int number(const char* name, int otherwise) {
  const char* text = getenv(name);
  return text ? atoi(text) : otherwise;
}

static int is_below(const char* path) {
  const char* folder = getenv("FAULT_IN");
  return folder && strncmp(path, folder, strlen(folder)) == 0;
}

static int is_watched(int file) {
  return file >= 0 && file < 1024 && watched[file];
}

/* Whether this call is to fail; errno is set then. */
static int fails(void) {
  const int at = number("FAULT_AT", 0);
  const int call = atomic_fetch_add(&calls, 1) + 1;
  if (at == 0 || (getenv("FAULT_STAYS") ? call < at : call != at)) return 0;
  const char* fired = getenv("FAULT_FIRED");
  if (fired) REAL(close)(REAL(open)(fired, O_WRONLY | O_CREAT, 0600));
  errno = number("FAULT_ERRNO", ENOSPC);
  return 1;
}

int open(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = va_arg(rest, mode_t);
  va_end(rest);
  if (is_below(path) && (flags & O_ACCMODE) != O_RDONLY && fails()) return -1;
  const int file = REAL(open)(path, flags, mode);
  /* A folder is opened to be flushed. */
  if (file >= 0 && file < 1024) watched[file] = is_below(path);
  return file;
}

ssize_t write(int file, const void* bytes, size_t size) {
  if (!is_watched(file) || !fails()) return REAL(write)(file, bytes, size);
  const int error = errno;
  if (size > 1 && REAL(write)(file, bytes, size / 2) < 0) return -1;
  errno = error;
  return -1;
}

int fsync(int file) {
  return is_watched(file) && fails() ? -1 : REAL(fsync)(file);
}

int ftruncate(int file, off_t size) {
  /* A full disk lets files be cut. */
  const int may_fail = is_watched(file) && number("FAULT_ERRNO", ENOSPC) != ENOSPC;
  return may_fail && fails() ? -1 : REAL(ftruncate)(file, size);
}

int close(int file) {
  if (file >= 0 && file < 1024) watched[file] = 0;
  return REAL(close)(file);
}

int rename(const char* from, const char* to) {
  return is_below(to) && fails() ? -1 : REAL(rename)(from, to);
}

int mkdir(const char* path, mode_t mode) {
  return is_below(path) && fails() ? -1 : REAL(mkdir)(path, mode);
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*start)(void*),
                   void* argument) {
  if (atomic_fetch_add(&threads, 1) >= number("FAULT_THREADS", 1 << 20)) return EAGAIN;
  return REAL(pthread_create)(thread, attributes, start, argument);
}
