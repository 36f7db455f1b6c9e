#pragma once

/// 1 in a build with AddressSanitizer or ThreadSanitizer. Their allocator stands in for malloc, and they reserve
/// terabytes of address space: a test that replaces the one or limits the other cannot run there.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define GRASP_AFFORDANCES_SANITIZER 1
#else
#define GRASP_AFFORDANCES_SANITIZER 0
#endif
