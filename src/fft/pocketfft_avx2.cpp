// Transforms with AVX2 and FMA, taken where the processor has them
#define LANES avx2
#include "pocketfft_transforms.hpp"
