/* For C and C++. The build reads the version from this file. */
#ifndef RAYLANE_VERSION_H
#define RAYLANE_VERSION_H

/* Version of these headers; version.hpp and raylane.h return the library's version. */
#define RAYLANE_VERSION_MAJOR 0
#define RAYLANE_VERSION_MINOR 1
#define RAYLANE_VERSION_PATCH 0
#define RAYLANE_VERSION "0.1.0"
/* For comparisons: 10203 is 1.2.3. */
#define RAYLANE_VERSION_NUMBER                                                                     \
    (10000 * RAYLANE_VERSION_MAJOR + 100 * RAYLANE_VERSION_MINOR + RAYLANE_VERSION_PATCH)

#endif
