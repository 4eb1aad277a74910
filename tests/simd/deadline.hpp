#pragma once

#include <unistd.h>

namespace raylane::tests {

/// Ends the program if this object still exists after so many seconds. For code that may not end.
class Deadline {
  public:
    explicit Deadline(unsigned seconds) { alarm(seconds); }
    ~Deadline() { alarm(0); }
    Deadline(const Deadline&) = delete;
    Deadline& operator=(const Deadline&) = delete;
};

} // namespace raylane::tests
