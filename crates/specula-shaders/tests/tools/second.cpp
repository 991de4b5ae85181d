#include "specula.hpp"

/// Share of light that a rough interface of index 1.5 lets through.
float second(float cosine) {
    return specula::interface_transmittance(0.4f, 1.5f, cosine);
}
