#if !defined(SPECULA_TABLES)
#if defined(__CUDACC__) || defined(__HIPCC__)
static __device__ const float* specula_tables = nullptr;
#else
inline const float* specula_tables = nullptr;
#endif
#define SPECULA_TABLES specula::specula_tables
#endif
