#if defined(__CUDACC_RTC__)
using uint32_t = unsigned int;
#else
#include <math.h>
#include <stdint.h>
#include <string.h>
#endif

/// What stands in front of every function.
#if !defined(SPECULA_FN) && (defined(__CUDACC__) || defined(__HIPCC__))
#define SPECULA_FN __host__ __device__ inline
#elif !defined(SPECULA_FN)
#define SPECULA_FN inline
#endif

/// What stands in front of those that are a line.
#if defined(__GNUC__)
#define SPECULA_INLINE SPECULA_FN __attribute__((always_inline))
#else
#define SPECULA_INLINE SPECULA_FN
#endif

// Sums and products keep their order under `-ffast-math`, as they do in CUDA: some are exact only so, or in range.
#if defined(__clang__) && !defined(__CUDACC__) && !defined(__HIP_DEVICE_COMPILE__)
#pragma float_control(push)
#pragma clang fp reassociate(off)
#elif defined(__GNUC__) && !defined(__clang__) && !defined(__CUDACC__)
#pragma GCC push_options
#pragma GCC optimize("no-associative-math")
#endif

namespace specula {

// ------------------------------------------------------------ vectors and functions of WGSL

/// Two floats.
struct vec2f {
    float x, y;

    vec2f() = default;
    SPECULA_INLINE explicit vec2f(float s) : x(s), y(s) {}
    SPECULA_INLINE vec2f(float x_, float y_) : x(x_), y(y_) {}

    SPECULA_INLINE vec2f xy() const { return *this; }
    SPECULA_INLINE vec2f yx() const { return vec2f(y, x); }
};

/// Three floats.
struct vec3f {
    float x, y, z;

    vec3f() = default;
    SPECULA_INLINE explicit vec3f(float s) : x(s), y(s), z(s) {}
    SPECULA_INLINE vec3f(float x_, float y_, float z_) : x(x_), y(y_), z(z_) {}
    SPECULA_INLINE vec3f(vec2f v, float z_) : x(v.x), y(v.y), z(z_) {}
    SPECULA_INLINE vec3f(float x_, vec2f v) : x(x_), y(v.x), z(v.y) {}

    SPECULA_INLINE vec2f xy() const { return vec2f(x, y); }
    SPECULA_INLINE vec2f yx() const { return vec2f(y, x); }
    SPECULA_INLINE vec2f yz() const { return vec2f(y, z); }
    SPECULA_INLINE vec3f xyz() const { return *this; }
    SPECULA_INLINE vec3f yzx() const { return vec3f(y, z, x); }
    SPECULA_INLINE vec3f yxz() const { return vec3f(y, x, z); }
    SPECULA_INLINE float operator[](uint32_t i) const { return i == 0u ? x : i == 1u ? y : z; }
};

/// Four floats.
struct vec4f {
    float x, y, z, w;

    vec4f() = default;
    SPECULA_INLINE explicit vec4f(float s) : x(s), y(s), z(s), w(s) {}
    SPECULA_INLINE vec4f(float x_, float y_, float z_, float w_) : x(x_), y(y_), z(z_), w(w_) {}
    SPECULA_INLINE vec4f(vec3f v, float w_) : x(v.x), y(v.y), z(v.z), w(w_) {}

    SPECULA_INLINE vec2f xy() const { return vec2f(x, y); }
    SPECULA_INLINE vec3f xyz() const { return vec3f(x, y, z); }
    SPECULA_INLINE float operator[](uint32_t i) const { return i == 0u ? x : i == 1u ? y : i == 2u ? z : w; }
};

/// Two words.
struct vec2u {
    uint32_t x, y;

    vec2u() = default;
    SPECULA_INLINE explicit vec2u(uint32_t s) : x(s), y(s) {}
    SPECULA_INLINE vec2u(uint32_t x_, uint32_t y_) : x(x_), y(y_) {}
};

/// Three words.
struct vec3u {
    uint32_t x, y, z;

