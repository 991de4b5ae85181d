#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <vector>

template <class T, int N> struct Several {
    T c[N];
};
template <class T> struct Runtime {
    T* c;
};

static std::vector<float> tables(1 << 20);
static FILE* input_file;
static FILE* result_file;

/// The same bits as another type.
template <class To, class From> static To same_bits(const From& from) {
    static_assert(sizeof(To) == sizeof(From), "sizes differ");
    To to;
    std::memcpy(static_cast<void*>(&to), &from, sizeof to);
    return to;
}
/// Not-a-number for what a module leaves undefined.
template <class T> static void undefine(T& value) { std::memset(static_cast<void*>(&value), 0xff, sizeof value); }
template <class T> static void attach_block(Runtime<T>& array, void* bytes) { array.c = static_cast<T*>(bytes); }
static void attach_block(uint32_t& number, void* bytes) { number = *static_cast<uint32_t*>(bytes); }

