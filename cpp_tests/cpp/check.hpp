// Checks that print and count failures, for programs that must not depend on a test framework.

#ifndef CHECK_HPP
#define CHECK_HPP

#include <cstdio>

inline int failures = 0;

inline void check(bool holds, const char* text, const char* file, int line) {
    if (!holds) {
        std::fprintf(stderr, "%s:%d: %s\n", file, line, text);
        ++failures;
    }
}

#define CHECK(...) check(static_cast<bool>(__VA_ARGS__), #__VA_ARGS__, __FILE__, __LINE__)

#endif
