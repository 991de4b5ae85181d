// What CUDA's toolkit declares and the library needs, from clang's own headers, which call NVIDIA's libdevice.
#include <limits.h>

#define __host__ __attribute__((host))
#define __device__ __attribute__((device))
#define __global__ __attribute__((global))
#define __forceinline__ inline __attribute__((always_inline))
#define __CUDACC__ 1
#define CUDA_VERSION 11050

#include <__clang_cuda_libdevice_declares.h>
#include <__clang_cuda_math_forward_declares.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <__clang_cuda_device_functions.h>
#include <__clang_cuda_math.h>
