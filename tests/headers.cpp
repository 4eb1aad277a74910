// Nothing: this program is there for its precompiled headers, which all test programs use.
