
/// Calls an entry point for each row of arguments.
static void evaluate(void (*entry)(), std::size_t arguments, std::size_t results) {
    uint32_t count = 0;
    if (std::fread(&count, sizeof count, 1, input_file) != 1) {
        std::perror("inputs");
    }
    std::vector<float> x(count * arguments);
    std::vector<float> y(count * results);
    if (std::fread(x.data(), sizeof(float), x.size(), input_file) != x.size()) {
        std::perror("inputs");
    }
    void* const arrays[] = {tables.data(), x.data(), y.data(), &count};
    attach(arrays);
    for (uint32_t row = 0; row < count; row++) {
        place(row % 65536u, row / 65536u);
        entry();
    }
    std::fwrite(y.data(), sizeof(float), y.size(), result_file);
}

int main() {
    FILE* file = std::fopen("tables", "rb");
    tables.resize(std::fread(tables.data(), sizeof(float), tables.size(), file));
    std::fclose(file);
    input_file = std::fopen("inputs", "rb");
    result_file = std::fopen("results", "wb");
    // CALLS
    std::fclose(result_file);
    std::fclose(input_file);
}