    vec3u() = default;
    SPECULA_INLINE explicit vec3u(uint32_t s) : x(s), y(s), z(s) {}
    SPECULA_INLINE vec3u(uint32_t x_, uint32_t y_, uint32_t z_) : x(x_), y(y_), z(z_) {}
};

/// What a comparison of two floats each gives.
struct vec2b { bool x, y; };

/// What a comparison of three floats each gives.
struct vec3b { bool x, y, z; };

/// A vector of yours, with the members `x` and `y`, as one of the library.
template <class V> SPECULA_INLINE vec2f from_xy(const V& v) { return vec2f(v.x, v.y); }

/// A vector of yours, with the members `x`, `y` and `z`, as one of the library.
template <class V> SPECULA_INLINE vec3f from_xyz(const V& v) { return vec3f(v.x, v.y, v.z); }

/// A vector of the library as one of yours: `to<float2>(v)`.
template <class V> SPECULA_INLINE V to(vec2f v) { return V{v.x, v.y}; }

/// A vector of the library as one of yours: `to<float3>(v)`.
template <class V> SPECULA_INLINE V to(vec3f v) { return V{v.x, v.y, v.z}; }

SPECULA_INLINE vec2f operator-(vec2f v) { return vec2f(-v.x, -v.y); }
SPECULA_INLINE vec2f operator+(vec2f a, vec2f b) { return vec2f(a.x + b.x, a.y + b.y); }
SPECULA_INLINE vec2f operator-(vec2f a, vec2f b) { return vec2f(a.x - b.x, a.y - b.y); }
SPECULA_INLINE vec2f operator*(vec2f a, vec2f b) { return vec2f(a.x * b.x, a.y * b.y); }
SPECULA_INLINE vec2f operator/(vec2f a, vec2f b) { return vec2f(a.x / b.x, a.y / b.y); }
SPECULA_INLINE vec2f operator+(vec2f v, float s) { return vec2f(v.x + s, v.y + s); }
SPECULA_INLINE vec2f operator-(vec2f v, float s) { return vec2f(v.x - s, v.y - s); }
SPECULA_INLINE vec2f operator*(vec2f v, float s) { return vec2f(v.x * s, v.y * s); }
SPECULA_INLINE vec2f operator/(vec2f v, float s) { return vec2f(v.x / s, v.y / s); }
SPECULA_INLINE vec2f operator+(float s, vec2f v) { return vec2f(s + v.x, s + v.y); }
SPECULA_INLINE vec2f operator-(float s, vec2f v) { return vec2f(s - v.x, s - v.y); }
SPECULA_INLINE vec2f operator*(float s, vec2f v) { return vec2f(s * v.x, s * v.y); }
SPECULA_INLINE vec2f operator/(float s, vec2f v) { return vec2f(s / v.x, s / v.y); }
SPECULA_INLINE vec2f& operator+=(vec2f& a, vec2f b) { return a = a + b; }
SPECULA_INLINE vec2f& operator-=(vec2f& a, vec2f b) { return a = a - b; }
SPECULA_INLINE vec2f& operator*=(vec2f& a, vec2f b) { return a = a * b; }
SPECULA_INLINE vec2f& operator/=(vec2f& a, vec2f b) { return a = a / b; }
SPECULA_INLINE vec2f& operator+=(vec2f& v, float s) { return v = v + s; }
SPECULA_INLINE vec2f& operator-=(vec2f& v, float s) { return v = v - s; }
SPECULA_INLINE vec2f& operator*=(vec2f& v, float s) { return v = v * s; }
SPECULA_INLINE vec2f& operator/=(vec2f& v, float s) { return v = v / s; }
SPECULA_INLINE vec2b operator>=(vec2f a, vec2f b) { return vec2b{a.x >= b.x, a.y >= b.y}; }

SPECULA_INLINE vec3f operator-(vec3f v) { return vec3f(-v.x, -v.y, -v.z); }
SPECULA_INLINE vec3f operator+(vec3f a, vec3f b) { return vec3f(a.x + b.x, a.y + b.y, a.z + b.z); }
SPECULA_INLINE vec3f operator-(vec3f a, vec3f b) { return vec3f(a.x - b.x, a.y - b.y, a.z - b.z); }
SPECULA_INLINE vec3f operator*(vec3f a, vec3f b) { return vec3f(a.x * b.x, a.y * b.y, a.z * b.z); }
SPECULA_INLINE vec3f operator/(vec3f a, vec3f b) { return vec3f(a.x / b.x, a.y / b.y, a.z / b.z); }
SPECULA_INLINE vec3f operator+(vec3f v, float s) { return vec3f(v.x + s, v.y + s, v.z + s); }
SPECULA_INLINE vec3f operator-(vec3f v, float s) { return vec3f(v.x - s, v.y - s, v.z - s); }
SPECULA_INLINE vec3f operator*(vec3f v, float s) { return vec3f(v.x * s, v.y * s, v.z * s); }
SPECULA_INLINE vec3f operator/(vec3f v, float s) { return vec3f(v.x / s, v.y / s, v.z / s); }
SPECULA_INLINE vec3f operator+(float s, vec3f v) { return vec3f(s + v.x, s + v.y, s + v.z); }
SPECULA_INLINE vec3f operator-(float s, vec3f v) { return vec3f(s - v.x, s - v.y, s - v.z); }
SPECULA_INLINE vec3f operator*(float s, vec3f v) { return vec3f(s * v.x, s * v.y, s * v.z); }
SPECULA_INLINE vec3f operator/(float s, vec3f v) { return vec3f(s / v.x, s / v.y, s / v.z); }
SPECULA_INLINE vec3f& operator+=(vec3f& a, vec3f b) { return a = a + b; }
SPECULA_INLINE vec3f& operator-=(vec3f& a, vec3f b) { return a = a - b; }
SPECULA_INLINE vec3f& operator*=(vec3f& a, vec3f b) { return a = a * b; }
SPECULA_INLINE vec3f& operator/=(vec3f& a, vec3f b) { return a = a / b; }
SPECULA_INLINE vec3f& operator+=(vec3f& v, float s) { return v = v + s; }
SPECULA_INLINE vec3f& operator-=(vec3f& v, float s) { return v = v - s; }
SPECULA_INLINE vec3f& operator*=(vec3f& v, float s) { return v = v * s; }
SPECULA_INLINE vec3f& operator/=(vec3f& v, float s) { return v = v / s; }
SPECULA_INLINE vec3b operator<(vec3f a, vec3f b) { return vec3b{a.x < b.x, a.y < b.y, a.z < b.z}; }
SPECULA_INLINE vec3b operator!=(vec3f a, vec3f b) { return vec3b{a.x != b.x, a.y != b.y, a.z != b.z}; }

SPECULA_INLINE vec4f operator-(vec4f v) { return vec4f(-v.x, -v.y, -v.z, -v.w); }
SPECULA_INLINE vec4f operator+(vec4f a, vec4f b) { return vec4f(a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w); }
SPECULA_INLINE vec4f operator-(vec4f a, vec4f b) { return vec4f(a.x - b.x, a.y - b.y, a.z - b.z, a.w - b.w); }
SPECULA_INLINE vec4f operator*(vec4f a, vec4f b) { return vec4f(a.x * b.x, a.y * b.y, a.z * b.z, a.w * b.w); }
SPECULA_INLINE vec4f operator/(vec4f a, vec4f b) { return vec4f(a.x / b.x, a.y / b.y, a.z / b.z, a.w / b.w); }
SPECULA_INLINE vec4f operator+(vec4f v, float s) { return vec4f(v.x + s, v.y + s, v.z + s, v.w + s); }
SPECULA_INLINE vec4f operator-(vec4f v, float s) { return vec4f(v.x - s, v.y - s, v.z - s, v.w - s); }
SPECULA_INLINE vec4f operator*(vec4f v, float s) { return vec4f(v.x * s, v.y * s, v.z * s, v.w * s); }
SPECULA_INLINE vec4f operator/(vec4f v, float s) { return vec4f(v.x / s, v.y / s, v.z / s, v.w / s); }
SPECULA_INLINE vec4f operator+(float s, vec4f v) { return vec4f(s + v.x, s + v.y, s + v.z, s + v.w); }
SPECULA_INLINE vec4f operator-(float s, vec4f v) { return vec4f(s - v.x, s - v.y, s - v.z, s - v.w); }
SPECULA_INLINE vec4f operator*(float s, vec4f v) { return vec4f(s * v.x, s * v.y, s * v.z, s * v.w); }
SPECULA_INLINE vec4f operator/(float s, vec4f v) { return vec4f(s / v.x, s / v.y, s / v.z, s / v.w); }
SPECULA_INLINE vec4f& operator+=(vec4f& a, vec4f b) { return a = a + b; }
SPECULA_INLINE vec4f& operator-=(vec4f& a, vec4f b) { return a = a - b; }
SPECULA_INLINE vec4f& operator*=(vec4f& a, vec4f b) { return a = a * b; }
SPECULA_INLINE vec4f& operator/=(vec4f& a, vec4f b) { return a = a / b; }
SPECULA_INLINE vec4f& operator+=(vec4f& v, float s) { return v = v + s; }
SPECULA_INLINE vec4f& operator-=(vec4f& v, float s) { return v = v - s; }
SPECULA_INLINE vec4f& operator*=(vec4f& v, float s) { return v = v * s; }
SPECULA_INLINE vec4f& operator/=(vec4f& v, float s) { return v = v / s; }

SPECULA_INLINE vec2u operator^(vec2u a, vec2u b) { return vec2u(a.x ^ b.x, a.y ^ b.y); }
SPECULA_INLINE vec3u operator&(vec3u a, vec3u b) { return vec3u(a.x & b.x, a.y & b.y, a.z & b.z); }

SPECULA_INLINE float min(float a, float b) { return b < a ? b : a; }
SPECULA_INLINE float max(float a, float b) { return a < b ? b : a; }
SPECULA_INLINE uint32_t min(uint32_t a, uint32_t b) { return b < a ? b : a; }
SPECULA_INLINE uint32_t max(uint32_t a, uint32_t b) { return a < b ? b : a; }
SPECULA_INLINE vec2f min(vec2f a, vec2f b) { return vec2f(min(a.x, b.x), min(a.y, b.y)); }
SPECULA_INLINE vec2f max(vec2f a, vec2f b) { return vec2f(max(a.x, b.x), max(a.y, b.y)); }
SPECULA_INLINE vec3f min(vec3f a, vec3f b) { return vec3f(min(a.x, b.x), min(a.y, b.y), min(a.z, b.z)); }
SPECULA_INLINE vec3f max(vec3f a, vec3f b) { return vec3f(max(a.x, b.x), max(a.y, b.y), max(a.z, b.z)); }

/// `v` in `[low, high]`.
template <class T> SPECULA_INLINE T clamp(T v, T low, T high) { return min(max(v, low), high); }

/// `t` where the condition holds, else `f`; both have been computed.
template <class T> SPECULA_INLINE T select(T f, T t, bool c) { return c ? t : f; }

/// `t` where the condition holds, else `f`, component by component.
SPECULA_INLINE vec2f select(vec2f f, vec2f t, vec2b c) { return vec2f(c.x ? t.x : f.x, c.y ? t.y : f.y); }
SPECULA_INLINE vec3f select(vec3f f, vec3f t, vec3b c) {
    return vec3f(c.x ? t.x : f.x, c.y ? t.y : f.y, c.z ? t.z : f.z);
}

SPECULA_INLINE bool any(vec3b v) { return v.x || v.y || v.z; }

SPECULA_INLINE vec2f abs(vec2f v) { return vec2f(fabsf(v.x), fabsf(v.y)); }
SPECULA_INLINE vec3f abs(vec3f v) { return vec3f(fabsf(v.x), fabsf(v.y), fabsf(v.z)); }
SPECULA_INLINE float fract(float x) { return x - floorf(x); }
SPECULA_INLINE vec2f fract(vec2f v) { return vec2f(fract(v.x), fract(v.y)); }
SPECULA_INLINE vec3f exp(vec3f v) { return vec3f(expf(v.x), expf(v.y), expf(v.z)); }
SPECULA_INLINE vec3f log(vec3f v) { return vec3f(logf(v.x), logf(v.y), logf(v.z)); }
SPECULA_INLINE vec2f sqrt(vec2f v) { return vec2f(sqrtf(v.x), sqrtf(v.y)); }
SPECULA_INLINE vec3f sqrt(vec3f v) { return vec3f(sqrtf(v.x), sqrtf(v.y), sqrtf(v.z)); }

SPECULA_INLINE float dot(vec2f a, vec2f b) { return a.x * b.x + a.y * b.y; }
SPECULA_INLINE float dot(vec3f a, vec3f b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
SPECULA_INLINE float dot(vec4f a, vec4f b) { return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w; }
SPECULA_INLINE vec3f cross(vec3f a, vec3f b) {
    return vec3f(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
SPECULA_INLINE float length(vec2f v) { return sqrtf(dot(v, v)); }
SPECULA_INLINE float length(vec3f v) { return sqrtf(dot(v, v)); }
SPECULA_INLINE vec2f normalize(vec2f v) { return v / length(v); }
SPECULA_INLINE vec3f normalize(vec3f v) { return v / length(v); }

/// The integer part of `x`, held in the range of the type: a conversion from outside is undefined in C++.
SPECULA_INLINE uint32_t to_u32(float x) { return static_cast<uint32_t>(min(max(0.0f, x), 4294967040.0f)); }

/// The bits of a float.
SPECULA_INLINE uint32_t bits_of(float x) {
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}
SPECULA_INLINE vec3u bits_of(vec3f v) { return vec3u(bits_of(v.x), bits_of(v.y), bits_of(v.z)); }

/// The float of these bits.
SPECULA_INLINE float float_of(uint32_t bits) {
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}
SPECULA_INLINE vec3f float_of(vec3u v) { return vec3f(float_of(v.x), float_of(v.y), float_of(v.z)); }
