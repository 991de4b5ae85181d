// What ROCm declares and the library needs, from clang's own headers, which call AMD's device libraries.
#include <__clang_hip_runtime_wrapper.h>

#include <string.h>

__device__ inline void *memcpy(void *to, const void *from, size_t size) { return __builtin_memcpy(to, from, size); }
