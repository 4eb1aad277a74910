/* Loaded by LD_PRELOAD. With RAYLANE_HOLD=CALL:COUNT:PIPE, holds the process at its COUNT-th call
 * of CALL, one of the functions below: writes a byte to the named pipe, and waits until no process
 * has it open for reading. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

static void hold(const char* call) {
    static atomic_int count;
    char wanted[16], path[4096];
    int at = 0;
    const char* const text = getenv("RAYLANE_HOLD");
    if (text == NULL || sscanf(text, "%15[^:]:%d:%4095s", wanted, &at, path) != 3) return;
    if (strcmp(wanted, call) != 0 || ++count != at) return;
    struct pollfd pipe = {open(path, O_WRONLY | O_CLOEXEC), 0, 0};
    if (write(pipe.fd, "\n", 1) != 1) abort();
    while (poll(&pipe, 1, -1) != 1) { /* interrupted by a signal */
    }
    close(pipe.fd);
}

#define HELD(result, call, parameters, arguments)                                                  \
    result call parameters {                                                                       \
        result(*next) parameters;                                                                  \
        *(void**)&next = dlsym(RTLD_NEXT, #call);                                                  \
        hold(#call);                                                                               \
        return next arguments;                                                                     \
    }

HELD(int, madvise, (void* memory, size_t bytes, int advice), (memory, bytes, advice))
HELD(ssize_t, read, (int file, void* bytes, size_t count), (file, bytes, count))
HELD(ssize_t, pread, (int file, void* bytes, size_t count, off_t at), (file, bytes, count, at))
HELD(ssize_t, pwrite, (int file, const void* bytes, size_t count, off_t at),
     (file, bytes, count, at))
HELD(int, rename, (const char* from, const char* to), (from, to))
HELD(int, unlink, (const char* path), (path))
