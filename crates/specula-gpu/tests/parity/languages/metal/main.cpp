
#undef constant
#undef device
#undef thread

#include <cstdio>
#include <vector>

static std::vector<float> tables(1 << 20);
static FILE* inputs;
static FILE* results;

/// Calls a function for each row of arguments.
template <class Arguments, class Results, class Function> static void for_rows(Function function) {
    uint32_t count = 0;
    if (std::fread(&count, sizeof count, 1, inputs) != 1) {
        std::perror("inputs");
    }
    for (uint32_t i = 0; i < count; i++) {
        Arguments x;
        Results y = {};
        if (std::fread(&x, sizeof x, 1, inputs) != 1) {
            std::perror("inputs");
        }
        function(x, y);
        std::fwrite(&y, sizeof y, 1, results);
    }
}

template <class X, class Y> static void evaluate(void (*function)(X&, Y&)) {
    for_rows<X, Y>(function);
}

template <class X, class Y> static void evaluate(void (*function)(X&, Y&, const float*)) {
    for_rows<X, Y>([function](X& x, Y& y) { function(x, y, tables.data()); });
}

int main() {
    FILE* file = std::fopen("tables", "rb");
    tables.resize(std::fread(tables.data(), sizeof(float), tables.size(), file));
    std::fclose(file);
    inputs = std::fopen("inputs", "rb");
    results = std::fopen("results", "wb");
    // CALLS
    std::fclose(results);
    std::fclose(inputs);
}
