// The header twice, as C++.
#include <specula.h>
#include <specula.h>

#include <cstdio>

int main()
{
    const bool holds = specula_abi_version() == SPECULA_ABI_VERSION && specula_version()[0] == '0';
    std::puts(holds ? "all as expected" : "not as expected");
}
