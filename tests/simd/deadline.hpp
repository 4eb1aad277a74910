#pragma once

#include <unistd.h>

namespace raylane::tests {

/// Ends the program if it is still there after so many seconds: for what may not end by itself.
class Deadline {
  public:
    explicit Deadline(unsigned seconds) { alarm(seconds); }
    ~Deadline() { alarm(0); }
    Deadline(const Deadline&) = delete;
    Deadline& operator=(const Deadline&) = delete;
};

} // namespace raylane::tests
