/* For C and C++. The build takes the version from here. */
#ifndef RAYLANE_VERSION_H
#define RAYLANE_VERSION_H

/* Of these headers: version.hpp and raylane.h tell that of the library itself. */
#define RAYLANE_VERSION_MAJOR 0
#define RAYLANE_VERSION_MINOR 1
#define RAYLANE_VERSION_PATCH 0
#define RAYLANE_VERSION "0.1.0"
/* To be compared: 10203 is 1.2.3. */
#define RAYLANE_VERSION_NUMBER                                                                     \
    (10000 * RAYLANE_VERSION_MAJOR + 100 * RAYLANE_VERSION_MINOR + RAYLANE_VERSION_PATCH)

#endif
