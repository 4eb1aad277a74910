/* Replaces the C library's allocation when it is preloaded. From main on, it counts the allocations
 * of all threads and libraries. The RAYLANE_FAIL_AT-th one fails; with RAYLANE_FAIL_ON, so do all
 * later ones. At the end it writes the count into the file RAYLANE_ALLOCATIONS. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>

extern void* __libc_malloc(size_t bytes);
extern void* __libc_calloc(size_t count, size_t bytes);
extern void* __libc_realloc(void* memory, size_t bytes);
extern void* __libc_memalign(size_t alignment, size_t bytes);

static atomic_int is_counting;
static _Thread_local int in_dlopen;
static atomic_long asked;
static long fail_at;
static int fail_on;

static int is_refused(void) {
    if (!is_counting || in_dlopen) return 0;
    const long now = ++asked;
    if (fail_at == 0 || (fail_on ? now < fail_at : now != fail_at)) return 0;
    errno = ENOMEM;
    return 1;
}

void* malloc(size_t bytes) {
    return is_refused() ? NULL : __libc_malloc(bytes);
}
void* calloc(size_t count, size_t bytes) {
    return is_refused() ? NULL : __libc_calloc(count, bytes);
}
void* realloc(void* memory, size_t bytes) {
    return is_refused() ? NULL : __libc_realloc(memory, bytes);
}
void* memalign(size_t alignment, size_t bytes) {
    return is_refused() ? NULL : __libc_memalign(alignment, bytes);
}
void* aligned_alloc(size_t alignment, size_t bytes) {
    return memalign(alignment, bytes);
}
int posix_memalign(void** memory, size_t alignment, size_t bytes) {
    if (is_refused()) return ENOMEM;
    *memory = __libc_memalign(alignment, bytes);
    return *memory != NULL ? 0 : ENOMEM;
}

/* Allocations inside of dlopen never fail: glibc 2.36 ends the process if it has no memory for an
 * error message (dlfcn/dlerror.c). oneTBB gets there when it looks for its allocator. */
void* dlopen(const char* file, int mode) {
    void* (*open)(const char*, int);
    *(void**)&open = dlsym(RTLD_NEXT, "dlopen");
    ++in_dlopen;
    void* const opened = open(file, mode);
    --in_dlopen;
    return opened;
}

static int (*main_of_program)(int, char**, char**);

static int counting_main(int argc, char** argv, char** environment) {
    const char* const at = getenv("RAYLANE_FAIL_AT");
    fail_at = at != NULL ? atol(at) : 0;
    fail_on = getenv("RAYLANE_FAIL_ON") != NULL;
    is_counting = 1;
    const int code = main_of_program(argc, argv, environment);
    is_counting = 0; /* only the C library allocates from here on */
    const char* const file = getenv("RAYLANE_ALLOCATIONS");
    if (file != NULL) {
        FILE* const out = fopen(file, "w");
        if (out == NULL) return 99;
        fprintf(out, "%ld\n", (long)asked);
        fclose(out);
    }
    return code;
}

/* The start of the program calls this. */
int __libc_start_main(int (*main)(int, char**, char**), int argc, char** argv, void (*init)(void),
                      void (*fini)(void), void (*rtld_fini)(void), void* stack_end) {
    int (*start)(int (*)(int, char**, char**), int, char**, void (*)(void), void (*)(void),
                 void (*)(void), void*);
    *(void**)&start = dlsym(RTLD_NEXT, "__libc_start_main");
    main_of_program = main;
    return start(counting_main, argc, argv, init, fini, rtld_fini, stack_end);
}
