// An empty program: all test programs use its precompiled headers.
