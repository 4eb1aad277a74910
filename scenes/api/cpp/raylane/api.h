/* For C and C++. */
#ifndef RAYLANE_API_H
#define RAYLANE_API_H

/* Marks the symbols that the shared library exports. The static library marks none, so that a
 * library that links it in decides about its own exports. */
#ifdef RAYLANE_STATIC
#define RAYLANE_API
#elif defined __cplusplus
#define RAYLANE_API [[gnu::visibility("default")]]
#else
#define RAYLANE_API __attribute__((visibility("default")))
#endif

#endif
