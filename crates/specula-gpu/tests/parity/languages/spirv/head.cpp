#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

template <class T, int N> struct Several {
    T c[N];
};
template <class T> struct Runtime {
    T* c;
};

static float tables[1 << 20];
static FILE* input_file;
static FILE* result_file;

template <class T> static T least(T a, T b) { return b < a ? b : a; }
template <class T> static T largest(T a, T b) { return a < b ? b : a; }

/// The same bits as another type.
template <class To, class From> static To same_bits(const From& from) {
    static_assert(sizeof(To) == sizeof(From), "sizes differ");
    To to;
    memcpy(static_cast<void*>(&to), &from, sizeof to);
    return to;
}
/// Not-a-number for what a module leaves undefined.
template <class T> static void undefine(T& value) { memset(static_cast<void*>(&value), 0xff, sizeof value); }
template <class T> static void attach_block(Runtime<T>& array, void* bytes) { array.c = static_cast<T*>(bytes); }
static void attach_block(uint32_t& number, void* bytes) { number = *static_cast<uint32_t*>(bytes); }

