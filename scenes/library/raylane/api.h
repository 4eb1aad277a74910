/* For C and C++. */
#ifndef RAYLANE_API_H
#define RAYLANE_API_H

/* What a shared library exports. The static one exports nothing: a library that takes it in may
 * have its own. */
#ifdef RAYLANE_STATIC
#define RAYLANE_API
#elif defined __cplusplus
#define RAYLANE_API [[gnu::visibility("default")]]
#else
#define RAYLANE_API __attribute__((visibility("default")))
#endif

#endif
